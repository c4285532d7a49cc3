// Shadows of solid things beyond a box's: through holes, on land, towards the map's border, on a device that does not
// filter depths, for both eyes and while a head moves, and of round things on themselves. Controls are named beside
// each test.
#include <gtest/gtest.h>

#include <cmath>

#include "app/sky.h"
#include "engine/multiview_check.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/sampled.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::ShotOptions;

class SunMapShades : public test::GpuTest {};

constexpr std::uint32_t width = 160, height = 120;
constexpr double reach_m = 20.0, texel_m = 2.0 * reach_m / 512.0;
const char* const rough = R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.9}})";

ShotOptions options_of(const test::FrameLook& look, const SceneObjects& objects, double sun_up_deg,
                       const char* texels) {
  return test::solid_options(look, objects, width, height,
                             {{"waves.wind_speed_mps", "0"},
                              {"waves.swell_height_m", "0"},
                              {"sky.sun_elevation_deg", std::to_string(sun_up_deg)},
                              {"sky.sun_to_deg", "65"},
                              {"models.shadow_reach_m", std::to_string(reach_m)},
                              {"models.shadow_texels", texels}});
}

int light_of(const Image8& picture, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = &picture.pixels[4 * (std::size_t(y) * width + x)];
  return p[0] + p[1] + p[2];
}

struct Box {
  glm::dvec3 middle, half;
};

// Of the pixels of a level floor: how many lie two texels within the shadow of `caster` and how many two texels out of
// it, and how many of both are as they should not be: dark, and as without shadows to a step of colour. What `hides`
// stands in the way of is left out.
struct Floor {
  int dark = 0, lit = 0, wrong = 0;
};
Floor compared(const Image8& shaded, const Image8& bare, const View& eye, double floor_m, const glm::dvec3& sun,
               const Box& caster, const Box& hides) {
  Floor found;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const glm::dvec3 d = test::pixel_ray(eye, x + 0.5, y + 0.5, width, height), from = eye.pose.position_m;
      if (d.y > -0.3 || test::meets_box(from, d, hides.middle, hides.half, 0.12)) continue;
      const glm::dvec3 at = from + d * ((floor_m - from.y) / d.y);
      const int now = light_of(shaded, x, y), before = light_of(bare, x, y);
      if (test::meets_box(at, sun, caster.middle, caster.half, -2.0 * texel_m)) {
        ++found.dark;
        found.wrong += now > 0.97 * before;
      } else if (!test::meets_box(at, sun, caster.middle, caster.half, 2.0 * texel_m)) {
        ++found.lit;
        found.wrong += std::abs(now - before) > 3;
      }
    }
  return found;
}

const Pose above = pose({-1.0, 8.0, -2.0}, 0.0, -75.0);

// A mask cuts the left half out of a board: the sun comes through there. Control seen: the discard of sun_map.frag
// taken away.
TEST_F(SunMapShades, WhatAMaskCutsOutThrowsNone) {
  test::SolidShape board = test::solid_box({1.0f, 0.02f, 1.0f});
  for (std::size_t i = 0; i < board.positions.size(); i += 3)
    board.colours.insert(board.colours.end(), {1.0f, 1.0f, 1.0f, board.positions[i] > 0.0f ? 1.0f : 0.0f});
  const std::string mask =
      R"({"alphaMode":"MASK","alphaCutoff":0.5,"doubleSided":true,"pbrMetallicRoughness":{"metallicFactor":0}})";
  const double floor_m = 0.5;
  const glm::dvec3 middle(0.0, 1.8, -4.0);
  SceneObjects objects;
  test::stand(objects, test::solid_model(board, mask), Pose{middle});
  test::stand(objects, test::solid_model(test::solid_plate(20.0f), rough), Pose{{0.0, floor_m, -4.0}});
  const Box whole{middle, {1.0, 0.02, 1.0}}, right{middle + glm::dvec3(0.5, 0.0, 0.0), {0.5, 0.02, 1.0}};
  for (const test::FrameLook& look : test::sampled_looks()) {
    SeaShot with(options_of(look, objects, 50.0, "512")), without(options_of(look, objects, 50.0, "0"));
    const Viewpoint viewpoint = with.viewpoint(above);
    const Image8 shaded = with.picture(viewpoint, 1.0), bare = without.picture(viewpoint, 1.0);
    const glm::dvec3 sun = sun_direction(with.scene().settings.sky);
    const Floor floor = compared(shaded, bare, viewpoint.eyes.front(), floor_m, sun, right, whole);
    EXPECT_GT(floor.dark, 40) << look.name;
    EXPECT_GT(floor.lit, 8000) << look.name;
    EXPECT_EQ(floor.wrong, 0) << look.name << test::leave(shaded, "mask_" + look.name)
                              << test::leave(bare, "mask_bare_" + look.name);
  }
}

// A box over level land. Control seen: land asked 0.5 m beside (sun_reaches in lib/sea_light.glsl).
TEST_F(SunMapShades, LandIsShaded) {
  const double land_m = 1.0;
  InputSpec land;
  land.to = InputTarget::sea_depth;
  land.value = {float(land_m), 0.0f, 0.0f, 0.0f};
  land.blend = InputBlend::replace;
  land.feather_m = 4.0;
  land.shape = AreaInput{.round = false, .at_m = {0.0, 0.0}, .size_m = {120.0, 120.0}};
  const Box box{{0.0, land_m + 0.8, -4.0}, {0.5, 0.5, 0.5}};
  SceneObjects objects;
  test::stand(objects, test::solid_model(test::solid_box(glm::vec3(box.half)), rough), Pose{box.middle});
  for (const test::FrameLook& look : test::sampled_looks()) {
    ShotOptions options = options_of(look, objects, 50.0, "512");
    options.effects = {{"waves", "sea_depth", "models"}};
    options.inputs = {land};
    options.set.emplace_back("sea_depth.growth_m", "100");
    SeaShot with(options);
    options.set.emplace_back("models.shadow_texels", "0");
    SeaShot without(options);
    const Viewpoint viewpoint = with.viewpoint(above);
    const Image8 shaded = with.picture(viewpoint, 1.0), bare = without.picture(viewpoint, 1.0);
    const glm::dvec3 sun = sun_direction(with.scene().settings.sky);
    const Floor floor = compared(shaded, bare, viewpoint.eyes.front(), land_m, sun, box, box);
    EXPECT_GT(floor.dark, 100) << look.name;
    EXPECT_GT(floor.lit, 8000) << look.name;
    EXPECT_EQ(floor.wrong, 0) << look.name << test::leave(shaded, "land_" + look.name)
                              << test::leave(bare, "land_bare_" + look.name);
  }
}

// The shadow of a long wall fades out towards the map's border, without an edge. Control seen: `shown` 1 within the
// map.
TEST_F(SunMapShades, TheyFadeTowardsTheBorder) {
  const double floor_m = 0.5;
  const Box wall{{15.0, floor_m + 0.6, -3.0}, {14.0, 0.6, 0.05}};
  SceneObjects objects;
  test::stand(objects, test::solid_model(test::solid_box(glm::vec3(wall.half)), rough), Pose{wall.middle});
  test::stand(objects, test::solid_model(test::solid_plate(60.0f), rough), Pose{{0.0, floor_m, 0.0}});
  for (const test::FrameLook& look : test::sampled_looks()) {
    ShotOptions options = options_of(look, objects, 35.0, "512");
    options.set.emplace_back("sky.sun_to_deg", "0");
    SeaShot with(options);
    options.set.emplace_back("models.shadow_texels", "0");
    SeaShot without(options);
    Viewpoint viewpoint = with.viewpoint(pose({19.0, 9.0, 1.0}, 0.0, -70.0));
    viewpoint.viewer.position_m = {0.0, 2.0, 0.0};
    const Image8 shaded = with.picture(viewpoint, 1.0), bare = without.picture(viewpoint, 1.0);
    const glm::dvec3 sun = sun_direction(with.scene().settings.sky);
    const View& eye = viewpoint.eyes.front();
    double lost[14] = {}, all[14] = {};  // of the light by distance, in steps of 0.5 m from 15 m on
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const glm::dvec3 d = test::pixel_ray(eye, x + 0.5, y + 0.5, width, height), from = eye.pose.position_m;
        if (d.y > -0.3 || test::meets_box(from, d, wall.middle, wall.half, 0.12)) continue;
        const glm::dvec3 at = from + d * ((floor_m - from.y) / d.y);
        if (!test::meets_box(at, sun, wall.middle, wall.half, -2.0 * texel_m)) continue;
        const int step = int((std::hypot(at.x, at.z) - 15.0) / 0.5);
        if (step < 0 || step >= 14) continue;
        const std::size_t i = std::size_t(y) * width + x;
        lost[step] += test::light_at(bare, i).y - test::light_at(shaded, i).y;
        all[step] += test::light_at(bare, i).y;
      }
    const double whole = lost[0] / all[0];
    EXPECT_GT(whole, 0.2) << look.name;
    for (int step = 1; step < 14; ++step) {
      ASSERT_GT(all[step], 0.0) << look.name << step;
      const double share = lost[step] / all[step] / whole, before = lost[step - 1] / all[step - 1] / whole;
      EXPECT_LT(share, before + 0.03) << look.name << step << test::leave(shaded, "fade_" + look.name);
      EXPECT_GT(share, before - 0.45) << look.name << step << ": an edge";
    }
    EXPECT_GT(lost[3] / all[3] / whole, 0.95) << look.name << ": 16.75 m";
    EXPECT_LT(lost[10] / all[10] / whole, 0.02) << look.name << ": 20.25 m";
  }
}

// Where depths cannot be filtered its edges are of whole texels, at the same places. Control seen: a linear sampler
// there (the picture is as on the whole device).
TEST_F(SunMapShades, ADeviceThatDoesNotFilterDepths) {
  DeviceOptions floor_options;
  floor_options.validation = floor_options.core_only = true;
  Device least(floor_options);
  ASSERT_FALSE(least.facts().depth_linear);
  const double floor_m = 0.5;
  const Box box{{0.0, floor_m + 0.9, -4.0}, {0.5, 0.5, 0.5}};
  SceneObjects objects;
  test::stand(objects, test::solid_model(test::solid_box(glm::vec3(box.half)), rough), Pose{box.middle});
  test::stand(objects, test::solid_model(test::solid_plate(20.0f), rough), Pose{{0.0, floor_m, -4.0}});
  for (const test::FrameLook& look : {test::frame_looks[0], test::frame_looks[1]}) {
    Image8 filtered;
    if (test::device().facts().depth_linear)
      filtered = SeaShot(options_of(look, objects, 40.0, "512")).picture(above, 1.0);
    SeaShot with(least, options_of(look, objects, 40.0, "512")), without(least, options_of(look, objects, 40.0, "0"));
    const Viewpoint viewpoint = with.viewpoint(above);
    const Image8 shaded = with.picture(viewpoint, 1.0), bare = without.picture(viewpoint, 1.0);
    const glm::dvec3 sun = sun_direction(with.scene().settings.sky);
    const Floor floor = compared(shaded, bare, viewpoint.eyes.front(), floor_m, sun, box, box);
    EXPECT_GT(floor.dark, 100) << look.name;
    EXPECT_GT(floor.lit, 8000) << look.name;
    EXPECT_EQ(floor.wrong, 0) << look.name << test::leave(shaded, "unfiltered_" + look.name);
    if (filtered.pixels.empty()) continue;
    EXPECT_GT(test::differing_pixels(filtered, shaded), 20) << look.name;
  }
}

// Eyes 0.6 m apart see the shadow of one box where each one's rays to the floor and on to the sun say; and while the
// head moves on before eyes that stand still, no pixel of it changes by more than rounding. Control seen: `middle`
// of sun_view() not of whole texels.
TEST_F(SunMapShades, BothEyesSeeOneShadowThatStandsStill) {
  const double floor_m = 0.5;
  const Box box{{0.0, floor_m + 0.9, -4.0}, {0.5, 0.5, 0.5}};
  SceneObjects objects;
  test::stand(objects, test::solid_model(test::solid_box(glm::vec3(box.half)), rough), Pose{box.middle});
  test::stand(objects, test::solid_model(test::solid_plate(20.0f), rough), Pose{{0.0, floor_m, -4.0}});
  for (const test::FrameLook& look : test::sampled_looks()) {
    ShotOptions options = options_of(look, objects, 40.0, "512"), none = options_of(look, objects, 40.0, "0");
    options.views = none.views = 2;
    options.per_eye = none.per_eye = !multiview_works(test::device(), test::shaders());
    SeaShot with(options), without(none);
    const glm::dvec3 sun = sun_direction(with.scene().settings.sky);
    Viewpoint viewpoint{above, stereo_views(above, symmetric_fov(60.0, 4.0 / 3.0), 0.6), 0.0};
    const std::vector<Image8> shaded = with.pictures(viewpoint, 1.0), bare = without.pictures(viewpoint, 1.0);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const Floor floor = compared(shaded[eye], bare[eye], viewpoint.eyes[eye], floor_m, sun, box, box);
      EXPECT_GT(floor.dark, 100) << look.name << eye;
      EXPECT_GT(floor.lit, 6000) << look.name << eye;
      EXPECT_EQ(floor.wrong, 0) << look.name << eye << test::leave(shaded[eye], "eyes_" + look.name);
    }
    for (int i = 1; i < 12; ++i) {
      viewpoint.viewer.position_m = above.position_m + glm::dvec3(0.043, 0.01, -0.027) * double(i);
      const std::vector<Image8> moved = with.pictures(viewpoint, 1.0);
      for (std::size_t eye = 0; eye < 2; ++eye) {
        int most = 0;
        for (std::uint32_t y = 0; y < height; ++y)
          for (std::uint32_t x = 0; x < width; ++x)
            most = std::max(most, std::abs(light_of(moved[eye], x, y) - light_of(shaded[eye], x, y)));
        EXPECT_LE(most, 6) << look.name << eye << " " << i << test::leave(moved[eye], "moved_" + look.name);
      }
    }
  }
}

// A round pile of few sides is as light where it turns from the sun with its shadows as without: its triangles do not
// hide from the sun what their normals have lit. Control seen: `reaches` alone in sun_reaches_thing() of
// lib/solid_light.glsl.
TEST_F(SunMapShades, RoundThingsDoNotShadeThemselves) {
  SceneObjects objects;
  test::stand(objects, test::solid_model(test::solid_pile(1.5f, -1.0f, 5.0f, 10), rough), Pose{{0.0, 0.0, -6.0}});
  std::size_t number = 0;
  for (const test::FrameLook& look : test::sampled_looks())
    for (const char* to_deg : {"80", "85", "90", "97", "104", "110", "117", "123"}) {
      if (!test::sampled(number++, 2)) continue;
      ShotOptions options = options_of(look, objects, 15.0, "2048");
      options.set.emplace_back("sky.sun_to_deg", to_deg);
      SeaShot with(options);
      options.set.emplace_back("models.shadow_texels", "0");
      SeaShot without(options);
      const Viewpoint viewpoint = with.viewpoint(pose({0.0, 2.0, 0.0}, 0.0, 0.0));
      const Image8 shaded = with.picture(viewpoint, 1.0), bare = without.picture(viewpoint, 1.0);
      int wrong = 0, seen = 0, most = 0;
      for (std::uint32_t y = height / 4; y < height / 2; ++y)
        for (std::uint32_t x = width / 4; x < width * 3 / 4; ++x) {
          const glm::dvec3 d = test::pixel_ray(viewpoint.eyes.front(), x + 0.5, y + 0.5, width, height);
          if (!test::meets_box(viewpoint.eyes.front().pose.position_m, d, {0.0, 2.0, -6.0}, {0.95, 3.0, 0.95}, 0.0))
            continue;
          ++seen;
          const int off = std::abs(light_of(shaded, x, y) - light_of(bare, x, y));
          most = std::max(most, off);
          wrong += off > 15;  // of 765
        }
      EXPECT_GT(seen, 500) << look.name;
      EXPECT_EQ(wrong, 0) << look.name << " " << to_deg << ", most " << most
                          << test::leave(shaded, std::string("round_") + to_deg)
                          << test::leave(bare, std::string("round_bare_") + to_deg);
    }
}

// In a wall's shade a round pile of few sides is as dark everywhere as one of many. Control seen: sun_reaches_thing()
// of lib/solid_light.glsl without its second sun_reaches(), by which such triangles are sunlit in any shade.
TEST_F(SunMapShades, RoundThingsAreShadedByOthers) {
  for (const test::FrameLook& look : test::sampled_looks())
    for (const char* to_deg : {"90", "104", "117"}) {
      const auto drawn = [&](int sides, const char* texels) {
        SceneObjects objects;
        test::stand(objects, test::solid_model(test::solid_pile(1.5f, -1.0f, 5.0f, sides), rough),
                    Pose{{0.0, 0.0, -6.0}});
        test::stand(objects, test::solid_model(test::solid_box({0.3f, 8.0f, 10.0f}), rough), Pose{{8.0, 4.0, -6.0}});
        ShotOptions options = options_of(look, objects, 15.0, texels);
        options.set.emplace_back("sky.sun_to_deg", to_deg);
        return SeaShot(options).picture(pose({0.0, 2.0, 0.0}, 0.0, 0.0), 1.0);
      };
      const Image8 few = drawn(10, "2048"), many = drawn(96, "2048"), bare = drawn(10, "0");
      int wrong = 0, most = 0, shaded = 0;
      for (std::uint32_t y = height / 4; y < height / 2; ++y)
        for (std::uint32_t x = width / 2 - 18; x < width / 2 + 18; ++x) {
          const int off = std::abs(light_of(few, x, y) - light_of(many, x, y));
          most = std::max(most, off);
          wrong += off > 15;  // of 765
          shaded += light_of(bare, x, y) > light_of(few, x, y) + 60;
        }
      EXPECT_GT(shaded, 100) << look.name << " " << to_deg << test::leave(bare, std::string("shaded_bare_") + to_deg);
      EXPECT_EQ(wrong, 0) << look.name << " " << to_deg << ", most " << most
                          << test::leave(few, std::string("shaded_round_") + to_deg)
                          << test::leave(many, std::string("shaded_many_") + to_deg);
    }
}

}  // namespace
}  // namespace seascape
