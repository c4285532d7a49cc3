// Which things stand above the water in which of the pictures that eyes in the water see them in.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "app/camera_path.h"
#include "app/solids/solid_instances.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

constexpr int sides = gpu::solids_above_sides;

bool in_picture(const glm::dvec3& away, int side) {
  const glm::vec4 clip = gpu::clip_above(glm::vec3(away), side);
  return clip.w > 0.0f && std::abs(clip.x) <= clip.w * 1.0001f && std::abs(clip.y) <= clip.w * 1.0001f;
}

// Control seen: side 2 not turned round.
TEST(SolidsAbove, EachDirectionIsInItsSidesPicture) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  std::array<int, sides> found{};
  for (int i = 0; i < 4000; ++i) {
    const glm::vec3 d(any(random), 0.6f + 0.9f * any(random), any(random));
    if (d.y < -0.99f * gpu::solids_above_down * std::max(std::abs(d.x), std::abs(d.z))) continue;
    const int side = gpu::side_above(d);
    ++found.at(std::size_t(side));
    EXPECT_TRUE(in_picture(d, side)) << d.x << ", " << d.y << ", " << d.z << ": " << side;
    for (int other = 0; other < sides; ++other) {
      const glm::vec3 own = gpu::in_side_above(d, other);
      if (other == side || own.z <= 0.0f) continue;
      EXPECT_GE(std::max(std::abs(own.x), std::abs(own.y)), 0.9999f * own.z) << side << " and " << other;
    }
  }
  for (const int n : found) EXPECT_GT(n, 200);
}

// As an eye's picture is, or triangles would be seen from behind. Control seen: x of side 1 the other way.
TEST(SolidsAbove, NoPictureIsMirrored) {
  for (int side = 0; side < sides; ++side) {
    glm::mat3 axes(1.0f);
    for (int i = 0; i < 3; ++i) axes[i] = gpu::in_side_above(glm::mat3(1.0f)[i], side);
    EXPECT_FLOAT_EQ(glm::determinant(axes), -1.0f) << side;
  }
}

// Boxes in any pose: one of which a corner above the deepest trough lies in a side's picture is drawn there, and
// nothing is nearer than is said; one below all troughs is drawn nowhere. Controls seen: half the radius; the sides
// from level upwards only; parts below all troughs drawn; the nearest thing's middle for its nearest point.
TEST(SolidsAbove, WhatIsSeenIsInThePicturesOfItsSide) {
  const std::vector<PlacedModel> models{
      test::solid_model(test::solid_box({1.0f, 0.4f, 2.0f}), R"({"pbrMetallicRoughness":{"metallicFactor":0}})")};
  constexpr double deepest_m = 1.0, scale = 1.5;
  const Pose viewer{{3.0, -4.0, 7.0}};
  const glm::dvec3 middle(3.0, 0.3, 7.0);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::array<SolidSelection, sides> selected;
  int seen = 0, low = 0;
  for (int i = 0; i < 2000; ++i) {
    const SolidThing thing{0,
                           Pose{middle + glm::dvec3(20.0 * any(random), 2.0 + 8.0 * any(random), 20.0 * any(random)),
                                orientation_from_angles({180.0 * any(random), 90.0 * any(random), 90.0 * any(random)})},
                           scale};
    const double nearest = select_above(models, {&thing, 1}, viewer, middle, 512, 0.0, 1.0, deepest_m, selected);
    double highest = -1e9, range = 1e9;
    std::array<bool, sides> corner_in{};
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 own((corner & 1 ? 1.0 : -1.0), (corner & 2 ? 0.4 : -0.4), (corner & 4 ? 2.0 : -2.0));
      const glm::dvec3 at = thing.pose.position_m + thing.pose.orientation * (scale * own);
      highest = std::max(highest, at.y);
      range = std::min(range, glm::length(at - middle));
      for (int side = 0; side < sides; ++side)
        if (in_picture(at - middle, side)) corner_in.at(std::size_t(side)) = true;
    }
    if (highest < -deepest_m - 1e-6) {
      ++low;
      EXPECT_EQ(nearest, 0.0);
    } else if (nearest > 0.0) {
      EXPECT_LE(nearest, range + 1e-6);
    }
    for (std::size_t side = 0; side < sides; ++side) {
      const std::size_t drawn = selected.at(side).instances.size();
      if (highest < -deepest_m - 1e-6) {
        EXPECT_EQ(drawn, 0u) << i;
      } else if (corner_in.at(side) && highest > -deepest_m) {
        ++seen;
        EXPECT_EQ(drawn, 1u) << i << ", side " << side;
      }
    }
  }
  EXPECT_GT(seen, 1500);
  EXPECT_GT(low, 100);
}

}  // namespace
}  // namespace seascape
