// The mark where a teleport aims, as a list of limbs. Controls are named beside each test; each was seen to fail.
#include "app/aim_shape.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

ShownAim aim_at(const glm::dvec3& to_m, bool found = true) {
  ShownAim aim;
  aim.from_m = glm::dvec3(0.2, 1.2, -0.4);
  aim.to_m = to_m;
  aim.found = found;
  for (std::size_t i = 0; i < ShownAim::sides; ++i) aim.water_m[i] = 0.1 * std::sin(double(i));
  return aim;
}

const glm::dvec3 eyes(0.0, 1.7, 0.0);

// A closed ring of 0.6 m about the place, on the water that each corner has; the line ends in its middle. Controls: the
// ring level; its last side left out; its radius as a diameter.
TEST(AimShape, ARingLiesOnTheWaves) {
  const glm::dvec3 to(3.0, 0.05, -8.0);
  const ShownAim aim = aim_at(to);
  std::vector<Limb> limbs;
  append_aim(aim, eyes, limbs);
  ASSERT_EQ(limbs.size(), most_aim_limbs);
  EXPECT_EQ(limbs[0].to_m, to);
  EXPECT_LT(glm::distance(limbs[0].from_m, *aim.from_m), 0.2);
  for (std::size_t i = 0; i < ShownAim::sides; ++i) {
    const Limb& side = limbs[1 + i];
    EXPECT_EQ(side.to_m, limbs[1 + (i + 1) % ShownAim::sides].from_m);
    EXPECT_NEAR(std::hypot(side.from_m.x - to.x, side.from_m.z - to.z), 0.6, 1e-9);
    EXPECT_NEAR(side.from_m.y - side.from_radius_m, aim.water_m[i], 1e-9);
    EXPECT_TRUE(side.glows);
    EXPECT_EQ(aim_corner(to, i), glm::dvec2(side.from_m.x, side.from_m.z));
  }
}

// Up to the farthest jump it is seen at least as wide. Control: a width in metres alone.
TEST(AimShape, IsAsWideFarAway) {
  for (const double far_m : {2.0, 20.0, 200.0}) {
    std::vector<Limb> limbs;
    append_aim(aim_at({0.0, 0.0, -far_m}), eyes, limbs);
    for (const Limb& limb : limbs) {
      EXPECT_GE(limb.to_radius_m / glm::distance(limb.to_m, eyes), 0.0025) << far_m;
      EXPECT_LE(limb.to_radius_m, std::max(0.03, 0.003 * (far_m + 1.0))) << far_m;
    }
  }
}

// Without water a red line and no ring; without a hand a ring and no line. Controls: the ring drawn all the same; a
// line from the eyes.
TEST(AimShape, WhatIsNotThereIsNotDrawn) {
  std::vector<Limb> found, missed, by_head, close;
  append_aim(aim_at({0.0, 0.0, -5.0}), eyes, found);
  append_aim(aim_at({0.0, 2.0, -5.0}, false), eyes, missed);
  ASSERT_EQ(missed.size(), 1u);
  EXPECT_GT(missed[0].colour.x, 5.0f * missed[0].colour.y);
  EXPECT_NE(missed[0].colour, found[0].colour);
  ShownAim aim = aim_at({0.0, 0.0, -5.0});
  aim.from_m.reset();
  append_aim(aim, eyes, by_head);
  EXPECT_EQ(by_head.size(), ShownAim::sides);
  append_aim(aim_at(*aim_at({}).from_m), eyes, close);  // a hand at the water
  for (const Limb& limb : close) EXPECT_TRUE(std::isfinite(limb.from_m.x + limb.to_m.y));
}

}  // namespace
}  // namespace seascape
