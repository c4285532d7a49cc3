// The camera that looks on from behind a head. Controls are named beside each test; each was seen to fail.
#include "app/outside_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/camera_path.h"

namespace seascape {
namespace {

Pose head(glm::dvec3 at_m, double yaw_deg, double pitch_deg = 0.0, double roll_deg = 0.0) {
  return {at_m, orientation_from_angles({yaw_deg, pitch_deg, roll_deg})};
}

constexpr double deep = -1e9;  // water that reaches nothing

// Control: the camera before the head instead of behind it.
TEST(OutsideCamera, StandsBehindAndAboveTheFirstHeadAtOnceAndLooksAtIt) {
  OutsideCamera camera;
  camera.step(head({10.0, 2.0, -5.0}, 90.0), {4.0, 1.5, 0.6}, 0.01);  // it looks to +x
  const Pose pose = camera.pose(deep);
  EXPECT_NEAR(pose.position_m.x, 6.0, 1e-9);
  EXPECT_NEAR(pose.position_m.y, 3.5, 1e-9);
  EXPECT_NEAR(pose.position_m.z, -5.0, 1e-9);
  const glm::dvec3 ahead = pose.orientation * glm::dvec3(0.0, 0.0, -1.0);
  EXPECT_NEAR(glm::dot(ahead, glm::normalize(glm::dvec3(10.0, 2.0, -5.0) - pose.position_m)), 1.0, 1e-12);
}

// However a head nods and rolls. Control: an orientation made of the head's own.
TEST(OutsideCamera, KeepsTheHorizonLevel) {
  OutsideCamera camera;
  for (int i = 0; i < 500; ++i) {
    camera.step(head({0.1 * i, 1.7 + std::sin(0.1 * i), -0.2 * i}, 7.0 * i, 80.0 * std::sin(0.3 * i), 3.0 * i),
                {4.0, 1.5, 0.6}, 0.013);
    const glm::dvec3 right = camera.pose(0.0).orientation * glm::dvec3(1.0, 0.0, 0.0);
    ASSERT_NEAR(right.y, 0.0, 1e-12) << i;
  }
}

// A step cut into many ends where the whole one does, while the head stands still; and it follows the closed form
// (1 + w t) exp(-w t). Control: damp() by small steps of Euler's kind (x += v dt).
TEST(OutsideCamera, SmoothsExactlyForAnyStep) {
  const OutsideCameraSettings settings{4.0, 1.5, 0.6};
  for (const double step_s : {0.3, 0.1, 0.02, 0.001}) {
    OutsideCamera camera;
    camera.step(head({0.0, 2.0, 0.0}, 0.0), settings, step_s);
    const int steps = int(std::lround(0.6 / step_s));
    for (int i = 0; i < steps; ++i) camera.step(head({3.0, 2.0, -1.0}, 0.0), settings, step_s);
    const double w = 3.89 / 0.6, left = (1.0 + w * 0.6) * std::exp(-w * 0.6);
    EXPECT_NEAR(left, 0.1, 1e-3) << "smooth_s is the time to a tenth";
    EXPECT_NEAR(camera.pose(deep).position_m.x, 3.0 * (1.0 - left), 1e-9) << step_s;
    EXPECT_NEAR(camera.pose(deep).position_m.z, 4.0 - (1.0 - left), 1e-9) << step_s;
  }
}

// Control: without the shorter way round (std::remainder).
TEST(OutsideCamera, TurnsTheShorterWay) {
  OutsideCamera camera;
  const OutsideCameraSettings settings{4.0, 0.0, 0.6};
  camera.step(head({0.0, 2.0, 0.0}, 170.0), settings, 0.01);
  for (int i = 0; i < 100; ++i) {
    camera.step(head({0.0, 2.0, 0.0}, -170.0), settings, 0.01);
    const double yaw = angles_from_orientation(camera.pose(deep).orientation).yaw_deg;
    ASSERT_GT(std::abs(yaw), 169.0) << i;
  }
}

// A teleport is no journey; nor is a time without smoothing. Control: without farthest_m.
TEST(OutsideCamera, IsAtOnceWhereTheHeadIsInAnotherPlace) {
  OutsideCamera camera;
  camera.step(head({0.0, 2.0, 0.0}, 0.0), {4.0, 1.5, 0.6}, 0.01);
  camera.step(head({500.0, 2.0, 0.0}, 0.0), {4.0, 1.5, 0.6}, 0.01);
  EXPECT_NEAR(camera.pose(deep).position_m.x, 500.0, 1e-9);
  camera.step(head({501.0, 2.0, 0.0}, 0.0), {4.0, 1.5, 0.0}, 0.01);
  EXPECT_NEAR(camera.pose(deep).position_m.x, 501.0, 1e-9);
}

// Control: pose() without what the water asks for.
TEST(OutsideCamera, StaysOverTheWater) {
  OutsideCamera camera;
  camera.step(head({0.0, 1.7, 0.0}, 0.0), {4.0, 1.5, 0.6}, 0.01);
  EXPECT_NEAR(camera.pose(5.0).position_m.y, 5.0 + OutsideCamera::clearance_m, 1e-12);
}

}  // namespace
}  // namespace seascape
