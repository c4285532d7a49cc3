// Trails: foam of actors that outlasts other foam.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "ocean/foam/foam_sea.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

const glm::dvec3 head{3.0, 1.7, -2.0};

FoamSpec small_spec() {
  FoamSpec spec;
  spec.settings.windows = {.resolution = 64, .slices = 3, .texel_m = 0.5};
  spec.settings.settle_s = 1.0;
  return spec;
}

SeaSpec of_sea(double wind_mps) {
  SeaState state;
  state.wind_speed_mps = wind_mps;
  SeaSpec spec = test::spec_of(state, {.resolution = 32, .cascades = 3});
  spec.actors_foam = true;
  return spec;
}

class Stirrer : public SeaActor {
 public:
  explicit Stirrer(std::function<FoamDisc(double time_s)> disc) : disc_(std::move(disc)) {}
  void step(SeaStep& step) override { step.foam(disc_(step.time_s)); }

 private:
  std::function<FoamDisc(double)> disc_;
};

// What covers a place so long after two seconds of a disc there, in steps of a frame.
double covered(Sea& sea, FoamSea& foam, double from_s, double to_s) {
  for (double t = from_s; t < to_s; t += 1.0 / 30.0) sea.advance(t, head), foam.update(t, head);
  return double(foam.foam().covered({2.0, 3.0}, 0.0));
}

// A trail falls to 1/e in 45 s, while other foam is long gone, and there is none of it beside. Controls: the life of
// other foam; nothing that foam falls to; a trail kept over a jump; all seen.
TEST(FoamTrail, OutlastsOtherFoam) {
  for (const bool lasting : {false, true}) {
    Sea sea(of_sea(0.0));
    FoamSea foam(small_spec(), sea);
    const auto actor = std::make_shared<Stirrer>([&](double) {
      return FoamDisc{.at_m = {2.0, 3.0}, .radius_m = 2.0, .per_s = 0.6, .lasting = lasting};
    });
    sea.add(actor);
    covered(sea, foam, 5.0, 7.0);
    sea.take_away(*actor);
    const double after_5 = covered(sea, foam, 7.0, 12.0), after_35 = covered(sea, foam, 12.0, 42.0);
    EXPECT_EQ(foam.foam().covered({2.0, 8.0}, 0.0), 0.0f);
    if (lasting) {
      const double rate = 0.6 + 1.0 / foam_trail_life_s, made = 0.6 / rate * (1.0 - std::exp(-2.0 * rate));
      EXPECT_NEAR(after_5, made * std::exp(-5.0 / foam_trail_life_s), 0.08);
      EXPECT_NEAR(after_35, made * std::exp(-35.0 / foam_trail_life_s), 0.03);
    } else {
      EXPECT_GT(after_5, 0.05);
      EXPECT_LT(after_35, 1e-3);
    }
    sea.advance(100.0, head), foam.update(100.0, head);
    EXPECT_EQ(foam.foam().covered({2.0, 3.0}, 0.0), 0.0f) << "a jump";
  }
}

// To the bit the same however frames fall. Control: a trail that goes by frames; seen.
TEST(FoamTrail, IsTheSameHoweverFramesFall) {
  const auto foam_of = [](auto next) {
    Sea sea(of_sea(7.0));
    FoamSea foam(small_spec(), sea);
    sea.add(std::make_shared<Stirrer>([](double time_s) {
      return FoamDisc{.at_m = {-7.0 + 5.0 * (time_s - 10.0), 1.0},
                      .radius_m = 1.25,
                      .per_s = 4.0,
                      .feather_m = 0.5,
                      .lasting = true};
    }));
    for (double time_s = 10.0;; time_s = std::min(next(time_s), 12.5)) {
      sea.advance(time_s, head);
      foam.update(time_s, head);
      if (time_s == 12.5) break;
    }
    std::vector<float> all;
    const LodField<float>& field = foam.foam().field();
    for (int i = 0; i < field.slices(); ++i) field.each(i, [&](LodIndex w) { all.push_back(field.texel(i, w)); });
    EXPECT_GT(foam.foam().covered({1.0, 1.0}, 0.0), 0.1f);
    return all;
  };
  const std::vector<float> want = foam_of([](double t) { return t + 1.0 / 60.0; });
  for (const double rate : {20.0, 72.0, 90.0})
    EXPECT_EQ(foam_of([&](double t) { return (std::round(t * rate) + 1.0) / rate; }), want) << rate;
}

}  // namespace
}  // namespace seascape
