// The sun's view of what stands around: it stands still while the viewer moves, and leaves out nobody who throws a
// shadow into it.
#include "app/solids/sun_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "app/solids/solid_instances.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

glm::dvec3 to_sun(double up_deg, double to_deg) {
  const double up = glm::radians(up_deg), to = glm::radians(to_deg);
  return {std::cos(up) * std::sin(to), std::sin(up), -std::cos(up) * std::cos(to)};
}

glm::dvec2 in_texels(const SunView& sun, const glm::dvec3& viewer, const glm::dvec3& place, int texels) {
  gpu::FrameData data{};
  sun.describe(data, viewer);
  const glm::vec4 from(glm::vec3(place - glm::dvec3(viewer.x, 0.0, viewer.z)), 1.0f);
  return glm::dvec2(glm::dot(data.sun_map_column, from), glm::dot(data.sun_map_row, from)) * double(texels);
}

// A place is at the same part of a texel, however the head moves. Control: `middle` not of whole texels.
TEST(SunView, StandsStillWhileTheHeadMoves) {
  constexpr int texels = 2048;
  for (const double up_deg : {4.0, 35.0, 89.99, 90.0}) {
    const glm::dvec3 sun = to_sun(up_deg, 130.0), place(2103.2, 1.5, -947.0), first(2100.0, 1.7, -950.0);
    const glm::dvec2 before = in_texels(sun_view(sun, first, texels, 60.0), first, place, texels);
    for (int i = 1; i < 300; ++i) {
      const glm::dvec3 head = first + glm::dvec3(0.01, 0.003, -0.007) * double(i);
      const glm::dvec2 off = in_texels(sun_view(sun, head, texels, 60.0), head, place, texels) - before;
      EXPECT_LT(glm::length(off - glm::round(off)), 5e-3) << up_deg << " " << i;
      EXPECT_LT(glm::length(off), 80.0);
    }
  }
}

// The map's middle is at the viewer, a texel off at most, and nearer the sun is more. Controls: `near` turned round.
TEST(SunView, TheViewerIsInItsMiddle) {
  const glm::dvec3 viewer(-310.0, 5.0, 72.0), sun = to_sun(20.0, 250.0);
  const SunView view = sun_view(sun, viewer, 1024, 40.0);
  const glm::dvec2 at = in_texels(view, viewer, {viewer.x, 0.0, viewer.z}, 1024);
  EXPECT_LE(std::abs(at.x - 512.5), 0.51);
  EXPECT_LE(std::abs(at.y - 512.5), 0.51);
  gpu::FrameData data{};
  view.describe(data, viewer);
  EXPECT_GT(glm::dot(glm::dvec3(data.sun_map_near), sun), 0.0);
  EXPECT_NEAR(glm::length(glm::dvec3(data.sun_map_column)) * 80.0, 1.0, 1e-6);
}

// Whoever stands between the sun and a place within reach is a caster, though he is out of the picture; nobody is when
// the sun is down. Control: `ahead` 0.5; `shines` always true.
TEST(SunView, WhoeverThrowsAShadowIntoItIsACaster) {
  const std::vector<PlacedModel> models{test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), "{}")};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  SolidSelection casters;
  const auto count = [&](const glm::dvec3& sun, const glm::dvec3& at) {
    const Pose head{{100.0, 1.7, 50.0}};
    const Viewpoint viewpoint{head, stereo_views(head, symmetric_fov(60.0, 1.5), 0.063), 0.0};
    const std::vector<SolidThing> things{{0, Pose{at}, 1.0}};
    select_casters(models, things, viewpoint, sun_view(sun, head.position_m, 1024, 50.0), 0.0, 1.0, casters);
    return casters.instances.size();
  };
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 sun = to_sun(2.0 + 80.0 * any(random), 360.0 * any(random));
    const double angle = 6.2831853 * any(random), away = 49.0 * any(random);
    const glm::dvec3 shaded(100.0 + away * std::cos(angle), 0.0, 50.0 + away * std::sin(angle));
    EXPECT_EQ(count(sun, shaded + sun * (200.0 * any(random))), 1u);
    EXPECT_EQ(count({sun.x, -sun.y, sun.z}, shaded), 0u);
  }
  EXPECT_EQ(count(to_sun(60.0, 0.0), {300.0, 0.0, 50.0}), 0u);
}

// A small thing far off throws its shadow where that may fall near the viewer, and nowhere else. Controls seen: its own
// distance; the line of its shadow towards the sun as well.
TEST(SunView, AShadowTooSmallToBeSeenIsLeftOut) {
  const std::vector<PlacedModel> models{test::solid_model(test::solid_box({0.1f, 0.1f, 0.1f}), "{}")};
  const Pose head{{0.0, 1.7, 0.0}};
  const Viewpoint viewpoint{head, stereo_views(head, symmetric_fov(60.0, 1.5), 0.063), 0.0};
  const glm::dvec3 sun = to_sun(20.0, 90.0);
  SolidSelection casters;
  const auto count = [&](const glm::dvec3& at) {
    const std::vector<SolidThing> things{{0, Pose{at}, 1.0}};
    select_casters(models, things, viewpoint, sun_view(sun, head.position_m, 1024, 50.0), 0.0, 1.0, casters);
    return casters.instances.size();
  };
  // Its ball is 0.35 m across: a degree at 20 m.
  EXPECT_EQ(count({0.0, 1.0, -19.0}), 1u);
  EXPECT_EQ(count({0.0, 1.0, -21.0}), 0u);
  EXPECT_EQ(count(head.position_m + 40.0 * sun + glm::dvec3(0.0, 0.0, -15.0)), 1u);
  EXPECT_EQ(count(head.position_m - 40.0 * sun), 0u);
}

// A sheet throws its shadow at the level that is seen, at any distance, and what is no sheet at a coarser one. Controls
// seen: a quarter of the detail for sheets; all of it for others.
TEST(SunView, SheetsThrowTheShadowOfWhatIsSeen) {
  const char* const nodes =
      R"({"mesh":0,"extensions":{"MSFT_lod":{"ids":[1,2]}},"extras":{"MSFT_screencoverage":[0.2,0.05,0.01]}},)"
      R"({"mesh":0},{"mesh":0})";
  const auto boxes = [&](const char* material) {
    return std::vector<PlacedModel>{
        test::solid_model(test::solid_box({1.0f, 1.0f, 1.0f}), material, nodes, R"(,"extensionsUsed":["MSFT_lod"])")};
  };
  const std::vector<PlacedModel> sheets = boxes(R"({"doubleSided":true})"), closed = boxes("{}");
  const Pose head{{0.0, 1.7, 0.0}};
  const Viewpoint viewpoint{head, stereo_views(head, symmetric_fov(60.0, 1.5), 0.063), 0.0};
  const SunView sun = sun_view(to_sun(40.0, 30.0), head.position_m, 1024, 300.0);
  SolidSelection seen, casters;
  std::array<int, 3> levels{};
  int coarser = 0;
  for (double away = 5.0; away < 200.0; away *= 1.07)
    for (const double detail : {0.5, 1.0}) {
      const std::vector<SolidThing> things{{0, Pose{{0.0, 1.0, -away}}, 1.0}};
      select_solids(sheets, things, viewpoint, 0.0, detail, seen);
      select_casters(sheets, things, viewpoint, sun, 0.0, detail, casters);
      ASSERT_EQ(seen.draws.size(), 1u) << away;
      ASSERT_EQ(casters.draws.size(), 1u) << away;
      EXPECT_EQ(casters.draws[0].part, seen.draws[0].part) << away;
      ++levels[std::size_t(sheets[0].parts()[seen.draws[0].part].level)];
      select_casters(closed, things, viewpoint, sun, 0.0, detail, casters);
      ASSERT_EQ(casters.draws.size(), 1u) << away;
      EXPECT_GE(casters.draws[0].part, seen.draws[0].part) << away;
      coarser += casters.draws[0].part > seen.draws[0].part;
    }
  EXPECT_GT(coarser, 20);
  for (const int count : levels) EXPECT_GT(count, 4);
}

}  // namespace
}  // namespace seascape
