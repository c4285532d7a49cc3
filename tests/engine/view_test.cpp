// Poses put together and taken apart. Controls are named beside each test; each was seen to fail.
#include "engine/view.h"

#include <gtest/gtest.h>

namespace seascape {
namespace {

// Control: the inverse's place not turned.
TEST(Pose, InverseUndoesIt) {
  const Pose pose{{3.0, -1.0, 7.0}, glm::normalize(glm::dquat(0.7, 0.2, -0.5, 0.4))};
  for (const Pose& one : {composed(inverse(pose), pose), composed(pose, inverse(pose))}) {
    EXPECT_LT(glm::length(one.position_m), 1e-12);
    EXPECT_NEAR(std::abs(one.orientation.w), 1.0, 1e-12);
  }
}

// Controls: the turn with its sign; straight down without the ear.
TEST(Pose, HeadingIsLevelAndFacesTheSameWay) {
  const glm::dvec3 up(0.0, 1.0, 0.0), right(1.0, 0.0, 0.0);
  const glm::dquat yaw = glm::angleAxis(glm::radians(70.0), up);
  for (const double pitch_deg : {0.0, 50.0, -90.0, 90.0}) {
    const glm::dquat found = heading(yaw * glm::angleAxis(glm::radians(pitch_deg), right));
    EXPECT_LT(glm::distance(found * right, yaw * right), 1e-9) << pitch_deg;
    EXPECT_LT(glm::distance(found * up, up), 1e-12) << pitch_deg;
  }
}

}  // namespace
}  // namespace seascape
