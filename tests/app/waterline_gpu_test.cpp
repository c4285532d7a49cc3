// The waterline against the surface that is drawn and against the sea that is asked, and that it does not flicker.
// Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/multiview_check.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/waterline.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

using test::DrawnMesh;
using test::NearMesh;
using test::pose;
using test::SeaShot;

class Waterline : public test::GpuTest {};

constexpr std::uint32_t width = 96, height = 72;
constexpr double reach_m = 0.25;  // of the near plane's corners

// What of a scene makes its surface, lit later, so that the sides can be read.
test::ShotOptions options(const std::string& scene, double wind_mps, int views) {
  test::ShotOptions result{
      .scene = scene,
      .preset = "low",
      .width = width,
      .height = height,
      .views = views,
      .per_eye = views == 2 && !multiview_works(test::device(), test::shaders()),
      .probe = true,
      .set = {{"msaa", "1"}, {"waves.where", "cpu"}, {"frame.lighting", "deferred"}, {"frame.shape", "tile"}}};
  if (wind_mps >= 0.0) result.set.emplace_back("waves.wind_speed_mps", std::to_string(wind_mps));
  result.effects = load_scene(scene, "low").effects;
  std::erase_if(*result.effects, [](const std::string& effect) { return effect == "models" || effect == "boats"; });
  return result;
}

// The water where the mesh about an eye's near plane rests.
NearMesh near_mesh(const DrawnMesh& mesh, const QueryAnswer& water, const glm::dvec3& eye) {
  return NearMesh(mesh, {eye.x - water.displacement.x, eye.z - water.displacement.z}, 2.0 * reach_m + water.residual_m);
}

struct Compared {
  int pairs = 0, wet = 0, unsure = 0, wrong = 0, asked = 0, not_as_asked = 0;
  int wrong_if_lower = 0;  // against a mesh that is taken to lie 3 mm lower
  double worst_m = 0.0;    // of those that are wrong: how far from the surface
};

// Pixels of both eyes, `a_pose` of them a pose, against mesh and query; poses that turn to all sides, rolled, within
// 3 cm of the water.
Compared compare(SeaShot& shot, glm::dvec2 about, double around_m, int poses, int a_pose) {
  std::mt19937 random(7);
  const auto chance = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const double near_m = shot.scene().settings.render.near_m;
  Compared sum;
  for (int n = 0; n < poses; ++n) {
    const double time_s = 20.0 + 0.37 * n;
    const glm::dvec2 at = about + around_m * glm::dvec2(chance(-1.0, 1.0), chance(-1.0, 1.0));
    const QueryAnswer here = test::drawn_water(shot, at, time_s);
    if (!here.converged || here.clipped || here.depth_m < 0.3) continue;
    const Viewpoint viewpoint = shot.viewpoint(pose({at.x, here.height_m + chance(-0.03, 0.03), at.y},
                                                    chance(-180.0, 180.0), chance(-35.0, 35.0), chance(-60.0, 60.0)));
    shot.draw(viewpoint, time_s);
    const DrawnMesh mesh(shot, viewpoint);
    const SeaView drawn = shot.experience().ocean().waves_held();
    for (int eye = 0; eye < 2; ++eye) {
      const View& view = viewpoint.eyes[std::size_t(eye)];
      const double pixel_m = near_m * (view.fov.up - view.fov.down) / height;
      const NearMesh near = near_mesh(mesh, here, view.pose.position_m);
      const std::vector<bool> shown = test::wet_pixels(shot, eye);
      for (int i = 0; i < a_pose / 2; ++i) {
        const auto x = std::uint32_t(chance(0.0, width - 1e-6)), y = std::uint32_t(chance(0.0, height - 1e-6));
        const glm::dvec3 from = test::on_near_plane(view, x + 0.5, y + 0.5, width, height, near_m);
        const bool wet = near.sheets_over(from) > 0, as_wet = shown[std::size_t(y) * width + x];
        const double off_m = near.distance(from);
        const glm::dvec3 raised = from + glm::dvec3(0.0, 0.003, 0.0);
        sum.wrong_if_lower += near.distance(raised) >= pixel_m && (near.sheets_over(raised) > 0) != as_wet;
        ++sum.pairs, sum.wet += wet;
        if (off_m < pixel_m) {
          ++sum.unsure;
        } else if (wet != as_wet) {
          ++sum.wrong;
          sum.worst_m = std::max(sum.worst_m, off_m);
        }
        if (i % 8 != 0) continue;
        const QueryAnswer water = drawn.query({from.x, from.z});
        if (!water.converged || std::abs(from.y - water.height_m) < std::max(0.005, pixel_m)) continue;
        ++sum.asked;
        sum.not_as_asked += (from.y < water.height_m) != as_wet;
      }
    }
  }
  return sum;
}

struct Place {
  const char* scene;
  double wind_mps;  // below 0: the scene's own
  glm::dvec2 about;
  double around_m;
};

// The scene `waterline` from calm to gale, and two more that name the effect, whose water is over a bed: each pixel is
// on the side of the triangles that are drawn, but within a pixel of them; and, beyond 5 mm, of the sea that is asked,
// where that converged. 100,000 pairs of pixel and pose a scene with SEASCAPE_LONG; else of a breeze and the lagoon.
// Controls: a mesh that is taken to lie 3 mm lower, below; near_side.frag that marks nothing.
TEST_F(Waterline, IsTheDrawnSurfaces) {
  for (const Place& place : {Place{"waterline", 2.0, {0.0, 0.0}, 60.0}, Place{"waterline", 6.0, {0.0, 0.0}, 60.0},
                             Place{"waterline", 20.0, {0.0, 0.0}, 60.0}, Place{"lagoon", -1.0, {-62.0, -140.0}, 12.0},
                             Place{"harbour", -1.0, {60.0, 60.0}, 12.0}}) {
    SCOPED_TRACE(std::string(place.scene) + " " + std::to_string(place.wind_mps));
    const bool of_many = std::string(place.scene) == "waterline";
    if (!test::long_run() && place.wind_mps != 6.0 && std::string(place.scene) != "lagoon") continue;
    const int poses = test::long_run() ? (of_many ? 40 : 110) : 2;
    SeaShot shot(options(place.scene, place.wind_mps, 2));
    const Compared found = compare(shot, place.about, place.around_m, poses, 1000);
    EXPECT_GE(found.pairs, test::long_run() ? (of_many ? 34000 : 100000) : 2000);
    EXPECT_GT(found.wrong_if_lower, found.pairs / 300) << "the control";
    EXPECT_EQ(found.wrong, 0) << "up to " << found.worst_m << " m off, of " << found.pairs;
    EXPECT_LT(found.unsure, 0.06 * found.pairs);
    EXPECT_GT(found.wet, 0.2 * found.pairs);
    EXPECT_LT(found.wet, 0.8 * found.pairs);
    EXPECT_EQ(found.not_as_asked, 0) << "of " << found.asked;
    EXPECT_GT(found.asked, 0.08 * found.pairs);
    RecordProperty(std::string(place.scene) + std::to_string(int(place.wind_mps)),
                   std::to_string(found.pairs) + " pairs, " + std::to_string(found.unsure) + " within a pixel, " +
                       std::to_string(found.asked) + " asked, " + std::to_string(found.wrong_if_lower) + " if lower");
  }
}

// Of a mesh so fine that thousands of its patches may pass a near plane. Control seen: room for 1,024.
TEST_F(Waterline, IsTheDrawnSurfacesWhereItsPatchesAreManyMore) {
  test::ShotOptions fine = options("waterline", 6.0, 2);
  fine.set.insert(fine.set.end(), {{"lod.by", "threshold"},
                                   {"lod.threshold", "1.6"},
                                   {"lod.patch_quads", "64"},
                                   {"lod.levels", "12"},
                                   {"lod.ocean_size_m", "256"}});
  SeaShot shot(fine);
  const Compared found = compare(shot, {0.0, 0.0}, 60.0, 1, 200);
  EXPECT_GT(shot.experience().surface().near_lines().patches(), 1024u);
  EXPECT_LT(shot.experience().surface().near_lines().patches(), NearLines::room);
  EXPECT_EQ(found.wrong, 0) << "up to " << found.worst_m << " m off, of " << found.pairs;
  EXPECT_GT(found.wet, 0.2 * found.pairs);
  EXPECT_LT(found.wet, 0.8 * found.pairs);
}

// An eye that is exactly on the surface, where the sea that is asked has it, at 90 pictures a second: no pixel changes
// its side and changes back within three frames, but where the drawn surface passed within a pixel of it in them. 1,000
// frames with SEASCAPE_LONG. Control: every third frame's sides taken from a surface 4 mm higher.
TEST_F(Waterline, DoesNotFlicker) {
  const int frames = test::long_run() ? 1000 : 24;
  for (const bool planted : {false, true}) {
    SeaShot shot(options("waterline", 8.0, 1));
    const double near_m = shot.scene().settings.render.near_m;
    std::vector<std::vector<bool>> sides;
    std::vector<NearMesh> meshes;
    std::vector<View> eyes;
    int flickers = 0, changes = 0;
    const int count = planted ? 12 : frames;
    for (int n = 0; n < count; ++n) {
      const double time_s = 30.0 + n / 90.0;
      const glm::dvec2 at(3.0, -4.0);
      const QueryAnswer water = test::drawn_water(shot, at, time_s);
      const double up_m = planted && n % 3 == 0 ? -0.004 : 0.0;
      const Viewpoint viewpoint = shot.viewpoint(pose({at.x, water.height_m + up_m, at.y}, 20.0, 0.0, 8.0));
      shot.draw(viewpoint, time_s);
      sides.push_back(test::wet_pixels(shot, 0));
      // What is planted is not known to the mesh.
      const DrawnMesh mesh(shot, viewpoint);
      meshes.push_back(near_mesh(mesh, water, viewpoint.eyes[0].pose.position_m));
      eyes.push_back(viewpoint.eyes[0]);
      eyes.back().pose.position_m.y -= up_m;
      if (n < 3) continue;
      const double pixel_m = near_m * (eyes[0].fov.up - eyes[0].fov.down) / height;
      const auto begins = [&](std::size_t frame, std::size_t pixel) {
        return test::on_near_plane(eyes[frame], double(pixel % width) + 0.5, double(pixel / width) + 0.5, width, height,
                                   near_m);
      };
      const std::size_t last = sides.size() - 1;
      for (std::size_t pixel = 0; pixel < sides[last].size(); ++pixel) {
        const bool before = sides[last - 3][pixel], first = sides[last - 2][pixel], second = sides[last - 1][pixel],
                   now = sides[last][pixel];
        changes += second != now;
        if (!((first != before && second == before) || (first != before && second != before && now == before)))
          continue;
        bool passed = false;
        const bool in_water = meshes[last].sheets_over(begins(last, pixel)) > 0;
        for (std::size_t frame = last - 3; frame <= last && !passed; ++frame)
          passed = meshes[frame].distance(begins(frame, pixel)) < pixel_m ||
                   (meshes[frame].sheets_over(begins(frame, pixel)) > 0) != in_water;
        flickers += !passed;
      }
    }
    if (planted) {
      EXPECT_GT(flickers, 20) << "the control";
    } else {
      EXPECT_EQ(flickers, 0);
      EXPECT_GT(changes, count);  // the water moves
    }
  }
}

}  // namespace
}  // namespace seascape
