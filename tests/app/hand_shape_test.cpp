// The limbs of a drawn hand. Controls are named beside each test; each was seen to fail.
#include "app/hand_shape.h"

#include <gtest/gtest.h>

namespace seascape {
namespace {

std::vector<Limb> hand(bool right, double closed, const Pose& pose = {}) {
  std::vector<Limb> limbs;
  append_hand(pose, right, closed, limbs);
  return limbs;
}

// The last bones of the four fingers: three bones each after the palm's, thumb and cuff apart.
std::vector<glm::dvec3> fingertips(const std::vector<Limb>& limbs) {
  std::vector<glm::dvec3> tips;
  for (std::size_t finger = 0; finger < 4; ++finger) tips.push_back(limbs[1 + 4 * finger + 3].to_m);
  return tips;
}

// Control: a left hand that is not mirrored.
TEST(HandShape, OfTheLeftMirrorsTheRight) {
  for (const double closed : {0.0, 0.5, 1.0}) {
    const std::vector<Limb> left = hand(false, closed), right = hand(true, closed);
    ASSERT_EQ(left.size(), right.size());
    EXPECT_LE(left.size(), most_limbs);
    for (std::size_t i = 0; i < left.size(); ++i) {
      EXPECT_EQ(left[i].from_m, right[i].from_m * glm::dvec3(-1.0, 1.0, 1.0)) << i;
      EXPECT_EQ(left[i].to_m, right[i].to_m * glm::dvec3(-1.0, 1.0, 1.0)) << i;
      EXPECT_GT(left[i].to_radius_m, 0.005);
    }
  }
}

// Controls: fingers that bend towards the hand's back; that do not bend.
TEST(HandShape, FingersPointAheadAndCloseToAFist) {
  for (const glm::dvec3& tip : fingertips(hand(true, 0.0))) EXPECT_LT(tip.z, -0.095);
  for (const glm::dvec3& tip : fingertips(hand(true, 1.0))) {
    EXPECT_LT(tip.x, -0.005) << "in the palm, which looks to the left";
    EXPECT_LT(glm::length(tip * glm::dvec3(1.0, 0.0, 1.0)), 0.06);
  }
}

// Controls: bones that shrink as they bend; what is out of range taken as it is.
TEST(HandShape, BonesKeepTheirLength) {
  const std::vector<Limb> open = hand(true, 0.0), fist = hand(true, 1.0);
  for (std::size_t finger = 0; finger < 4; ++finger)
    for (std::size_t bone = 1; bone <= 3; ++bone) {
      const std::size_t i = 1 + 4 * finger + bone;
      EXPECT_NEAR(glm::distance(open[i].from_m, open[i].to_m), glm::distance(fist[i].from_m, fist[i].to_m), 1e-12);
    }
  const std::vector<Limb> more = hand(true, 7.0);
  for (std::size_t i = 0; i < fist.size(); ++i) EXPECT_EQ(fist[i].to_m, more[i].to_m);
}

// Control: the pose's orientation left out.
TEST(HandShape, StandsAtItsPose) {
  const Pose pose{{100.0, -2.0, 7.0}, glm::angleAxis(glm::radians(90.0), glm::dvec3(0.0, 1.0, 0.0))};  // to the left
  const std::vector<Limb> at = hand(true, 0.3, pose), origin = hand(true, 0.3);
  for (std::size_t i = 0; i < at.size(); ++i)
    EXPECT_LT(glm::distance(at[i].to_m,
                            glm::dvec3(100.0 + origin[i].to_m.z, -2.0 + origin[i].to_m.y, 7.0 - origin[i].to_m.x)),
              1e-12);
}

}  // namespace
}  // namespace seascape
