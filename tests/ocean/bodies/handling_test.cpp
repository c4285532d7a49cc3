// Propeller, rudder, sails and oars against the figures of shared/facts/boats.md, and where nothing moves.
#include "ocean/bodies/handling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace seascape {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

// A B4-55 of 0.45 m at 15 turns a second with 3 m/s through it: 1834 N and 10.4 kW. Control seen: torque's 10 KQ taken
// for KQ.
TEST(Handling, APropellersThrustAndPower) {
  const PropellerForce f = propeller({}, 3.0, 15.0);
  EXPECT_NEAR(f.thrust_n, 1834.0, 0.03 * 1834.0);
  EXPECT_NEAR(f.torque_nm * 2.0 * std::numbers::pi * 15.0, 10400.0, 0.03 * 10400.0);
  const double d = 0.45, n = 10.0;
  EXPECT_NEAR(propeller({}, 0.4 * n * d, n).thrust_n / (1025.0 * n * n * d * d * d * d), .2114, 1e-9);
}

// In all quadrants finite and without steps, J below 0 and n of 0 too (boats.md, hard case (n)); dragged through the
// water it brakes, astern it pulls back, and at rest it does nothing. Control seen: J = V / (n d) everywhere.
TEST(Handling, n_APropellerInFourQuadrants) {
  EXPECT_EQ(propeller({}, 0.0, 0.0).thrust_n, 0.0);
  EXPECT_LT(propeller({}, 3.0, 0.0).thrust_n, 0.0);
  EXPECT_GT(propeller({}, -3.0, 0.0).thrust_n, 0.0);
  EXPECT_LT(propeller({}, 3.0, -10.0).thrust_n, 0.0);
  EXPECT_LT(propeller({}, 0.0, -10.0).thrust_n, 0.0);
  EXPECT_GT(propeller({}, -3.0, 10.0).thrust_n, 0.0);
  double last = propeller({}, 5.0 * std::sin(-0.001), 12.0 * std::cos(-0.001)).thrust_n, jump = 0.0;
  for (double turn = 0.0; turn < 2.0 * std::numbers::pi; turn += 0.001) {
    const PropellerForce f = propeller({}, 5.0 * std::sin(turn), 12.0 * std::cos(turn));
    ASSERT_TRUE(std::isfinite(f.thrust_n) && std::isfinite(f.torque_nm)) << turn;
    jump = std::max(jump, std::abs(f.thrust_n - last));
    last = f.thrust_n;
  }
  EXPECT_LT(jump, 25.0);  // of 2 kN
  EXPECT_EQ(propeller({}, std::numeric_limits<double>::quiet_NaN(), 1.0).thrust_n, 0.0);
}

// Fujii's slope to the stall, less beyond it, and a plate across the flow; from astern it acts the other way round.
// Control seen: no stall.
TEST(Handling, ARudderStalls) {
  EXPECT_NEAR(rudder_coefficient(1.5, 10.0 * degree), 6.13 * 1.5 / 3.75 * std::sin(10.0 * degree), 1e-9);
  EXPECT_LT(rudder_coefficient(1.5, 36.0 * degree), rudder_coefficient(1.5, 25.0 * degree));
  EXPECT_NEAR(rudder_coefficient(1.5, 90.0 * degree), 1.2, 1e-9);
  for (double a = 0.0; a < 90.0; a += 1.0) {
    EXPECT_GE(rudder_coefficient(1.5, a * degree), 0.0);
    EXPECT_NEAR(rudder_coefficient(1.5, -a * degree), -rudder_coefficient(1.5, a * degree), 1e-12);
    EXPECT_NEAR(rudder_coefficient(1.5, (180.0 - a) * degree), rudder_coefficient(1.5, a * degree), 1e-9);
  }
  EXPECT_NEAR(rudder_force(0.1, 1.5, 10.0 * degree, 3.0, 1025.0), 0.5 * 1025.0 * 0.1 * 9.0 * 2.452 * 0.17365, 0.2);
}

// 8 m/s of true wind at 60 degrees of a boat at 3 m/s are 9.85 at 44.7. Control seen: her velocity added.
TEST(Handling, TheApparentWind) {
  // To where it blows; she sails along -z.
  const glm::dvec2 wind = 8.0 * glm::dvec2(-std::sin(60.0 * degree), std::cos(60.0 * degree));
  const glm::dvec2 felt = apparent_wind(wind, {0.0, -3.0});
  EXPECT_NEAR(glm::length(felt), 9.85, 0.01);
  EXPECT_NEAR(std::atan2(-felt.x, felt.y) / degree, 44.7, 0.1);
}

// The coefficients are ORC's; a main drives best near its own trim, luffs when eased and when pointed into the wind,
// stalls when hauled too far in, and does the same on either tack. Control seen: no stall, and no luffing.
TEST(Handling, SailsDriveLuffAndStall) {
  EXPECT_NEAR(sail_coefficients(false, 28.0 * degree).x, 1.43, 1e-9);
  EXPECT_NEAR(sail_coefficients(true, -60.0 * degree).y, .35, 1e-9);
  const SailSettings main;
  for (const double from : {35.0, 60.0, 90.0, 120.0}) {
    double best = -1e9, at = 0.0;
    for (double sheet = 0.0; sheet <= 1.0; sheet += 0.01)
      if (const double drive = sail(main, from * degree, 8.0, sheet).force_n.x; drive > best) best = drive, at = sheet;
    EXPECT_GT(best, 0.0) << from;
    EXPECT_TRUE(at > 0.0 || from > 90.0) << from;
    EXPECT_LT(at, 1.0) << from;
    EXPECT_LT(sail(main, from * degree, 8.0, 1.0).force_n.x, 0.9 * best) << from;
    const SailForce one = sail(main, from * degree, 8.0, at), other = sail(main, -from * degree, 8.0, at);
    EXPECT_EQ(one.force_n.x, other.force_n.x);
    EXPECT_EQ(one.force_n.y, -other.force_n.y);
    EXPECT_LT(one.force_n.y, 0.0) << "the wind over starboard pushes to port";
    EXPECT_EQ(one.boom_rad, -other.boom_rad);
  }
  EXPECT_EQ(sail(main, 0.0, 8.0, 1.0).luffing, 1.0);
  EXPECT_LT(sail(main, 0.0, 8.0, 0.5).force_n.x, 0.0);
  EXPECT_EQ(sail(main, 40.0 * degree, 8.0, 0.0).luffing, 1.0);  // eased
  EXPECT_EQ(sail(main, 1.0, 0.0, 0.5).force_n.x, 0.0);
}

// An oar is a plate: along its normal, against the way, with 2 sin a. Control seen: the square of the speed through it
// (half at 30 degrees).
TEST(Handling, AnOarIsAPlate) {
  const glm::dvec3 normal(0.0, 0.0, 1.0);
  EXPECT_NEAR(oar_force(0.1, normal, {0.0, 0.0, 2.0}, 1000.0).z, -400.0, 1e-9);
  EXPECT_NEAR(oar_force(0.1, normal, 2.0 * glm::dvec3(std::cos(30.0 * degree), 0.0, 0.5), 1000.0).z, -200.0, 1e-9);
  EXPECT_EQ(glm::length(oar_force(0.1, normal, {2.0, 0.0, 0.0}, 1000.0)), 0.0);
}

}  // namespace
}  // namespace seascape
