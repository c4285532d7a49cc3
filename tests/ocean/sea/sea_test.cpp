// The one sea: tiles made once whoever asks, views that outlive changes, and steps that do not ask how frames fall.
#include "ocean/sea/sea.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "ocean/foam/crest_steps.h"
#include "tests/support/own_sea.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

constexpr WaveQuality coarse{.resolution = 32, .cascades = 4};
const glm::dvec3 head{3.0, 2.0, -2.0};

SeaState windy(double wind_mps = 12.0) {
  SeaState state;
  state.wind_speed_mps = wind_mps;
  return state;
}

SeaSpec small_spec(double wind_mps = 12.0) {
  SeaSpec spec = test::spec_of(windy(wind_mps), coarse);
  spec.felt.cascades = 3;
  return spec;
}

SeaSpec pressed_spec() {
  SeaSpec spec = small_spec();
  spec.dynamic_waves.emplace();
  spec.dynamic_waves->waves.windows = {.resolution = 64, .slices = 3, .texel_m = 0.25};
  spec.dynamic_waves->settle_s = 0.0;
  return spec;
}

// Drifts with the water that it feels and presses it.
class Drifter : public SeaActor {
 public:
  void step(SeaStep& step) override {
    const QueryAnswer water = step.felt().query(at_m_, {.footprint_m = 1.0});
    fall_mps_ += step.dt_s * (4.0 * (water.height_m - height_m_) - fall_mps_);
    height_m_ += step.dt_s * fall_mps_;
    const glm::dvec2 along(0.7, 0.3);
    at_m_ += step.dt_s * (along + glm::dvec2(water.normal.x, water.normal.z));
    step.press({.place_m = at_m_, .velocity_mps = along, .length_m = 2.5, .head_m = 0.2 + 0.05 * height_m_});
    ++steps;
  }
  void hold() override { ++held; }
  std::uint64_t hash() const override {
    std::uint64_t x, z;
    std::memcpy(&x, &at_m_.x, 8), std::memcpy(&z, &height_m_, 8);
    return x * 31u + z;
  }
  int steps = 0, held = 0;

 private:
  glm::dvec2 at_m_{0.5, -1.5};
  double height_m_ = 0.0, fall_mps_ = 0.0;
};

// Whatever is asked of a moment, its tiles are computed once: by each detail, by foam and spray together, by who comes
// back to it. Felt tiles that the crests have are theirs. Controls seen: a store that never finds what it keeps; all of
// foam stepped before spray.
TEST(Sea, MakesTilesOnceForATimeAndADetail) {
  Sea sea(small_spec(20.0));
  for (const SeaDetail detail : {SeaDetail::drawn, SeaDetail::felt})
    for (int i = 0; i < 3; ++i) {
      const SeaView view = sea.view_at(7.0, detail);
      (void)view.query({1.0, 2.0});
      (void)sea.view_at(7.0, detail).query({3.0, 4.0});
      EXPECT_EQ(sea.made(detail), detail == SeaDetail::drawn ? 1u : 0u) << "felt waves are among the drawn ones";
    }
  FoamSpec foam_spec;
  foam_spec.settings.simulated = true;
  foam_spec.settings.windows = {.resolution = 32, .slices = 2, .texel_m = 0.5};
  FoamSea foam(foam_spec, sea);
  Spray spray({.most = 64, .range_m = 20.0}, sea, 3.85);
  Stages stages;
  step_together(&foam, &spray, 30.0, head, stages);
  // What settles: foam 28 steps of a quarter of a second and 12 of a twelfth, spray 30 of a twelfth.
  EXPECT_EQ(sea.made(SeaDetail::crests), 28u + 30u - 6u);
  const std::uint64_t before = sea.made(SeaDetail::crests);
  for (int i = 1; i <= 60; ++i) step_together(&foam, &spray, 30.0 + i / 60.0, head, stages);
  EXPECT_EQ(sea.made(SeaDetail::crests), before + 12u);
}

// Felt tiles have no slopes. A point has those of its surface all the same, on any thread, and crests of the same time,
// which need slopes, borrow no felt tiles. Controls seen: crests that borrow felt tiles; gradients along z for x.
TEST(Sea, FeltTilesLackSlopesAndPointsHaveThem) {
  SeaSpec spec = small_spec();
  spec.crests_velocity = false;  // or they could borrow none at all
  Sea sea(spec), of_crests(spec);
  const SeaView felt = sea.view_at(2.0, SeaDetail::felt), same = of_crests.view_at(2.0, SeaDetail::crests);
  (void)felt.query({0.0, 0.0});
  const SeaView crests = sea.view_at(2.0, SeaDetail::crests);
  const auto slopes_of = [](const SeaView& view, int i) {
    return view.field().sea(view.tiles(), {13.7 * i, -9.1 * i}, 0.0).height_gradient.x;
  };
  for (int i = 0; i < 64; ++i) EXPECT_EQ(slopes_of(crests, i), slopes_of(same, i)) << i;
  std::vector<double> slopes(64), rises(64);
  tbb::parallel_for(0, 64, [&](int i) {
    const glm::dvec2 rest(13.7 * i + 0.01, -9.1 * i + 0.01), aside(1e-2, 0.0);
    const auto height = [&](glm::dvec2 at) { return felt.at(at, 0.0).displacement.y; };
    slopes[std::size_t(i)] = felt.at(rest, 0.0).height_gradient.x;
    rises[std::size_t(i)] = (height(rest + aside) - height(rest - aside)) / (2.0 * aside.x);
  });
  double largest = 0.0;
  int off = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    off += std::abs(slopes[i] - rises[i]) > 2e-3;
    largest = std::max(largest, std::abs(slopes[i]));
  }
  EXPECT_LE(off, 6);  // between texels the surface is straight: differences over an edge are of both sides
  EXPECT_GT(largest, 0.05);
  EXPECT_EQ(sea.made(SeaDetail::felt), 1u);
}

// Two threads ask at once for tiles that are not made yet: both have them whole, and they are made once.
TEST(Sea, ManyThreadsAskAtOnce) {
  Sea sea(small_spec());
  for (int round = 0; round < 20; ++round) {
    const SeaView view = sea.view_at(0.5 * round, SeaDetail::felt);
    std::vector<double> heights(64);
    tbb::parallel_for(0, 64, [&](int i) { heights[std::size_t(i)] = view.query({11.0 * i, -3.0 * i}).height_m; });
    for (int i = 0; i < 64; ++i) EXPECT_EQ(heights[std::size_t(i)], view.query({11.0 * i, -3.0 * i}).height_m);
  }
  EXPECT_EQ(sea.made(SeaDetail::felt), 20u);
}

// The sea's state after a minute with a press that moves and rain, to the bit, at 20, 72, 90 frames a second and at
// irregular times. Control seen: actors that feel the frame's time instead of the step's.
TEST(Sea, StepsAreTheSameHoweverFramesFall) {
  int steps = 0;  // more than there should be
  const auto hash_of = [&](auto next) {
    SeaSpec spec = pressed_spec();
    spec.dynamic_waves->rain = {.drops_per_m2_s = 0.2, .drop_length_m = 1.2, .drop_height_m = 0.03, .seed = 5};
    Sea sea(std::move(spec));
    const auto drifter = std::make_shared<Drifter>();
    sea.add(drifter);
    const double end_s = test::long_run() ? 60.0 : 6.0;
    sea.advance(0.0, head);
    for (double time_s = 0.0; time_s < end_s;) sea.advance(time_s = std::min(next(time_s), end_s), head);
    steps = drifter->steps - int(60.0 * end_s);
    return sea.hash();
  };
  const std::uint64_t want = hash_of([](double t) { return t + 1.0 / 60.0; });
  for (const double rate : {20.0, 72.0, 90.0})
    EXPECT_EQ(hash_of([&](double t) { return (std::round(t * rate) + 1.0) / rate; }), want) << rate;
  EXPECT_EQ(hash_of([](double t) { return t + 0.003 + 0.21 * std::abs(std::sin(37.0 * t)); }), want) << "irregular";
  EXPECT_EQ(steps, 0);
  EXPECT_NE(hash_of([](double t) { return t + 6.5; }), want) << "a jump takes no steps";
}

// Another quality of the picture, a view in another detail and foam that comes and goes leave the sea's state alone,
// and felt answers to the bit. Control seen: fields that a new quality of the picture forgets, felt ones too.
TEST(Sea, WhatThePictureAsksForIsNotFelt) {
  Sea plain(pressed_spec()), asked(pressed_spec());
  for (Sea* sea : {&plain, &asked}) sea->add(std::make_shared<Drifter>());
  FoamSpec foam_spec;
  foam_spec.settings.windows = {.resolution = 32, .slices = 2, .texel_m = 0.5};
  for (int i = 0; i <= 60; ++i) {
    plain.advance(i / 30.0, head);
    asked.advance(i / 30.0, head);
    if (i == 20) asked.draw_in({.resolution = 64, .cascades = 5}, asked.spec().place.settings);
    if (i % 7 == 0) (void)asked.view_at(i / 30.0, SeaDetail::drawn).query({1.0, 1.0});
    if (i % 20 == 10) {
      FoamSea foam(foam_spec, asked);
      foam.update(i / 30.0, head);
    }
  }
  EXPECT_EQ(plain.hash(), asked.hash());
  const glm::dvec2 place(31.0, -12.0);
  const QueryAnswer a = plain.view_at(2.0, SeaDetail::felt).query(place),
                    b = asked.view_at(2.0, SeaDetail::felt).query(place);
  EXPECT_EQ(a.height_m, b.height_m);
  EXPECT_EQ(a.normal, b.normal);
}

// Who holds a view has the waves that it had, whatever the sea becomes; the next view has the new ones. Control seen:
// amplitudes taken into the field that the view holds.
TEST(Sea, ViewsOutliveAChange) {
  Sea sea(small_spec());
  sea.advance(10.0, head);
  const SeaView before = sea.view_at(10.0, SeaDetail::felt);
  const glm::dvec2 place(5.0, 40.0);
  const double height = before.query(place).height_m;
  const SeaView later = sea.view_at(10.5, SeaDetail::felt);  // whose tiles nobody has asked for
  sea.change(windy(20.0), 0.5);
  EXPECT_TRUE(sea.changing());
  for (int i = 0; i < 2000 && sea.waves_version() == 1; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    sea.advance(10.0, head);
  }
  sea.advance(11.0, head);
  EXPECT_FALSE(sea.changing());
  EXPECT_GT(sea.bins_version(), 1u);
  EXPECT_EQ(before.query(place).height_m, height);
  Sea as_it_was(small_spec());
  EXPECT_EQ(later.query(place).height_m, as_it_was.view_at(10.5, SeaDetail::felt).query(place).height_m);
  EXPECT_NE(sea.view_at(10.0, SeaDetail::felt).query(place).height_m, height);
  EXPECT_GT(sea.statistics().height_variance, 3.0 * Sea(small_spec()).statistics().height_variance);
}

// Another level moves the water and leaves its waves: who draws them copies none anew. Control seen: both counts
// raised.
TEST(Sea, TellsChangedWavesFromChangedWater) {
  Sea sea(small_spec());
  SeaSpec spec = small_spec();
  spec.place.settings.level_m = 0.3;
  sea.apply(std::move(spec));
  EXPECT_GT(sea.waves_version(), 1u);
  EXPECT_EQ(sea.bins_version(), 1u);
}

// 99 of 100 felt heights lie within three times left_out_m of the drawn ones, and not all within a third of it. Of
// tiles that lack no wave but are coarse it is what they miss, within a fifth. Controls seen: waves that are lacking
// left out of it; the interpolation's part left out.
TEST(Sea, SaysWhatADetailLacks) {
  for (const double wind : {5.0, 12.0, 25.0}) {
    SeaSpec spec;
    spec.state = windy(wind);
    spec.drawn = {.resolution = 256, .cascades = 5};
    Sea sea(std::move(spec));
    const SeaView drawn = sea.view_at(3.0, SeaDetail::drawn), felt = sea.view_at(3.0, SeaDetail::felt);
    EXPECT_LT(drawn.left_out_m(), felt.left_out_m());
    int asked = 0, within = 0, near = 0;
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 place(137.1 * i, -91.7 * (i % 97));
      const QueryAnswer a = drawn.query(place), b = felt.query(place);
      if (!a.converged || !b.converged) continue;
      ++asked;
      within += std::abs(a.height_m - b.height_m) <= 3.0 * felt.left_out_m();
      near += std::abs(a.height_m - b.height_m) <= felt.left_out_m() / 3.0;
    }
    ASSERT_GT(asked, 1500) << wind;
    EXPECT_GE(double(within), 0.99 * asked) << wind;
    EXPECT_LT(double(near), 0.9 * asked) << wind;
  }
  SeaSpec spec;
  spec.state = windy();
  spec.drawn = {.resolution = 512, .cascades = 5};
  spec.felt = {.resolution = 64, .cascades = 5};
  Sea sea(std::move(spec));
  const SeaView fine = sea.view_at(3.0, SeaDetail::drawn), coarse_tiles = sea.view_at(3.0, SeaDetail::felt);
  double square = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 rest(137.1 * i, -91.7 * (i % 97));
    square += std::pow(fine.at(rest, 0.0).displacement.y - coarse_tiles.at(rest, 0.0).displacement.y, 2);
  }
  EXPECT_NEAR(std::sqrt(square / 2000.0) / coarse_tiles.left_out_m(), 1.0, 0.2);
}

// Time that jumps or runs back holds the actors and steps none; a time that is no number changes nothing. Control seen:
// a time that is no number taken.
TEST(Sea, JumpsOfTimeHoldTheActors) {
  Sea sea(pressed_spec());
  const auto drifter = std::make_shared<Drifter>();
  sea.add(drifter);
  sea.advance(1.0, head);
  sea.advance(2.0, head);
  EXPECT_EQ(drifter->steps, 60);
  const int held = drifter->held;
  sea.advance(20.0, head);
  sea.advance(1.0, head);
  EXPECT_EQ(drifter->held, held + 2);
  EXPECT_EQ(drifter->steps, 60);
  const std::uint64_t hash = sea.hash();
  sea.advance(std::nan(""), head);
  EXPECT_EQ(sea.hash(), hash);
  sea.take_away(*drifter);
  sea.advance(1.5, head);
  EXPECT_EQ(drifter->steps, 60);
}

}  // namespace
}  // namespace seascape
