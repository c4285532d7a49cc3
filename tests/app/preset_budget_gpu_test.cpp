// The profiles of a standalone headset keep to its draws and triangles in every shipped scene.
#include <gtest/gtest.h>

#include "app/boats/path_on_body.h"
#include "app/effect_costs.h"
#include "app/lab/screen_error.h"
#include "app/sea_time.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

constexpr std::uint64_t most_draws = 100, most_triangles = 750'000;  // of a frame, both eyes together

struct Most {
  std::uint64_t draws = 0, triangles = 0;
};

// How many times a pass draws its triangles: once for each eye, or once for a picture that both eyes share.
std::uint64_t views_of(std::string_view pass) { return pass == "sun map" || pass == "above" ? 1 : 2; }

// The scene that a path is made for: the longest name that the path's begins with.
std::string scene_of(const std::string& path) {
  std::string scene;
  for (const std::string& name : content_names("scenes"))
    if (path.starts_with(name) && name.size() > scene.size()) scene = name;
  return scene;
}

// What frames record along a path, with the mesh of a headset's picture: small pictures draw the same.
Most most_along(const std::string& name, const std::string& preset, int frames) {
  Scene scene = load_scene(scene_of(name), preset);
  scene.settings.render.msaa = 1;
  scene.settings.render.vertical_fov_deg = headset_fov_deg;
  CostSubject subject(test::device(), test::shaders(), scene, {32, 34, 2});
  const CameraPath path = load_camera_path(name);
  const double pixels = 0.5 * headset_height_px / std::tan(0.5 * glm::radians(headset_fov_deg));
  glm::dvec3 viewer_m = path.at(0.0).pose.position_m;
  Most most;
  for (int n = 0; n < frames; ++n) {
    const PathSample sample = path.at(path.duration_s() * n / std::max(frames - 1, 1));
    const double time_s = sea_time_s(scene.settings, sample.scene_time_s);
    const Pose pose = pose_in_world(subject.experience(), path, sample, time_s, viewer_m);
    viewer_m = pose.position_m;
    subject.draw_ms(pose, time_s, pixels);
    const Frame& frame = subject.experience().frame();
    most.draws = std::max(most.draws, frame.counts().draws);
    std::uint64_t triangles = 0;
    for (const PipelineWork& work : frame.work()) triangles += views_of(work.pass) * work.triangles;
    most.triangles = std::max(most.triangles, triangles);
  }
  return most;
}

class PresetBudget : public test::GpuTest {};
const test::DrawsMuch draws_much("PresetBudget");

// Every path at low and medium, 40 poses of each (without SEASCAPE_LONG: three paths, 3 poses). Controls seen:
// lod.pixel_error of 0.5 at medium; no least size of what is drawn to be seen through the water.
TEST_F(PresetBudget, LowAndMediumKeepToTheirDrawsAndTriangles) {
  const std::vector<std::string> names =
      test::long_run() ? content_names("paths") : std::vector<std::string>{"harbour", "harbour_dive", "regatta"};
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names)
    for (const char* preset : {"low", "medium"}) {
      const Most most = most_along(name, preset, test::long_run() ? 40 : 3);
      EXPECT_LE(most.draws, most_draws) << name << " at " << preset;
      EXPECT_LE(most.triangles, most_triangles) << name << " at " << preset;
      std::printf("%s at %s: %llu draws, %llu triangles\n", name.c_str(), preset,
                  static_cast<unsigned long long>(most.draws), static_cast<unsigned long long>(most.triangles));
    }
}

}  // namespace
}  // namespace seascape
