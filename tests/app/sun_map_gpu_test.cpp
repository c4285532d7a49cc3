// Shadows of solid things, where rays to the sun say. Controls are named beside each test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/sky.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

class SunMapDrawn : public test::GpuTest {};

constexpr std::uint32_t width = 160, height = 120;
constexpr double reach_m = 20.0, texel_m = 2.0 * reach_m / 512.0;

SeaShot shot_of(const test::FrameLook& look, const SceneObjects& objects, double sun_up_deg, const char* texels) {
  return SeaShot(test::solid_options(look, objects, width, height,
                                     {{"waves.wind_speed_mps", "0"},
                                      {"waves.swell_height_m", "0"},
                                      {"sky.sun_elevation_deg", std::to_string(sun_up_deg)},
                                      {"sky.sun_to_deg", "65"},
                                      {"models.shadow_reach_m", std::to_string(reach_m)},
                                      {"models.shadow_texels", texels}}));
}

int light_of(const Image8& picture, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = &picture.pixels[4 * (std::size_t(y) * width + x)];
  return p[0] + p[1] + p[2];
}

// A map that is drawn into a share of its image is, to the bit, one of so many texels, though the rest of the image
// holds a finer one. Control seen: readers that ask in the whole image.
TEST_F(SunMapDrawn, AShareOfItIsASmallerOne) {
  SceneObjects objects;
  const char* const rough = R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.9}})";
  test::stand(objects, test::solid_model(test::solid_box(glm::vec3(0.5f)), rough), Pose{{0.0, 1.4, -4.0}});
  test::stand(objects, test::solid_model(test::solid_plate(20.0f), rough), Pose{{0.0, 0.5, -4.0}});
  const test::FrameLook look = test::sampled_looks().front();
  SeaShot whole = shot_of(look, objects, 40.0, "1024"), small = shot_of(look, objects, 40.0, "512");
  const Pose head = pose({-1.0, 8.0, -2.0}, 0.0, -75.0);
  const Image8 finest = whole.picture(head, 0.0);
  DrawnQuality half;
  half.shadows = 0.5;
  whole.experience().draw_at(half);
  const Image8 lowered = whole.picture(head, 0.0);
  const Image8 want = small.picture(head, 0.0);
  EXPECT_EQ(lowered.pixels, want.pixels) << test::leave(lowered, "sun_map_share");
  EXPECT_NE(lowered.pixels, finest.pixels);
}

// A box above, or a thin wall that stands on it, over a plate or over the water: what lies two texels within their
// shadow is dark, what lies two texels outside is as without shadows, to a step of colour: so no plate shades itself
// and no shadow comes loose from its foot. Controls: sun_map_row turned round; asked four texels beside; no `from` and
// no `nearer` (a plate shades itself); `from` 30 texels off (a wall's shadow comes loose).
TEST_F(SunMapDrawn, ShadowsLieWhereRaysToTheSunSay) {
  for (const test::FrameLook& look : test::sampled_looks())
    for (const bool on_plate : {true, false})
      for (const double up_deg : {60.0, 12.0})
        for (const bool wall : {false, true}) {
          const std::string name =
              look.name + (on_plate ? "_plate" : "_water") + (wall ? "_wall" : "_box") + std::to_string(int(up_deg));
          SCOPED_TRACE(name);
          const double floor_m = on_plate ? 0.5 : 0.0;
          const glm::dvec3 half = wall ? glm::dvec3(0.05, 0.5, 2.0) : glm::dvec3(0.5);
          const glm::dvec3 middle(0.0, floor_m + half.y + (wall ? 0.0 : 0.4), -4.0);
          SceneObjects objects;
          const char* const rough = R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.9}})";
          test::stand(objects, test::solid_model(test::solid_box(glm::vec3(half)), rough), Pose{middle});
          if (on_plate)
            test::stand(objects, test::solid_model(test::solid_plate(20.0f), rough), Pose{{0.0, floor_m, -4.0}});
          SeaShot with = shot_of(look, objects, up_deg, "512"), without = shot_of(look, objects, up_deg, "0");
          const Viewpoint viewpoint = with.viewpoint(pose({-1.0, 8.0, -2.0}, 0.0, -75.0));
          const Image8 shaded = with.picture(viewpoint, 1.0), bare = without.picture(viewpoint, 1.0);
          const glm::dvec3 sun = sun_direction(with.scene().settings.sky);
          const View& eye = viewpoint.eyes.front();
          int dark = 0, lit = 0, wrong = 0;
          for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) {
              const glm::dvec3 d = test::pixel_ray(eye, x + 0.5, y + 0.5, width, height), from = eye.pose.position_m;
              const double pixel_m = 0.12;
              if (d.y > -0.3 || test::meets_box(from, d, middle, half, pixel_m)) continue;
              const glm::dvec3 at = from + d * ((floor_m - from.y) / d.y);
              const int now = light_of(shaded, x, y), before = light_of(bare, x, y);
              if (test::meets_box(at, sun, middle, half, -2.0 * texel_m)) {
                ++dark;
                wrong += now > 0.97 * before;
              } else if (!test::meets_box(at, sun, middle, half, 2.0 * texel_m)) {
                ++lit;
                wrong += std::abs(now - before) > 3;
              }
            }
          EXPECT_GT(dark, 20);
          EXPECT_GT(lit, 8000);
          EXPECT_EQ(wrong, 0) << dark << " " << lit << test::leave(shaded, "sun_map_" + name)
                              << test::leave(bare, "sun_map_bare_" + name);
        }
}

int passes_into_map(SeaShot& shot) {
  const auto& work = shot.experience().frame().work();
  return int(std::count_if(work.begin(), work.end(), [](const auto& w) { return std::string(w.pass) == "sun map"; }));
}

int objects_of_map() {
  const auto objects = test::device().objects();
  return int(std::count_if(objects.begin(), objects.end(), [](const auto& o) {
    return o.name.find("sun map") != std::string::npos || o.name.find("sun_map") != std::string::npos;
  }));
}

// With 0 texels nothing of it is made or drawn; else it is drawn only while something throws a shadow and the sun is
// up, and nothing is made after the first frame. Controls: Experience that always makes it; may_shade() that is always
// true.
TEST_F(SunMapDrawn, OnlyWhatIsAskedForIsThere) {
  SceneObjects objects;
  test::stand(objects, test::solid_model(test::solid_box({0.5f, 0.5f, 0.5f}), "{}"), Pose{{0.0, 1.0, -5.0}});
  const Pose head = pose({0.0, 2.0, 0.0}, 0.0, -20.0), far = pose({500.0, 2.0, 0.0}, 0.0, -20.0);
  for (const test::FrameLook& look : test::sampled_looks()) {
    {
      SeaShot none = shot_of(look, objects, 40.0, "0");
      none.draw(head, 1.0);
      EXPECT_EQ(passes_into_map(none), 0) << look.name;
      EXPECT_EQ(objects_of_map(), 0) << look.name;
    }
    SeaShot shot = shot_of(look, objects, 40.0, "512");
    shot.draw(head, 1.0);
    EXPECT_EQ(passes_into_map(shot), 1) << look.name;
    EXPECT_GT(objects_of_map(), 2) << look.name;
    const std::size_t held = test::device().objects().size();
    shot.draw(far, 1.1);
    EXPECT_EQ(passes_into_map(shot), 0) << look.name;
    shot.draw(head, 1.2);
    shot.set("sky.sun_elevation_deg", "-3");
    shot.draw(head, 1.3);
    EXPECT_EQ(passes_into_map(shot), 0) << look.name;
    EXPECT_EQ(test::device().objects().size(), held) << look.name;
  }
}

}  // namespace
}  // namespace seascape
