// Windows of waves that belong to bodies, as the sea has them: what queries read of them, and what bodies feel.
// Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "ocean/sea/sea.h"
#include "tests/support/own_sea.h"
#include "tests/support/wake_maker.h"

namespace seascape {
namespace {

using test::WakeMade;
using test::WakeMaker;

SeaSpec spec(bool waves = false, bool dynamic_waves = false) {
  SeaSpec spec = test::spec_of(SeaState{}, {.resolution = 32, .cascades = 3});
  spec.has_waves = waves;
  spec.felt_velocity = true;
  spec.wakes.emplace();
  spec.wakes->waves.windows = {.resolution = 64, .slices = 3, .texel_m = 0.25};
  if (!dynamic_waves) return spec;
  spec.dynamic_waves.emplace();
  spec.dynamic_waves->waves.windows = {.resolution = 64, .slices = 3, .texel_m = 0.25};
  spec.dynamic_waves->settle_s = 0.0;
  spec.dynamic_waves->rain = {.drops_per_m2_s = 0.5, .drop_length_m = 1.0, .drop_height_m = 0.2};
  return spec;
}

// Two boats that meet, so that their windows overlap.
std::vector<WakeMade> two_boats() {
  return {{.id = 7, .at_m = {-14.0, 0.0}, .velocity_mps = {2.5, 0.0}, .head_m = 0.15},
          {.id = 9, .at_m = {14.0, 3.0}, .velocity_mps = {-2.0, 0.0}, .head_m = 0.1}};
}

const glm::dvec3 viewer(0.0, 1.7, 0.0);

void run(Sea& sea, double to_s, double frame_s = 1.0 / 60.0, glm::dvec3 from = viewer, glm::dvec3 moves = {}) {
  const int frames = int(std::floor(to_s / frame_s + 1e-6));
  for (int i = 0; i <= frames; ++i) sea.advance(i * frame_s, from + double(i) * moves);
  sea.advance(to_s, from + double(frames) * moves);
}

// Queries read what WakeSurface has, in plain numbers, at any place and footprint, with and without one body's window;
// and their slopes are those of the surface that they make, weights and all.
// Controls: the weights' derivatives left out (weigh_wakes); a window that is never left out.
TEST(Wakes, QueriesReadTheirSurface) {
  Sea sea(spec());
  sea.add(std::make_shared<WakeMaker>(two_boats()));
  run(sea, 5.004);
  const SeaView view = sea.view_at(sea.time_s(), SeaDetail::felt);
  const auto surface = sea.wake_surface();
  ASSERT_NE(surface, nullptr);
  ASSERT_EQ(surface->parts().size(), 4u) << "of each boat its own and one astern";
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-40.0, 40.0), z(-30.0, 30.0);
  double highest = 0.0, worst = 0.0, apart = 0.0, slope_off = 0.0, steepest = 0.0;
  int compared = 0;
  for (int i = 0; i < 600; ++i) {
    const double east = x(random);  // compilers order arguments as they like
    const glm::dvec2 at(east, z(random));
    const double footprint = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 1.4 : 3.0;
    const SeaSample got = view.at(at, footprint);
    const DynamicSample want = surface->sea(at, footprint);
    highest = std::max(highest, std::abs(want.displacement.y));
    worst = std::max(worst, glm::length(got.displacement - want.displacement));
    const QueryAnswer all = view.query(at);
    const QueryAnswer without = view.query(at, {.most_iterations = 30, .tolerance_m = 1e-6, .without_window_of = 7});
    const glm::dvec2 rest = at - glm::dvec2(without.displacement.x, without.displacement.z);
    EXPECT_NEAR(without.displacement.y, surface->sea(rest, 0.0, 7).displacement.y, 2e-5);
    apart = std::max(apart, std::abs(all.height_m - without.height_m));
    // At texels' edges heights have two slopes, which differ by far more than a millimetre's bend.
    constexpr double d = 1e-3;
    glm::dvec2 slope, bend;
    for (int axis = 0; axis < 2; ++axis) {
      glm::dvec2 step(0.0);
      step[axis] = d;
      const double ahead = view.at(at + step, footprint).displacement.y - got.displacement.y;
      const double behind = got.displacement.y - view.at(at - step, footprint).displacement.y;
      slope[axis] = (ahead + behind) / (2.0 * d);
      bend[axis] = (ahead - behind) / d;
    }
    if (glm::length(bend) > 1e-3) continue;
    ++compared;
    steepest = std::max(steepest, glm::length(slope));
    slope_off = std::max(slope_off, glm::length(slope - got.height_gradient));
  }
  EXPECT_GT(highest, 0.03);
  EXPECT_LT(worst, 1e-5);
  EXPECT_GT(apart, 0.01);
  EXPECT_GT(compared, 500);
  EXPECT_GT(steepest, 0.03);
  EXPECT_LT(slope_off, 2e-3 * steepest) << steepest;
}

// What bodies feel, without the viewer's waves, is the same to the bit whoever looks from where and however frames
// fall; with them it is not. Rain falls around the viewer.
// Control: felt with the viewer's waves (the second half).
TEST(Wakes, WhatBodiesFeelDoesNotDependOnTheViewer) {
  const auto told = [](bool viewer_waves, double frame_s, glm::dvec3 from, glm::dvec3 moves) {
    Sea sea(spec(true, true));
    const auto boats = std::make_shared<WakeMaker>(two_boats());
    boats->asks = true;
    boats->options = {.viewer_waves = viewer_waves, .without_window_of = 7};
    sea.add(boats);
    run(sea, 4.0, frame_s, from, moves);
    return boats->told;
  };
  const auto differing = [](const std::vector<QueryAnswer>& a, const std::vector<QueryAnswer>& b) {
    EXPECT_EQ(a.size(), b.size());
    EXPECT_GT(a.size(), 400u);
    int count = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      count += a[i].height_m != b[i].height_m || a[i].normal != b[i].normal ||
               a[i].orbital_velocity_mps != b[i].orbital_velocity_mps || a[i].displacement != b[i].displacement;
    return count;
  };
  const auto one = told(false, 1.0 / 60.0, viewer, {});
  EXPECT_EQ(differing(one, told(false, 1.0 / 72.0, {3.0, 40.0, 500.0}, {0.3, 0.0, 0.1})), 0);
  EXPECT_EQ(differing(one, told(false, 1.0 / 20.0, {-9.0, 2.0, 1.0}, {})), 0);
  const auto seen = told(true, 1.0 / 60.0, viewer, {});
  EXPECT_GT(differing(seen, told(true, 1.0 / 60.0, {3.0, 40.0, 500.0}, {})), 100);
}

// The state is the same to the bit too, where there are no dynamic waves.
// Control: windows that lie where their bodies are at the frame's time.
TEST(Wakes, TheirStateComesOfStepsAlone) {
  const auto hash = [](double frame_s, glm::dvec3 from) {
    Sea sea(spec());
    sea.add(std::make_shared<WakeMaker>(two_boats()));
    run(sea, 3.0, frame_s, from, {0.0, 0.0, 0.2});
    return sea.hash();
  };
  const std::uint64_t one = hash(1.0 / 60.0, viewer);
  EXPECT_EQ(one, hash(1.0 / 90.0, {100.0, 9.0, 3.0}));
  EXPECT_EQ(one, hash(0.113, {-100.0, 900.0, 3.0}));
  Sea other(spec());
  auto boats = two_boats();
  boats[1].head_m *= 1.0000001;
  other.add(std::make_shared<WakeMaker>(boats));
  run(other, 3.0);
  EXPECT_NE(one, other.hash());
}

// Sources of bodies press their windows and not the viewer's dynamic waves, in which they would count twice.
// Control: wake() that presses both.
TEST(Wakes, DoNotPressTheViewersWaves) {
  SeaSpec both = spec(false, true);
  both.dynamic_waves->rain.drops_per_m2_s = 0.0;
  Sea sea(both);
  sea.add(std::make_shared<WakeMaker>(two_boats()));
  run(sea, 3.0);
  EXPECT_FALSE(sea.dynamic_waves()->waves().active());
  EXPECT_GT(sea.wakes()->waves(0).energy_m2(), 1e-8);
  const SeaView view = sea.view_at(sea.time_s(), SeaDetail::felt);
  EXPECT_GT(std::abs(view.query({-14.0 + 7.5, 0.0}).height_m), 0.02);
  EXPECT_EQ(view.query({-14.0 + 7.5, 0.0}, {.history = false}).height_m, 0.0);
}

// A jump of the time calms them, or else where the sea goes on they stay; backwards alike.
// Control: no calm() in Sea::advance.
TEST(Wakes, AJumpOfTimeBeginsAnewOrGoesOn) {
  for (const bool goes_on : {false, true}) {
    Sea sea(spec());
    sea.add(std::make_shared<WakeMaker>(two_boats()));
    if (goes_on) sea.go_on();
    run(sea, 3.0);
    EXPECT_NE(sea.wake_surface(), nullptr);
    sea.advance(60.0, viewer);
    EXPECT_EQ(sea.wake_surface() != nullptr, goes_on);
    sea.advance(2.0, viewer);
    EXPECT_EQ(sea.wake_surface() != nullptr, goes_on);
  }
}

// Between steps they go on: at three times the rate of the steps no two frames have the same surface, nor does any
// jump. Control: no look_ahead() after the steps.
TEST(Wakes, AreCarriedOnBetweenSteps) {
  Sea sea(spec());
  sea.add(std::make_shared<WakeMaker>(two_boats()));
  run(sea, 3.0);
  double before = 0.0, least = 1.0, most = 0.0;
  for (int i = 0; i < 30; ++i) {
    sea.advance(3.0 + i / 180.0, viewer);
    const double height = sea.view_at(sea.time_s(), SeaDetail::felt).query({-8.0, 1.0}).height_m;
    if (i > 0) least = std::min(least, std::abs(height - before)), most = std::max(most, std::abs(height - before));
    before = height;
  }
  EXPECT_GT(least, 0.0);
  EXPECT_GT(most, 1e-5);
  EXPECT_LT(most, 5e-3);
}

// How fast the water moves is the change of its height at a fixed place.
// Control: no know_velocity() for windows.
TEST(Wakes, KnowHowFastTheWaterMoves) {
  Sea sea(spec());
  sea.add(std::make_shared<WakeMaker>(two_boats()));
  run(sea, 3.0);
  constexpr double later_s = 0.002;
  double off = 0.0, fastest = 0.0;
  std::vector<QueryAnswer> first;
  for (int p = 0; p < 50; ++p)
    first.push_back(sea.view_at(3.0, SeaDetail::felt).query({-9.0 + 0.2 * p, 1.0 + 0.1 * p}));
  sea.advance(3.0 + later_s, viewer);
  for (int p = 0; p < 50; ++p) {
    const QueryAnswer then = sea.view_at(sea.time_s(), SeaDetail::felt).query({-9.0 + 0.2 * p, 1.0 + 0.1 * p});
    const double speed = (then.height_m - first[std::size_t(p)].height_m) / later_s;
    fastest = std::max(fastest, std::abs(speed));
    off = std::max(off, std::abs(speed - first[std::size_t(p)].eulerian_velocity_mps.y));
  }
  EXPECT_GT(fastest, 0.02);
  EXPECT_LT(off, 0.05 * fastest);
}

// Where no body makes waves a sea with wakes answers as one without, to the bit.
// Control: a surface of no windows instead of none.
TEST(Wakes, AtRestAreNotThere) {
  SeaSpec plain = spec(true);
  plain.wakes.reset();
  Sea with(spec(true)), without(plain);
  with.add(std::make_shared<WakeMaker>(std::vector<WakeMade>{{.head_m = 0.0}}));
  without.add(std::make_shared<WakeMaker>(std::vector<WakeMade>{{.velocity_mps = {3.0, 0.0}}}));  // nobody listens
  run(with, 2.0), run(without, 2.0);
  EXPECT_EQ(with.view_at(2.0, SeaDetail::felt).wakes(), nullptr);
  for (int p = 0; p < 20; ++p) {
    const glm::dvec2 at(1.7 * p, -0.3 * p);
    EXPECT_EQ(with.view_at(2.0, SeaDetail::felt).query(at).height_m,
              without.view_at(2.0, SeaDetail::felt).query(at).height_m);
  }
}

// On which side of the surface a point is counts them.
// Control: reach_of() without wakes.
TEST(Wakes, SidesCountThem) {
  Sea sea(spec());
  sea.add(std::make_shared<WakeMaker>(two_boats()));
  run(sea, 3.0);
  const SeaView view = sea.view_at(sea.time_s(), SeaDetail::felt);
  for (int p = 0; p < 60; ++p) {
    const glm::dvec2 at(-14.0 + 0.3 * p, 0.5);
    const double height = view.query(at).height_m;
    EXPECT_TRUE(view.side({at.x, height - 0.002, at.y}).in_water) << p;
    EXPECT_FALSE(view.side({at.x, height + 0.002, at.y}).in_water) << p;
  }
}

}  // namespace
}  // namespace seascape
