// Every scene in content/scenes from above its sea, from just below it, and from the deep, with both eyes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/scene.h"
#include "engine/multiview_check.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/solid_shot.h"
#include "tests/support/gpu/waterline.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

class ScenesUnderWater : public test::GpuTest {};

constexpr std::uint32_t width = 72, height = 54;

// The deepest water within 60 m of where the scene's camera is, away from what stands there.
glm::dvec2 over_water(const SeaView& sea, const Scene& scene) {
  const glm::dvec3& camera = scene.start.position_m;
  glm::dvec2 best(camera.x, camera.z);
  double deepest_m = -1.0;
  for (int x = -6; x <= 6; ++x)
    for (int z = -6; z <= 6; ++z) {
      const glm::dvec2 at(camera.x + 10.0 * x, camera.z + 10.0 * z);
      const QueryAnswer water = sea.query(at);
      const bool apart = std::ranges::none_of(scene.objects.things, [&](const auto& thing) {
        return glm::distance(glm::dvec2(thing.pose.position_m.x, thing.pose.position_m.z), at) < 12.0;
      });
      if (!apart || water.clipped || water.depth_m <= deepest_m) continue;
      deepest_m = water.depth_m;
      best = at;
    }
  return best;
}

// The largest step from pixel to pixel upwards, within four degrees of the horizon, beyond the steps over and under it:
// of 255, the mean over the columns that it runs through.
double line_near_horizon(const Image8& picture, const View& eye) {
  double most = 0.0;
  for (int off = -2; off <= 3; ++off) {  // rows from the horizon
    double sum = 0.0;
    int columns = 0;
    for (std::uint32_t x = 0; x < width; ++x)
      for (std::uint32_t y = 4; y + 5 < height; ++y) {
        const auto rises = [&](std::uint32_t row) { return test::pixel_ray(eye, x + 0.5, row + 0.5, width, height).y; };
        if (rises(y) < 0.0 || rises(y + 1) > 0.0) continue;
        const auto step = [&](int rows_up) {
          const std::size_t n = 4 * (std::size_t(int(y) - rows_up) * width + x);
          double all = 0.0;
          for (std::size_t c = 0; c < 3; ++c)
            all += std::abs(int(picture.pixels[n + c]) - int(picture.pixels[n + c + 4 * width]));
          return all / 3.0;
        };
        sum += step(off) - std::max(step(off - 1), step(off + 1));
        ++columns;
      }
    if (columns > int(width) / 2) most = std::max(most, sum / columns);
  }
  return most;
}

// At 1.5 m over the water no pixel of either eye begins in it, from 1.5 m below on every one does; nothing is a hole,
// no picture is black, and from 3 m below on there is no line at the horizon where no thing stands: all scenes with
// SEASCAPE_LONG, else one in ten. Scenes with portals show no sea where none is in sight. The bed comes before the
// deep. Controls: a patch left out, below; open water a fifth brighter (surface_light.frag).
TEST_F(ScenesUnderWater, NoAirBelowAndNoWaterAbove) {
  std::size_t number = 0;
  bool planted = false;
  for (const std::string& name : content_names("scenes")) {
    if (!test::sampled(number++, 10)) continue;
    SCOPED_TRACE(name);
    SeaShot shot({.scene = name,
                  .preset = "low",
                  .width = width,
                  .height = height,
                  .views = 2,
                  .per_eye = !multiview_works(test::device(), test::shaders()),
                  .set = {{"msaa", "1"},
                          {"frame.lighting", "deferred"},
                          {"frame.shape", "tile"},
                          {"debug.view", "holes"},
                          {"comfort.clear_lens", "true"}}});
    ASSERT_TRUE(shot.experience().underwater());
    const bool portals = !shot.scene().shapes.portals.empty();
    const double time_s = 20.0;
    const glm::dvec3 start = shot.scene().start.position_m;
    shot.draw(pose(start, 0.0, 0.0), time_s);
    const SeaView sea = shot.experience().sea()->view_at(time_s, SeaDetail::felt);
    const glm::dvec2 at = over_water(sea, shot.scene());
    const QueryAnswer water = sea.query(at);
    int deep = 0;
    for (const double up_m : {1.5, -1.5, -3.0, -30.0}) {
      if (water.depth_m + water.height_m - water.still_m < 0.4 - up_m) continue;
      SCOPED_TRACE(std::to_string(up_m) + " m");
      deep += up_m < 0.0;
      for (const double pitch : {0.0, -50.0, 60.0}) {
        const Pose head = pose({at.x, water.height_m + up_m, at.y}, 40.0, pitch, 10.0);
        const std::vector<Image8> pictures = shot.pictures(head, time_s);
        for (int eye = 0; eye < 2; ++eye) {
          const Image8& picture = pictures[std::size_t(eye)];
          const auto left = [&] { return " " + test::leave(picture, "under_" + name); };
          EXPECT_GT(test::statistics(picture).mean, up_m < -10.0 ? 4.0 : 12.0) << pitch << left();
          if (portals) continue;
          EXPECT_EQ(test::count_colour(picture, 255, 0, 255), 0) << pitch << left();
          const std::vector<bool> wet = test::wet_pixels(shot, eye);
          const auto count = std::size_t(std::count(wet.begin(), wet.end(), true));
          EXPECT_EQ(count, up_m < 0.0 ? wet.size() : 0) << pitch << left();
          if (up_m <= -3.0 && shot.scene().objects.things.empty()) {
            EXPECT_LE(line_near_horizon(picture, shot.viewpoint(head).eyes[std::size_t(eye)]), 0.4) << pitch << left();
          }
        }
      }
    }
    if (!portals && !std::exchange(planted, true)) {
      int holes = 0;
      for (int patch = 0; patch < 64 && holes == 0; ++patch) {
        shot.set("debug.drop_patch", std::to_string(patch));
        const Image8 picture = shot.picture(pose({at.x, water.height_m + 1.5, at.y}, 40.0, -50.0, 10.0), time_s);
        holes = test::count_colour(picture, 255, 0, 255);
      }
      EXPECT_GT(holes, 0) << "the control";
    }
    RecordProperty(name, std::to_string(deep) + " depths, water of " + std::to_string(water.depth_m) + " m");
  }
}

}  // namespace
}  // namespace seascape
