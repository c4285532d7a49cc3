// Foam of actors: how much of it there is and where, the same however frames fall, and until when.
#include "ocean/sea/actor_foam.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "ocean/foam/foam_sea.h"
#include "tests/support/allocations.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

const glm::dvec3 head{3.0, 1.7, -2.0};

FoamSpec small_spec(double rate_hz = 12.0) {
  FoamSpec spec;
  spec.settings.windows = {.resolution = 64, .slices = 3, .texel_m = 0.5};
  spec.settings.settle_s = 1.0;
  spec.settings.rate_hz = rate_hz;
  return spec;
}

SeaSpec of_sea(double wind_mps, bool actors_foam = true) {
  SeaState state;
  state.wind_speed_mps = wind_mps;
  SeaSpec spec = test::spec_of(state, {.resolution = 32, .cascades = 3});
  spec.actors_foam = actors_foam;
  return spec;
}

// Makes in each step the disc that a function of the step's end says.
class Stirrer : public SeaActor {
 public:
  explicit Stirrer(std::function<FoamDisc(double time_s)> disc) : disc_(std::move(disc)) {}
  void step(SeaStep& step) override { taken = step.foam(disc_(step.time_s)); }
  bool taken = false;

 private:
  std::function<FoamDisc(double)> disc_;
};

std::vector<float> texels(const FoamSea& foam) {
  std::vector<float> all;
  const LodField<float>& field = foam.foam().field();
  for (int i = 0; i < field.slices(); ++i) field.each(i, [&](LodIndex w) { all.push_back(field.texel(i, w)); });
  return all;
}

// The foam behind a thing that moves over wind waves, to the bit, at any frame rate and at irregular times, and at
// rates of foam that go into the sea's and that do not. It lies where the thing has been and not beside. Controls seen:
// discs that count at their own step's time (the foam's steps then end before the sea's last, or not, as frames fall);
// discs of one second before the last advance forgotten by then.
TEST(ActorFoam, IsTheSameHoweverFramesFall) {
  const auto foam_of = [](double rate_hz, auto next) {
    Sea sea(of_sea(7.0));
    FoamSea foam(small_spec(rate_hz), sea);
    sea.add(std::make_shared<Stirrer>([](double time_s) {
      return FoamDisc{.at_m = {-7.0 + 5.0 * (time_s - 10.0), 1.0}, .radius_m = 1.25, .per_s = 4.0, .feather_m = 0.5};
    }));
    for (double time_s = 10.0;; time_s = std::min(next(time_s), 12.5)) {
      sea.advance(time_s, head);
      foam.update(time_s, head);
      if (time_s == 12.5) break;
    }
    EXPECT_GT(foam.foam().covered({3.0, 1.0}, 0.0), 0.3f) << rate_hz;
    EXPECT_EQ(foam.foam().covered({3.0, 6.0}, 0.0), 0.0f) << rate_hz;
    EXPECT_EQ(foam.foam().covered({9.5, 1.0}, 0.0), 0.0f) << rate_hz;
    return texels(foam);
  };
  for (const double foam_hz : {12.0, 25.0, 90.0, 7.0}) {
    const std::vector<float> want = foam_of(foam_hz, [](double t) { return t + 1.0 / 60.0; });
    for (const double rate : {20.0, 72.0, 90.0})
      EXPECT_EQ(foam_of(foam_hz, [&](double t) { return (std::round(t * rate) + 1.0) / rate; }), want)
          << foam_hz << ' ' << rate;
    const auto irregular = [](double t) { return t + 0.003 + 0.1 * std::abs(std::sin(37.0 * t)); };
    EXPECT_EQ(foam_of(foam_hz, irregular), want) << foam_hz;
  }
}

// A disc that stays covers what its rate says, by the law of Foam, of its step after the first on; wide texels have as
// much of it. Controls seen: discs that count whole in each of foam's steps (five times); nothing taken off what a wide
// texel adds to a small disc.
TEST(ActorFoam, CoversWhatItsRateSays) {
  for (const double foam_hz : {12.0, 60.0, 100.0}) {
    Sea sea(of_sea(0.0));
    const FoamSpec spec = small_spec(foam_hz);
    FoamSea foam(spec, sea);
    sea.add(std::make_shared<Stirrer>([](double) {
      return FoamDisc{.at_m = {2.0, 3.0}, .radius_m = 3.0, .per_s = 0.8};
    }));
    for (int i = 0; i <= 120; ++i) {
      sea.advance(5.0 + i / 60.0, head);
      foam.update(5.0 + i / 60.0, head);
    }
    const double rate = 0.8 + 1.0 / spec.settings.life_s, time_s = 2.0 - 1.0 / 60.0;
    const double want = 0.8 / rate * (1.0 - std::exp(-rate * time_s));
    EXPECT_NEAR(foam.foam().covered({2.0, 3.0}, 0.0), want, 0.01) << foam_hz;
    EXPECT_EQ(foam.foam().covered({2.0, 7.0}, 0.0), 0.0f);
  }
  Sea sea(of_sea(0.0));
  FoamSea foam(small_spec(), sea);
  sea.add(std::make_shared<Stirrer>([](double) {
    return FoamDisc{.at_m = {2.1, 3.3}, .radius_m = 0.6, .per_s = 0.2};
  }));
  // To a time at which all slices have had the last step.
  for (int i = 0; i <= 64; ++i) sea.advance(5.0 + i / 60.0, head), foam.update(5.0 + i / 60.0, head);
  const LodField<float>& field = foam.foam().field();
  std::array<double, 3> area{};
  for (int slice = 0; slice < 3; ++slice)
    field.each(slice, [&](LodIndex w) {
      area[std::size_t(slice)] += double(field.texel(slice, w)) * std::pow(field.texel_m(slice), 2);
    });
  EXPECT_GT(area[0], 0.05);
  EXPECT_NEAR(area[2] / area[0], 1.0, 0.15);
}

// Taken away it foams no more, and what there is goes as foam goes. Over a jump of time there is none of what was
// before. Where the sea keeps none, and where a number cannot be or a step has room for no more, the actor is told.
// Controls seen: discs kept over a jump; the room of a step not counted.
TEST(ActorFoam, IsGoneWithItsActor) {
  Sea sea(of_sea(0.0));
  FoamSea foam(small_spec(), sea);
  FoamDisc disc{.at_m = {2.0, 3.0}, .radius_m = 2.0, .per_s = 5.0};
  const auto actor = std::make_shared<Stirrer>([&](double) { return disc; });
  const auto to = [&](double time_s) {
    sea.advance(time_s, head);
    foam.update(time_s, head);
    return double(foam.foam().covered({2.0, 3.0}, 0.0));
  };
  sea.add(actor);
  (void)to(5.0);
  const double had = to(7.0);
  EXPECT_TRUE(actor->taken);
  EXPECT_GT(had, 0.8);
  sea.take_away(*actor);
  const double after = to(7.25);  // when its last step has counted
  EXPECT_GT(after, 0.5);
  EXPECT_NEAR(to(8.25), after * std::exp(-1.0 / 3.85), 1e-3);
  EXPECT_EQ(to(20.0), 0.0);
  sea.add(actor);
  (void)to(21.0);
  EXPECT_EQ(to(40.0), 0.0) << "a jump";
  std::vector<FoamDisc> left;
  sea.foam().append(0.0, 100.0, left);
  EXPECT_TRUE(left.empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const FoamDisc bad : {FoamDisc{.at_m = {nan, 0.0}}, FoamDisc{.at_m = {0.0, 1e8}}, FoamDisc{.radius_m = 0.0},
                             FoamDisc{.per_s = nan}, FoamDisc{.per_s = -1.0}, FoamDisc{.feather_m = -1.0}}) {
    disc = bad;
    (void)to(sea.time_s() + 0.1);
    EXPECT_FALSE(actor->taken);
  }
  ActorFoam room(true), none(false);
  EXPECT_FALSE(none.add({}));
  for (std::size_t i = 0; i < most_foam_discs; ++i) EXPECT_TRUE(room.add({}));
  EXPECT_FALSE(room.add({}));
  room.end_step(1.0, 0.5);
  EXPECT_TRUE(room.add({}));
}

// Control seen: steps never forgotten.
TEST(ActorFoam, SteadyStepsAllocateNothing) {
  if (!test::AllocationCounter::counts) GTEST_SKIP() << "a sanitizer has its own operator new";
  Sea sea(of_sea(0.0));
  for (int i = 0; i < 20; ++i)
    sea.add(std::make_shared<Stirrer>([i](double time_s) { return FoamDisc{.at_m = {time_s, double(i)}}; }));
  std::vector<FoamDisc> discs;
  std::uint64_t ours = 0;
  for (int i = 0; i <= 400; ++i) {
    const test::AllocationCounter counter;
    sea.advance(i / 72.0, head);
    discs.clear();
    sea.foam().append((i - 6) / 72.0, i / 72.0, discs);
    if (i >= 100) ours += counter.ours();
  }
  EXPECT_GT(discs.size(), 80u);
  EXPECT_EQ(ours, 0u);
}

}  // namespace
}  // namespace seascape
