// A droplet's flight: weight alone, drag alone, both for any time, and the wind over the water.
#include "ocean/foam/spray_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seascape {
namespace {

constexpr double g = 9.81;

// Without drag a parabola, to 1e-9 of the way. Control seen: half the weight.
TEST(SprayFlight, WithoutDragIsAParabola) {
  const glm::dvec3 v{8.0, 3.0, -2.0};
  for (const double relaxation : {std::numeric_limits<double>::infinity(), 1e12})
    for (const double t : {0.0, 0.01, 0.4, 3.0}) {
      const Flight flight = fly(v, {20.0, 0.0, 5.0}, relaxation, g, t);
      EXPECT_LT(glm::length(flight.way - (v * t - glm::dvec3(0.0, 0.5 * g * t * t, 0.0))), 1e-9 * (1.0 + 10.0 * t));
      EXPECT_LT(glm::length(flight.velocity - (v - glm::dvec3(0.0, g * t, 0.0))), 1e-9);
    }
}

// One long step is the same as many short ones, and no step is too long. Control seen: Euler's steps.
TEST(SprayFlight, IsExactForAnyTime) {
  const glm::dvec3 air{17.0, 1.0, -4.0};
  for (const double relaxation : {0.003, 0.08, 0.7, 30.0}) {
    glm::dvec3 way(0.0), v{5.0, 2.0, 1.0};
    const Flight once = fly(v, air, relaxation, g, 1.0);
    for (int i = 0; i < 300; ++i) {
      const Flight part = fly(v, air, relaxation, g, 1.0 / 300.0);
      way += part.way;
      v = part.velocity;
    }
    EXPECT_LT(glm::length(once.way - way), 1e-9) << relaxation;
    EXPECT_LT(glm::length(once.velocity - v), 1e-9) << relaxation;
    const Flight long_after = fly({50.0, 50.0, 0.0}, air, relaxation, g, 1e6);
    EXPECT_LT(glm::length(long_after.velocity - (air - glm::dvec3(0.0, g * relaxation, 0.0))), 1e-6);
  }
}

// Dropped, it comes to the speed at which Schiller and Naumann's drag carries its weight, within 1 %, at any rate; and
// of 0.6 to 1.6 mm within 8 % of what rain does (Atlas et al. 1973, 9.65 - 10.3 exp(-600 d)). Control seen: Stokes's
// drag alone.
TEST(SprayFlight, ComesToItsTerminalSpeed) {
  for (const double d : {6e-5, 2e-4, 6e-4, 1e-3, 1.6e-3, 2e-3})
    for (const double rate : {4.0, 12.0, 60.0}) {
      glm::dvec3 v(0.0);
      for (int i = 0; i < int(8.0 * rate); ++i) v = fly(v, {}, relaxation_s(d, glm::length(v)), g, 1.0 / rate).velocity;
      EXPECT_NEAR(-v.y / terminal_speed(d, g), 1.0, 0.01) << d << " m, " << rate << " Hz";
    }
  for (const double d : {6e-4, 1e-3, 1.6e-3})
    EXPECT_NEAR(terminal_speed(d, g) / (9.65 - 10.3 * std::exp(-600.0 * d)), 1.0, 0.08) << d;
  EXPECT_NEAR(terminal_speed(6e-5, g), sea_water_density * g * 36e-10 / (18.0 * air_viscosity), 0.012)
      << "nearly Stokes's";
}

// At 10 m nearly the wind that is asked for, less below, and none without wind. Control seen: a logarithm of base 10.
TEST(SprayFlight, TheWindIsLogarithmic) {
  for (const double wind : {5.0, 10.0, 15.0, 23.0}) {
    const WindProfile profile(wind, g);
    EXPECT_NEAR(profile.at(10.0) / wind, 1.0, 0.06) << wind;
    EXPECT_LT(profile.at(1.0), 0.85 * profile.at(10.0));
    EXPECT_EQ(profile.at(0.0), 0.0);
  }
  EXPECT_EQ(WindProfile(0.0, g).at(10.0), 0.0);
}

}  // namespace
}  // namespace seascape
