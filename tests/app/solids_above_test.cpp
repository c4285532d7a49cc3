// Which things stand above the water in which of the pictures that eyes in the water see them in.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

#include "app/camera_path.h"
#include "app/solids/solid_instances.h"
#include "shaders/shared/fresnel.h"
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

const char* const plain = R"({"pbrMetallicRoughness":{"metallicFactor":0}})";
const glm::dvec3 box_half(0.3, 0.12, 0.6);

Viewpoint looking(const Pose& head) { return {head, stereo_views(head, symmetric_fov(70.0, 1.2), 0.063)}; }

// Where a ray (unit length) goes on that leaves water through a surface with this normal (unit length, upwards). Snell.
std::optional<glm::dvec3> leaves_along(const glm::dvec3& ray, const glm::dvec3& up) {
  const double index = gpu::water_index, along = glm::dot(ray, up), past = 1.0 - index * index * (1.0 - along * along);
  if (along <= 0.0 || past <= 0.0) return {};
  return index * ray + (std::sqrt(past) - index * along) * up;
}

// Boxes in any pose, of which light from a corner comes to an eye through the surface at any place and slope: each is
// drawn, and nothing is nearer to the pictures' middle than is said. Controls seen: half the radius; a turn of 35
// degrees at most; a side left out; the nearest thing's middle for its nearest point.
TEST(SolidsAbove, WhatLightThroughTheWaterComesFromIsDrawn) {
  const std::vector<PlacedModel> models{test::solid_model(test::solid_box(glm::vec3(box_half)), plain)};
  constexpr double deepest_m = 1.0, scale = 1.5;
  const double critical = std::asin(1.0 / double(gpu::water_index));
  const glm::dvec3 middle(3.0, 0.3, 7.0);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  SolidSelection selection;
  int seen = 0;
  for (int i = 0; i < 20000; ++i) {
    const Pose viewer{{3.0, -4.0, 7.0}, orientation_from_angles({180.0 * any(random), 80.0 * any(random), 0.0})};
    const Viewpoint viewpoint = looking(viewer);
    const View& eye = viewpoint.eyes[std::size_t(i % 2)];
    glm::dvec2 at(any(random), any(random));
    if (i % 3 == 0) at = glm::sign(at);  // the picture's corners
    const glm::dvec3 ray =
        eye.pose.orientation * glm::normalize(glm::dvec3(eye.fov.right * at.x, eye.fov.up * at.y, -1.0));
    const glm::dvec3 across = glm::normalize(glm::cross(ray, glm::dvec3(any(random), any(random), any(random))));
    const double incidence = critical * (1.0 - std::pow(any(random), 8.0));  // most turn light much
    const std::optional<glm::dvec3> leaves =
        leaves_along(ray, std::cos(incidence) * ray + std::sin(incidence) * across);
    if (!leaves) continue;
    const glm::dvec3 corner = eye.pose.position_m + std::exp2(3.0 * any(random)) * ray +
                              20.0 * std::exp2(3.0 * any(random) - 3.0) * *leaves,
                     own((i & 2 ? 1.0 : -1.0), (i & 4 ? 1.0 : -1.0), (i & 8 ? 1.0 : -1.0)), away = corner - middle;
    if (corner.y < -deepest_m) continue;
    if (away.y < -gpu::solids_above_down * std::max(std::abs(away.x), std::abs(away.z)))
      continue;  // under all pictures
    const glm::dquat turned = orientation_from_angles({180.0 * any(random), 90.0 * any(random), 90.0 * any(random)});
    const SolidThing thing{0, Pose{corner - turned * (scale * own * box_half), turned}, scale};
    const double nearest = select_above(models, {&thing, 1}, viewpoint, middle, 0.0, 1.0, deepest_m, selection);
    ++seen;
    EXPECT_TRUE(
        std::any_of(selection.instances.begin(), selection.instances.end(),
                    [&](const gpu::SolidInstance& instance) { return in_picture(away, int(instance.picture.x)); }))
        << i;
    EXPECT_GT(nearest, 0.0) << i;
    EXPECT_LE(nearest, glm::length(away)) << i;
  }
  EXPECT_GT(seen, 3000);
}

// Controls seen: a turn of 60 degrees; parts below all troughs drawn; no least size, and none for parts of a large
// thing.
TEST(SolidsAbove, WhatIsBehindBelowOrTooSmallIsNotDrawn) {
  const auto boxes = [](const char* nodes) {
    return std::vector<PlacedModel>{test::solid_model(test::solid_box({1.0f, 0.4f, 2.0f}), plain, nodes)};
  };
  const Viewpoint viewpoint = looking(Pose{{0.0, -2.0, 0.0}});
  SolidSelection selection;
  const auto drawn = [&](const std::vector<PlacedModel>& models, const glm::dvec3& at) {
    const SolidThing thing{0, Pose{at}, 1.0};
    const double nearest = select_above(models, {&thing, 1}, viewpoint, {0.0, 0.3, 0.0}, 0.0, 1.0, 1.0, selection);
    EXPECT_EQ(nearest > 0.0, !selection.draws.empty());
    return selection.instances.size();
  };
  const std::vector<PlacedModel> one = boxes(R"({"mesh":0})");
  EXPECT_EQ(drawn(one, {0.0, 3.0, -20.0}), 1u);
  EXPECT_EQ(drawn(one, {0.0, 3.0, 20.0}), 0u) << "behind";
  EXPECT_EQ(drawn(one, {20.0, 3.0, 0.0}), 1u) << "beside, which the surface may turn into sight";
  EXPECT_EQ(drawn(one, {19.0, 3.0, 6.0}), 0u) << "beside and a little behind";
  EXPECT_EQ(drawn(one, {0.0, -1.5, -20.0}), 0u) << "below all troughs";
  // Its ball is 4.6 m across.
  EXPECT_EQ(drawn(one, {0.0, 3.0, -90.0}), 1u);
  EXPECT_EQ(drawn(one, {0.0, 3.0, -120.0}), 0u) << "smaller than two degrees and a half";
  const std::vector<PlacedModel> low = boxes(R"({"children":[1,2]},{"mesh":0},{"mesh":0,"translation":[0,-6,0]})"),
                                 high = boxes(R"({"children":[1,2]},{"mesh":0},{"mesh":0,"translation":[0,20,0]})");
  EXPECT_EQ(drawn(low, {0.0, 3.0, -20.0}), 1u) << "the upper part alone";
  EXPECT_EQ(drawn(high, {0.0, 3.0, -40.0}), 2u);
  EXPECT_EQ(drawn(high, {0.0, 3.0, -70.0}), 0u) << "small beside the thing, and smaller than five degrees";
}

}  // namespace
}  // namespace seascape
