// The catenary of chains: its pull, what it inverts, what an anchor holds, and the shape that is drawn.
#include "ocean/bodies/chain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace seascape {
namespace {

constexpr Chain chain{20.0, 30.0, 5e6};

// A chain by parts that each hang from the one before, from its upper end down: what it comes to without any formula of
// catenaries. Its parts below the ground lie on it.
glm::dvec2 summed(double across_n, double down_n) {
  constexpr int parts = 200000;
  const double part_m = chain.length_m / parts;
  glm::dvec2 way(0.0);
  for (int n = 0; n < parts; ++n) {
    const double down = std::max(down_n - chain.weight_n_m * part_m * (n + 0.5), 0.0);
    way += part_m * glm::dvec2(across_n, down) / std::hypot(across_n, down);
  }
  way.x += across_n * chain.length_m / chain.stiff_n;
  return way;
}

// From slack to taut the pull balances a chain that is summed part by part, within a millimetre; it grows all the way,
// as fast as its stiffness says. Chain lies until H = w (L^2 - h^2) / 2 h. Controls seen: the part that lies
// left out of the reach; the stretch left out; stiffness of half the step.
TEST(Chain, HangsAsItsPartsDo) {
  constexpr double up = 6.0;
  const double lifts_all_n = chain.weight_n_m * (30.0 * 30.0 - up * up) / (2.0 * up);
  double before = -1.0;
  for (const double across : {10.0, 24.0, 26.0, 28.0, 28.8, 29.2, 29.35, 29.395, 29.42, 29.6}) {
    const ChainPull pull = chain_pull(chain, across, up);
    EXPECT_GE(pull.across_n, before) << across;
    before = pull.across_n;
    EXPECT_EQ(pull.lies_m > 0.0, pull.across_n < lifts_all_n) << across;
    EXPECT_EQ(pull.lifts_n > 0.0, pull.across_n > lifts_all_n) << across;
    if (across <= 24.0) {
      EXPECT_LT(pull.across_n, 1e-3) << "slack";
      EXPECT_NEAR(pull.down_n, chain.weight_n_m * up, 0.01);
      continue;
    }
    const glm::dvec2 way = summed(pull.across_n, pull.down_n);
    EXPECT_NEAR(way.x, across, 1e-3);
    EXPECT_NEAR(way.y, up, 1e-3);
    EXPECT_NEAR(chain_reach(chain, pull.across_n, up), across, 1e-9);
    const double more = chain_pull(chain, across + 1e-5, up).across_n - pull.across_n;
    EXPECT_NEAR(pull.stiffness_n_m * 1e-5 / more, 1.0, 0.02) << across;
  }
  EXPECT_NEAR(chain_pull(chain, std::sqrt(30.0 * 30.0 - up * up) + 0.2, up).across_n, 0.2 / 30.0 * chain.stiff_n, 4e3);
}

// No number, plumb above the anchor, above the chain's length, below the anchor: finite, and pulls towards the anchor.
TEST(Chain, OddPlacesAreFinite) {
  for (const double across : {0.0, 1e-9, 29.0, 1e6})
    for (const double up : {-5.0, 0.0, 1e-9, 29.99, 40.0, 1e6}) {
      const ChainPull pull = chain_pull(chain, across, up);
      for (const double value : {pull.across_n, pull.down_n, pull.lifts_n, pull.lies_m, pull.stiffness_n_m}) {
        EXPECT_TRUE(std::isfinite(value)) << across << " " << up;
        EXPECT_GE(value, 0.0) << across << " " << up;
      }
    }
  EXPECT_GT(chain_pull(chain, 1.0, 40.0).down_n, 0.9 * chain.stiff_n * 10.0 / 30.0) << "held from above";
  EXPECT_EQ(chain_pull(chain, std::nan(""), 1.0).across_n, 0.0);
}

// An anchor whose chain lies holds all that it does, and nothing at 40 degrees. Controls seen: the angle's
// sine.
TEST(Chain, LiftedAnchorsHoldLess) {
  EXPECT_EQ(anchor_hold(5000.0, 300.0, 0.0), 5000.0);
  EXPECT_NEAR(anchor_hold(5000.0, 1000.0, 1000.0 * 0.5 * std::tan(std::numbers::pi / 4.5)), 2500.0, 1e-6);
  EXPECT_EQ(anchor_hold(5000.0, 100.0, 90.0), 0.0);
}

double length_of(const std::vector<glm::dvec3>& places) {
  double length = 0.0;
  for (std::size_t n = 1; n < places.size(); ++n) length += glm::length(places[n] - places[n - 1]);
  return length;
}

// Lines hang between their ends with their own length, lowest between them; taut ones are straight. Chains begin at the
// anchor, lie on the ground and never below it. Controls seen: the catenary's parameter of half the way.
TEST(Chain, IsDrawnAsLongAsItIs) {
  std::vector<glm::dvec3> places(201);
  for (const glm::dvec3 b : {glm::dvec3(6.0, 0.0, 3.0), glm::dvec3(6.0, 2.0, 3.0), glm::dvec3(0.1, -3.0, 0.0)}) {
    const glm::dvec3 a(1.0, 2.0, -1.0);
    const double way = glm::length(b - a);
    for (const double slack : {1.001, 1.05, 1.5, 3.0}) {
      hang_line(a, b, slack * way, places);
      EXPECT_LT(glm::length(places.front() - a), 1e-6);
      EXPECT_EQ(places.back(), b);
      EXPECT_NEAR(length_of(places), slack * way, 0.02 * slack * way) << slack;
      for (std::size_t n = 1; n < places.size(); ++n)
        ASSERT_LT(glm::length(places[n] - places[n - 1]), 2.5 * slack * way / 200.0) << "even pieces";
      double lowest = 1e300;
      for (const glm::dvec3& place : places) lowest = std::min(lowest, place.y);
      EXPECT_LE(lowest, std::min(a.y, b.y) + 1e-9);
    }
    hang_line(a, b, 0.9 * way, places);
    EXPECT_LT(glm::length(places[100] - 0.5 * (a + b)), 1e-12);
  }
  for (const double across : {3.0, 24.0, 27.0, 29.0, 29.39}) {
    const glm::dvec3 anchor(0.0, -6.0, 0.0), bow(across, 0.0, 0.0);
    hang_chain(chain, anchor, bow, places);
    EXPECT_LT(glm::length(places.front() - anchor), 1e-6);
    EXPECT_EQ(places.back(), bow);
    for (const glm::dvec3& place : places) EXPECT_GE(place.y, anchor.y - 1e-6);
    if (across > 24.0) {
      EXPECT_NEAR(length_of(places), 30.0, 0.1) << across;
    }
  }
}

}  // namespace
}  // namespace seascape
