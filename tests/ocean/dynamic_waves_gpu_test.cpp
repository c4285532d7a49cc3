// Dynamic waves as they are drawn: where the vertex shader puts them, against the surface that the processor knows.
#include <cmath>
#include <cstring>
#include <random>

#include "ocean/mesh/patch_mesh.h"
#include "tests/support/gpu/drawn_mesh.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;

using Set = std::vector<std::pair<std::string, std::string>>;

Set rain(const std::string& rate) {
  return {{"dynamic_waves.rain_per_m2_s", rate}, {"dynamic_waves.drop_length_m", "1.5"},
          {"dynamic_waves.drop_height_m", "1"},  {"dynamic_waves.resolution", "128"},
          {"dynamic_waves.levels", "4"},         {"dynamic_waves.settle_s", "2"}};
}

class DrawnDynamicSea : public test::GpuTest {};

// A thousand vertices within 1/500 of the highest wave: half floats are off by 1/2048, and drivers put a texel into 256
// parts. From low, and from high up, where all levels have gone on. Controls seen: a level's coordinates half a texel
// off; the share of sharpening left out (in lower waves, which need none, it was not seen).
TEST_F(DrawnDynamicSea, StandsWhereTheProcessorSays) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  for (const Pose& head : {pose({12.3, 2.0, -45.6}, 30.0, -30.0), pose({-3e4, 45.0, 1e4}, 200.0, -40.0)}) {
    SeaShot shot({.scene = "open_sea",
                  .preset = "high",
                  .width = 64,
                  .height = 36,
                  .probe = true,
                  .set = rain("0.05"),
                  .effects = std::vector<std::string>{"dynamic_waves"}});
    for (int i = 0; i < 4; ++i) shot.draw(head, 3.0 + 0.1 * i);  // the mesh follows the waves that it was last told of
    const DrawnDynamicWaves* drawn = shot.experience().ocean().dynamic_waves();
    ASSERT_NE(drawn, nullptr);
    const DynamicSurface& surface = *drawn->surface();
    const SurfaceSelection& selection = *shot.experience().ocean().selection();
    ASSERT_LE(selection.patches.size(), Surface::probe_patches);
    const auto bytes = read_buffer(test::device(), shot.experience().surface().probed());
    const auto side = std::size_t(gpu::patch_quads + 1), vertices = side * side;
    const glm::dvec2 viewer(head.position_m.x - selection.grid_origin_m.x,
                            head.position_m.z - selection.grid_origin_m.y);
    std::mt19937 random(7);
    double worst = 0.0, highest = 0.0, widest = 0.0;
    int moved = 0;
    for (int i = 0; i < 4000; ++i) {
      const std::size_t at = (random() % selection.patches.size()) * vertices + random() % vertices;
      glm::vec4 rest, got;
      std::memcpy(&rest, &bytes[at * 32], 16);
      std::memcpy(&got, &bytes[at * 32 + 16], 16);
      const glm::dvec2 from_viewer = glm::dvec2(rest) - viewer;
      if (glm::length(from_viewer) > 2000.0) continue;
      const glm::dvec3 want = surface.sea(selection.grid_origin_m + glm::dvec2(rest), double(rest.z)).displacement;
      const glm::dvec3 d(double(got.x) - from_viewer.x, got.z, double(got.y) - from_viewer.y);
      worst = std::max(worst, glm::length(d - want));
      highest = std::max(highest, std::abs(want.y));
      widest = std::max(widest, std::hypot(want.x, want.z));
      moved += std::abs(want.y) > 1e-3;
    }
    EXPECT_GT(moved, 300);
    EXPECT_GT(widest, 0.1 * highest);
    EXPECT_LE(worst, highest / 500.0) << "of " << highest << " m";
  }
}

// The normals that pixels are lit by are those of the processor's surface, seen from above, where pixels are smaller
// than texels: by the regression of one on the other along either axis. Controls seen: x and z of the slope changed
// about; the sideways part of it left out.
TEST_F(DrawnDynamicSea, IsLitByTheProcessorsSlopes) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  constexpr int width = 160, height = 120;
  Set set = rain("0.05");
  set.emplace_back("debug.view", "normals");
  SeaShot shot({.scene = "open_sea",
                .preset = "high",
                .width = width,
                .height = height,
                .probe = true,
                .set = set,
                .effects = std::vector<std::string>{"dynamic_waves"}});
  const Pose head = pose({12.3, 7.0, -45.6}, 30.0, -80.0);
  const Viewpoint view = shot.viewpoint(head);
  for (int i = 0; i < 4; ++i) shot.draw(view, 3.0 + 0.1 * i);
  const Image8 picture = shot.picture(view, 3.3);
  const DynamicSurface& surface = *shot.experience().ocean().dynamic_waves()->surface();
  const auto shown = test::DrawnMesh(shot, view).shown(width, height);
  glm::dvec2 xx(0.0), xy(0.0), yy(0.0);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i].any) continue;
    const DynamicSample s = surface.sea(shown[i].point.rest, 0.0);
    const double a = 1.0 + s.shift_gradient.x, b = 1.0 + s.shift_gradient.y, c = s.shift_gradient.z;
    const glm::dvec2 want = glm::dvec2(b * s.height_gradient.x - c * s.height_gradient.y,
                                       a * s.height_gradient.y - c * s.height_gradient.x) /
                            (a * b - c * c);
    const glm::dvec3 painted = 2.0 * test::light_at(picture, i) - 1.0;
    const glm::dvec2 got = -glm::dvec2(painted.x, painted.z) / painted.y;
    xx += want * want, xy += want * got, yy += got * got;
  }
  for (const int axis : {0, 1}) {
    EXPECT_GT(xx[axis] / double(shown.size()), 1e-3) << "steep enough to see";
    EXPECT_NEAR(xy[axis] / xx[axis], 1.0, 0.03) << test::leave(picture, "dynamic_normals");
    EXPECT_GT(xy[axis] / std::sqrt(xx[axis] * yy[axis]), 0.99);
  }
}

// Still water is drawn as it would be without them, to the bit, and costs no pass; a drop wakes it in the same frame.
TEST_F(DrawnDynamicSea, RestsWhereNothingPushes) {
  const Pose head = pose({0.0, 3.0, 0.0}, 20.0, -12.0);
  Set seldom = rain("0.000001");
  seldom.emplace_back("waves.resolution", "32");
  SeaShot with({.scene = "open_sea",
                .preset = "medium",
                .width = 80,
                .height = 48,
                .set = seldom,
                .effects = std::vector<std::string>{"waves", "dynamic_waves"}});
  SeaShot without({.scene = "open_sea",
                   .preset = "medium",
                   .width = 80,
                   .height = 48,
                   .set = seldom,
                   .effects = std::vector<std::string>{"waves"}});
  EXPECT_EQ(test::differing_pixels(with.picture(head, 4.0), without.picture(head, 4.0)), 0);
  with.draw(head, 4.1);
  for (const PipelineWork& work : with.experience().frame().work()) EXPECT_STRNE(work.pass, "dynamic_waves");
}

}  // namespace
}  // namespace seascape
