// What a hull under way meets: the waves' drag against Michell's integral done in another way, and the lift that keeps
// it to its course.
#include "ocean/bodies/hull_course.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/body_waves.h"

namespace seascape {
namespace {

// On the wetted skin of Wigley's hull, L 10, B 1, T 0.625 (facts/boats.md).
constexpr double length = 10.0, wetted = 14.8791;

HullCourse wigley() { return {test::wigley_hull(length, 1.0, 0.625, 0.4, 40, 12), 0.0, {}}; }

// Michell's coefficients of the facts, a quadrature of the formula's own hull, within 4 %; below the waves' first humps
// next to nothing. Control seen: lambda not squared under the exponential.
TEST(HullCourse, WavesDragAsMichellSays) {
  const HullCourse course = wigley();
  EXPECT_NEAR(course.length_m(), length, 1e-9);
  constexpr std::array<std::array<double, 2>, 6> facts{
      {{.25, 1.064e-3}, {.30, 2.142e-3}, {.35, 1.248e-3}, {.40, 2.734e-3}, {.50, 4.517e-3}, {1.0, 1.836e-3}}};
  for (const auto& [froude, coefficient] : facts) {
    const double speed = froude * std::sqrt(test::g * length);
    const double drag = 0.5 * test::rho * wetted * speed * speed * coefficient;
    EXPECT_NEAR(course.wave_drag_n(speed) / drag, 1.0, 0.04) << "Fn " << froude;
    EXPECT_EQ(course.wave_drag_n(-speed), course.wave_drag_n(speed));
  }
  EXPECT_LT(course.wave_drag_n(0.05 * std::sqrt(test::g * length)), 1.0);
  EXPECT_EQ(course.wave_drag_n(0.0), 0.0);
  EXPECT_LT(course.wave_drag_n(100.0), course.wave_drag_n(16.0));
}

// It drags against the way, ahead and astern; lift is against drift and turning, and takes energy from both. Of a hull
// turned in the world the same. Control seen: the moment's sign.
TEST(HullCourse, HoldsAgainstDriftAndTurning) {
  const HullCourse course = wigley();
  const Vector6 ahead = course.forces({}, {{0.0, 0.0, -3.0}, {}}, 1.0);
  EXPECT_GT(ahead.linear.z, 100.0);
  EXPECT_NEAR(glm::length(glm::dvec2(ahead.linear.x, ahead.linear.y)), 0.0, 1e-9);
  EXPECT_LT(course.forces({}, {{0.0, 0.0, 3.0}, {}}, 1.0).linear.z, -100.0);
  const Vector6 drifting{{0.4, 0.0, -3.0}, {}}, turning{{0.0, 0.0, -3.0}, {0.0, -0.2, 0.0}};
  EXPECT_LT(course.forces({}, drifting, 1.0).linear.x, -100.0);
  EXPECT_GT(course.forces({}, turning, 1.0).angular.y, 100.0);  // it turns to starboard, and is held back
  for (const Vector6& motion : {drifting, turning}) {
    const Vector6 force = course.forces({}, motion, 1.0);
    EXPECT_LT(dot(force, motion), dot(ahead, {{0.0, 0.0, -3.0}, {}}));
    const glm::dmat3 turned_by = test::about({0.0, 1.0, 0.0}, 1.1);
    const Vector6 there =
        course.forces({{5.0, 1.0, 7.0}, turned_by}, {turned_by * motion.linear, turned_by * motion.angular}, 1.0);
    EXPECT_NEAR(glm::length(there.linear - turned_by * force.linear), 0.0, 1e-9);
    EXPECT_NEAR(glm::length(there.angular - turned_by * force.angular), 0.0, 1e-9);
  }
  const Vector6 dry = course.forces({}, drifting, 0.0);
  EXPECT_EQ(dry.linear, glm::dvec3(0.0));
}

// A hull that is all in the air when it floats, or a sinking one: no numbers that are none.
TEST(HullCourse, OfNoWettedHullThereIsNone) {
  const HullCourse course(box_hull({1.0, 1.0, 1.0}), -5.0, {});
  EXPECT_EQ(course.wave_drag_n(3.0), 0.0);
  EXPECT_EQ(course.forces({}, {{1.0, 2.0, -3.0}, {}}, 1.0).linear, glm::dvec3(0.0));
}

}  // namespace
}  // namespace seascape
