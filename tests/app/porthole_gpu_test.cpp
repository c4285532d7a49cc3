// The window of the scene `porthole`'s barge, which rolls at her moorings with her window half in the water.
#include <gtest/gtest.h>

#include <cmath>

#include "app/boats/path_on_body.h"
#include "app/water_shapes.h"
#include "engine/multiview_check.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/portal_pixels.h"
#include "tests/support/gpu/waterline.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

using test::SeaShot;
using test::Through;

class Porthole : public test::GpuTest {};

constexpr std::uint32_t width = 96, height = 72;

test::ShotOptions options() {
  return {.scene = "porthole",
          .preset = "low",
          .width = width,
          .height = height,
          .views = 2,
          .per_eye = !multiview_works(test::device(), test::shaders()),
          .set = {{"msaa", "1"}, {"frame.lighting", "deferred"}, {"frame.shape", "tile"}}};
}

// Ten seconds aboard at 60 frames a second, each eye: a pixel whose line comes through the window is wet where it does
// so below the sea that is felt there, but within 6 cm of it (the window takes the sea for a plane), and but for one in
// 10,000 at the horizon itself, where the last triangles are hit or missed. No other pixel is wet: outside of the
// window's outline the picture is that of the scene without it to the bit. Both kinds of pixels are there. All frames
// with SEASCAPE_LONG, else four. Controls: the sea 15 cm higher, below; the window left where the barge was at the
// start; the horizon taken for the sky in it.
TEST_F(Porthole, InABoatThatRollsShowsTheSeaWhereItStands) {
  const CameraPath path = load_camera_path("porthole_barge");
  test::ShotOptions without = options();
  without.shapes.portals = {PlacedShape{.form = gpu::shape_disc, .pose = {{0.0, 500.0, 0.0}, {}}}};
  SeaShot shot(options()), bare(without);
  int wet = 0, dry = 0, wrong = 0, outside = 0, differ = 0, at_horizon = 0, wrong_if_higher = 0, drawn = 0;
  std::string first_fault;
  double least_roll = 1.0, most_roll = -1.0;
  glm::dvec3 viewer(0.0);
  const int first = test::long_run() ? 0 : 450, last = test::long_run() ? 600 : 510;
  for (int frame = first; frame < last; ++frame) {
    const PathSample sample = path.at(frame / 60.0);
    const double time_s = sample.scene_time_s;
    const Pose head = pose_in_world(shot.experience(), path, sample, time_s, viewer);
    const Pose same = pose_in_world(bare.experience(), path, sample, time_s, viewer);
    viewer = head.position_m;
    ASSERT_EQ(head.position_m, same.position_m) << frame;
    if (!test::sampled(std::size_t(frame), 15)) continue;
    ++drawn;
    const std::vector<Image8> seen = shot.pictures(head, time_s), plain = bare.pictures(head, time_s);
    const Viewpoint viewpoint = shot.viewpoint(head);
    const SeaView felt = shot.experience().sea()->view_at(time_s, SeaDetail::felt);
    const Scene& scene = shot.scene();
    const gpu::WaterShapes placed = placed_shapes(scene.shapes, scene.objects, head.position_m, &felt);
    const WaterLines lines{placed, 0, int(scene.shapes.portals.size())};
    const std::size_t barge = *scene.shapes.portals.back().on;
    const double roll = (scene.objects.things[barge].pose.orientation * glm::dvec3(1.0, 0.0, 0.0)).y;
    least_roll = std::min(least_roll, roll);
    most_roll = std::max(most_roll, roll);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const View& view = viewpoint.eyes[eye];
      const glm::dvec3 from = view.pose.position_m - head.position_m;
      const std::vector<bool> shown = test::wet_pixels(shot, int(eye));
      for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
          const std::size_t n = std::size_t(y) * width + x;
          const Through window = test::through(lines, view, x, y, width, height, from);
          if (window == Through::unsure) continue;
          if (window == Through::none) {
            ++outside;
            wrong += shown[n];
            for (std::size_t c = 0; c < 3; ++c) differ += seen[eye].pixels[4 * n + c] != plain[eye].pixels[4 * n + c];
            continue;
          }
          const glm::dvec3 ray = test::pixel_ray(view, x + 0.5, y + 0.5, width, height);
          const glm::dvec2 behind = lines.portal_span(placed.portal[scene.shapes.portals.size() - 1], from, ray);
          if (behind.y <= behind.x) continue;  // through a window of the room
          const glm::dvec3 enters = view.pose.position_m + behind.x * ray;
          const double deep_m = felt.query({enters.x, enters.z}).height_m - enters.y;
          if (std::abs(deep_m) < 0.06) continue;
          ++(deep_m > 0.0 ? wet : dry);
          const bool off = shown[n] != (deep_m > 0.0);
          (std::abs(ray.y) < 5e-4 ? at_horizon : wrong) += off;
          wrong_if_higher += shown[n] != (deep_m + 0.15 > 0.0);
        }
    }
    if (wrong + differ > 0 && first_fault.empty())
      first_fault = "frame " + std::to_string(frame) + " " + test::leave(seen[0], "porthole_roll") + " " +
                    test::leave(plain[0], "porthole_bare");
  }
  EXPECT_EQ(wrong, 0) << "of " << wet + dry + outside << " pixels, " << first_fault;
  EXPECT_EQ(differ, 0) << first_fault;
  EXPECT_LE(at_horizon, (wet + dry) / 10000);
  EXPECT_GT(wet, 200 * drawn);
  EXPECT_GT(dry, 200 * drawn);
  EXPECT_GT(outside, 2000 * drawn);
  EXPECT_GT(wrong_if_higher, 20 * drawn) << "the control";
  EXPECT_GT(most_roll - least_roll, std::sin(glm::radians(test::long_run() ? 3.0 : 1.0)));
  RecordProperty("drawn", std::to_string(drawn) + " frames, " + std::to_string(wet) + " wet, " + std::to_string(dry) +
                              " dry, roll of " + std::to_string(glm::degrees(most_roll - least_roll)) + " degrees");
}

// What is left out of the sea, its bed and things because no portal shows it is in no pixel: the pictures are to the
// bit those of portals whose balls hold the eyes, for which all is drawn. From the room under the sea, aboard the
// barge, and before, beside and within the aquarium, both eyes. Controls seen: cones of half the angle for patches; for
// the bed; for things; portals that come up to the surface taken for deep ones.
TEST_F(Porthole, WhatIsLeftOutIsNotSeen) {
  struct From {
    const char* scene;
    glm::dvec3 at_m;
    double yaw_deg, pitch_deg;
  };
  const std::vector<From> all{{"porthole", {0.3, -5.7, 1.0}, 0, -3},     {"porthole", {1.2, -5.9, -1.0}, 40, -20},
                              {"porthole", {-1.4, -5.6, -0.5}, 325, 15}, {"porthole", {30.0, 0.3, 0.0}, 285, -5},
                              {"porthole", {30.2, 0.1, 0.3}, 270, -25},  {"aquarium", {0.0, -2.7, 2.0}, 0, -6},
                              {"aquarium", {4.5, -2.4, -2.0}, 310, -3},  {"aquarium", {0.5, -2.5, -5.0}, 20, 10}};
  for (const std::string scene : {"porthole", "aquarium"}) {
    test::ShotOptions made = options(), whole = options();
    made.scene = whole.scene = scene;
    whole.shapes = load_scene(scene, "low").shapes;
    for (PlacedShape& portal : whole.shapes.portals) portal.radius_m = 1000.0;
    SeaShot shot(made), complete(whole);
    double time_s = 4.0;
    std::uint64_t triangles = 0, of_complete = 0;
    for (const From& from : all) {
      if (from.scene != scene) continue;
      const Pose head = test::pose(from.at_m, from.yaw_deg, from.pitch_deg);
      const std::vector<Image8> seen = shot.pictures(head, time_s), expected = complete.pictures(head, time_s);
      triangles += shot.counts().triangles;
      of_complete += complete.counts().triangles;
      for (std::size_t eye = 0; eye < 2; ++eye)
        EXPECT_EQ(test::differing_pixels(seen[eye], expected[eye]), 0)
            << scene << " yaw " << from.yaw_deg << " eye " << eye << test::leave(seen[eye], "portal_sight_" + scene);
      time_s += 0.5;
    }
    if (scene == "porthole") {  // the aquarium fills the pictures
      EXPECT_LT(triangles, of_complete);
    }
  }
}

}  // namespace
}  // namespace seascape
