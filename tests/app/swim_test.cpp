// A swimmer against closed forms of Newton's law with drag by the square of the speed. Controls are named beside each
// test; each was seen to fail.
#include "app/swim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seascape {
namespace {

constexpr double drag = Swim::drag_kg_m, pull = Swim::hand_kg_m, mass = Swim::mass_kg;
const glm::dvec3 ahead(0.6, 0.0, -0.8);

SwimWish pulling(double back_mps, double under_water = 1.0, int hands = 1) {
  SwimWish wish;
  wish.ahead = ahead;
  wish.tracked = true;
  for (int hand = 0; hand < hands; ++hand) wish.hands[std::size_t(hand)] = SwimHand{-back_mps * ahead, under_water};
  return wish;
}

// pull (u - v)^2 = drag v^2 where both are in balance. Controls: the hand's speed against the head taken for that
// through the water; the drag linear.
TEST(Swim, SettlesWhereTheHandsPullAsTheWaterHolds) {
  for (const int hands : {1, 2})
    for (const double back_mps : {0.8, 2.0, 4.0})
      for (const double wet : {0.3, 1.0}) {
        const double ratio = std::sqrt(hands * wet * pull / drag), expected = back_mps * ratio / (1.0 + ratio);
        for (const double dt_s : {0.001, 1.0 / 72.0, 0.5, 8.0}) {
          Swim swim;
          for (double t = 0.0; t < 120.0; t += dt_s) swim.step(pulling(back_mps, wet, hands), dt_s);
          EXPECT_LT(glm::length(swim.velocity_mps() - expected * ahead), 1e-6)
              << hands << " " << back_mps << " " << dt_s;
        }
      }
  // A crawl's hands, 2 m/s under water by turns, swim as people do.
  Swim swim;
  double way_m = 0.0;
  for (int frame = 0; frame < 72 * 30; ++frame) {
    swim.step(pulling(frame % 72 < 36 ? 2.0 : -2.0), 1.0 / 72.0);
    if (frame >= 72 * 20) way_m += glm::dot(swim.moved_m(), ahead);
  }
  EXPECT_GT(way_m / 10.0, 0.5);
  EXPECT_LT(way_m / 10.0, 1.5);
}

// Nothing pulls: v = v0 / (1 + k v0 t), and x = ln(1 + k v0 t) / k with k = drag / mass, whichever way he glides.
// Controls: the way of a step by its first velocity; the drag across left out.
TEST(Swim, GlidesAsTheSquareLawHasIt) {
  const double k = drag / mass;
  for (const glm::dvec3 way : {ahead, glm::dvec3(-ahead.z, 0.0, ahead.x), -ahead})
    for (const double dt_s : {1.0 / 144.0, 1.0 / 60.0, 0.1}) {
      Swim swim;
      swim.begin_anew(1.5 * way);
      glm::dvec3 moved(0.0);
      double t = 0.0;
      for (int n = 0; n < 60; ++n, t += dt_s) {
        swim.step(pulling(0.0), dt_s);
        moved += swim.moved_m();
      }
      const double grown = 1.0 + k * 1.5 * t;
      EXPECT_NEAR(glm::dot(swim.velocity_mps(), way), 1.5 / grown, 2e-3);
      EXPECT_NEAR(glm::dot(moved, way), std::log(grown) / k, 2e-3 * std::max(1.0, t));
    }
}

// One stroke from rest, against water that does not yet hold him: v = u - u / (1 + k u t) with k = pull / mass, less
// what the drag takes. The same however time is cut. Control: one Euler step a frame.
TEST(Swim, AStrokeGoesAsFarInFewFramesAsInMany) {
  const double u = 2.0, k = pull / mass;
  Swim first;
  first.step(pulling(u), 0.02);
  EXPECT_NEAR(glm::length(first.velocity_mps()), u - u / (1.0 + k * u * 0.02), 2e-5);
  const auto stroke = [&](int frames) {
    Swim swim;
    double way_m = 0.0;
    for (int n = 0; n < frames; ++n) {
      swim.step(pulling(u), 0.6 / frames);
      way_m += glm::dot(swim.moved_m(), ahead);
    }
    return std::pair(way_m, glm::length(swim.velocity_mps()));
  };
  const auto [few_m, few_mps] = stroke(2);
  const auto [many_m, many_mps] = stroke(600);
  EXPECT_NEAR(few_m, many_m, 2e-5);
  EXPECT_NEAR(few_mps, many_mps, 1e-4);
  EXPECT_GT(many_m, 0.1);
}

// Controls: a hand that pushes either way; one in the air.
TEST(Swim, OnlyAWetHandThatMovesBackPulls) {
  for (const SwimWish& wish : {pulling(-2.0), pulling(2.0, 0.0), pulling(0.0), pulling(2.0, -1.0)}) {
    Swim swim;
    swim.step(wish, 1.0);
    EXPECT_EQ(glm::length(swim.velocity_mps()), 0.0);
    EXPECT_EQ(glm::length(swim.moved_m()), 0.0);
  }
  Swim swim;  // slower than he glides, it does not hold him either
  swim.begin_anew(2.0 * ahead);
  swim.step(pulling(1.0), 0.1);
  Swim without;
  without.begin_anew(2.0 * ahead);
  without.step(pulling(0.0), 0.1);
  EXPECT_EQ(swim.velocity_mps(), without.velocity_mps());
}

// A metre a second, exactly, however time is cut. Control: the last velocity for the whole step.
TEST(Swim, WithoutHandsHeGoesAhead) {
  SwimWish wish;
  wish.ahead = ahead;
  for (const int steps : {1, 7, 300}) {
    Swim swim;
    glm::dvec3 moved(0.0);
    for (int n = 0; n < steps; ++n) {
      swim.step(wish, 3.0 / steps);
      moved += swim.moved_m();
    }
    EXPECT_LT(glm::length(moved - (3.0 - (1.0 - std::exp(-6.0)) / 2.0) * ahead), 1e-9);
    EXPECT_LT(glm::length(swim.velocity_mps() - (1.0 - std::exp(-6.0)) * ahead), 1e-9);
  }
}

// Controls: without is_finite(); without fastest_hand_mps.
TEST(Swim, WhatIsNoNumberDoesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), big = std::numeric_limits<double>::infinity();
  Swim swim;
  for (const double bad : {nan, big, -big, 1e300}) {
    swim.begin_anew({bad, 0.0, 0.0});
    swim.begin_anew();
    swim.step(pulling(bad), 0.1);
    swim.step(pulling(1.0, bad), 0.1);
    EXPECT_TRUE(std::isfinite(swim.velocity_mps().x)) << bad;
    SwimWish wish = pulling(1.0);
    wish.ahead = {bad, bad, bad};
    if (!std::isfinite(bad)) swim.step(wish, 0.1);
    swim.step(pulling(1.0), bad);
    EXPECT_TRUE(std::isfinite(swim.velocity_mps().x) && std::isfinite(swim.moved_m().y)) << bad;
    EXPECT_LT(glm::length(swim.velocity_mps()), 1.5) << bad;
  }
  swim.begin_anew({nan, 0.0, 1.0});
  EXPECT_EQ(glm::length(swim.velocity_mps()), 0.0);
}

}  // namespace
}  // namespace seascape
