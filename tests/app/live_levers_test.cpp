// The levers of adaptive quality as data: steps, order, and what a frame is drawn with.
#include "app/adaptive/live_levers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

constexpr Lowered everything{.models = true, .spray = true, .shadows = true, .foam = true, .anisotropic = true};

// Each lever begins with what the settings say, and each step saves time and costs the eye more; no step of the
// picture's saves more than 5.1 % of its area. Foam's rate is halved at once, for no move of it is seen in the frame
// that moves it. Controls seen: errors that fall; steps of a tenth of the sides.
TEST(LiveLevers, StepsAreSmallAndInOrder) {
  for (const bool all : {false, true}) {
    const std::vector<Lever> levers = live_levers(all ? everything : Lowered{});
    EXPECT_EQ(levers.size(), all ? 7u : 2u);
    for (const Lever& lever : levers) {
      ASSERT_LE(lever.steps.size(), 255u);
      const bool seen = lever.name != "foam's rate";
      ASSERT_GE(lever.steps.size(), seen ? 5u : 2u) << lever.name;
      EXPECT_EQ(lever.steps[0].value, 1.0);
      EXPECT_EQ(lever.steps[0].error, 0.0);
      for (std::size_t i = 1; i < lever.steps.size(); ++i) {
        EXPECT_LT(lever.steps[i].work, lever.steps[i - 1].work) << lever.name;
        EXPECT_GT(lever.steps[i].error, lever.steps[i - 1].error) << lever.name;
        if (seen) {
          EXPECT_LT(std::abs(std::log(lever.steps[i].value / lever.steps[i - 1].value)), 0.19) << lever.name;
        }
      }
    }
    for (std::size_t i = 1; i < levers[0].steps.size(); ++i)
      EXPECT_GT(levers[0].steps[i].work, 0.949 * levers[0].steps[i - 1].work);
    EXPECT_NEAR(levers[0].steps.back().value, 0.5, 0.01);
  }
}

// What is drawn says at which levels, and levels say what is drawn; what a scene lacks stays as it is. Control seen:
// two levers that move one part.
TEST(LiveLevers, LevelsAndWhatIsDrawnAreOne) {
  const std::vector<Lever> levers = live_levers(everything);
  for (std::size_t i = 0; i < levers.size(); ++i)
    for (std::uint8_t step = 0; step < levers[i].steps.size(); ++step) {
      LeverLevels levels{};
      levels[i] = step;
      const DrawnQuality quality = drawn_quality(levers, levels);
      EXPECT_EQ(nearest_levels(levers, quality), levels) << levers[i].name << " " << int(step);
      const DrawnQuality whole;
      const int moved = int(quality.scale != whole.scale) + int(quality.mesh != whole.mesh) +
                        int(quality.detail != whole.detail) + int(quality.spray != whole.spray) +
                        int(quality.shadows != whole.shadows) + int(quality.anisotropy != whole.anisotropy) +
                        int(quality.foam != whole.foam);
      EXPECT_EQ(moved, step == 0 ? 0 : 1);
    }
  const std::vector<Lever> few = live_levers({});
  LeverLevels levels{};
  levels.fill(3);
  const DrawnQuality quality = drawn_quality(few, levels);
  EXPECT_EQ(quality.detail, 1.0);
  EXPECT_EQ(quality.spray, 1.0);
  EXPECT_EQ(quality.shadows, 1.0);
  EXPECT_EQ(quality.anisotropy, 1.0);
  EXPECT_EQ(quality.foam, 1.0);
  EXPECT_LT(quality.scale, 1.0);
}

// Models and spray go before the picture's pixels do, and those before the mesh: by the errors measured. Control seen:
// the spray's error as large as the picture's.
TEST(LiveLevers, WhatTheEyeMissesLeastGoesFirst) {
  const std::vector<Lever> levers = live_levers({.models = true, .spray = true});
  const std::vector<Rung> ladder = make_ladder(levers, CostOf::gpu);
  std::size_t steps = 0;
  for (const Lever& lever : levers) steps += lever.steps.size() - 1;
  ASSERT_EQ(ladder.size(), steps);
  std::size_t first = 0;
  while (levers[ladder[first].lever].name != "picture scale") ++first;
  EXPECT_EQ(first, levers[2].steps.size() + levers[3].steps.size() - 2) << "all of models and spray";
  EXPECT_EQ(levers[ladder.back().lever].name, "mesh coarseness");
  for (std::size_t i = 1; i < ladder.size(); ++i) EXPECT_GT(ladder[i].error, ladder[i - 1].error);
  for (const Rung& rung : make_ladder(levers, CostOf::cpu)) EXPECT_NE(levers[rung.lever].name, "picture scale");
}

}  // namespace
}  // namespace seascape
