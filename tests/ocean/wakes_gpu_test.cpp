// Waves in the windows of bodies as they are drawn: where the vertex shader puts them, against the surface that the
// processor knows, and for both eyes. Controls are named beside each test; each was seen to fail.
#include <cmath>
#include <cstring>
#include <random>

#include "ocean/mesh/patch_mesh.h"
#include "tests/support/gpu/drawn_mesh.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/wake_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::ShotOptions;

// Two boats whose windows overlap, far from the world's middle, where floats are coarse.
const glm::dvec2 harbour(-3e4, 1e4);

std::shared_ptr<SeaActor> two_boats() {
  return std::make_shared<test::WakeMaker>(std::vector<test::WakeMade>{
      {.id = 7, .at_m = harbour + glm::dvec2(-9.0, 0.0), .velocity_mps = {2.5, 0.0}, .head_m = 0.3},
      {.id = 9, .at_m = harbour + glm::dvec2(9.0, 4.0), .velocity_mps = {-2.0, 0.5}, .head_m = 0.2}});
}

ShotOptions options() {
  return {.scene = "open_sea",
          .preset = "high",
          .width = 64,
          .height = 36,
          .probe = true,
          .set = {{"wakes.resolution", "64"}},
          .effects = std::vector<std::string>{"wakes"},
          .actor = two_boats};
}

Pose above(double height_m, double pitch_deg) {
  return pose({harbour.x + 1.3, height_m, harbour.y + 9.4}, 10.0, pitch_deg);
}

class DrawnWakeSea : public test::GpuTest {
 protected:
  // As explore steps it, for 3 s and some frames, which the mesh follows.
  static void run(SeaShot& shot, const Pose& head) {
    for (int i = 0; i <= 30; ++i) shot.draw(head, 0.1 * i);
    for (int i = 1; i < 5; ++i) shot.draw(head, 3.0 + i / 90.0);
  }
};

// A thousand vertices within 1/500 of the highest wave: half floats are off by 1/2048, and drivers put a texel into 256
// parts. Controls seen: a window's middle 1 m off (describe()); the first window alone.
TEST_F(DrawnWakeSea, StandsWhereTheProcessorSays) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  SeaShot shot(options());
  const Pose head = above(3.0, -30.0);
  run(shot, head);
  const DrawnWakes* drawn = shot.experience().ocean().wakes();
  ASSERT_NE(drawn, nullptr);
  ASSERT_NE(drawn->surface(), nullptr);
  const WakeSurface& surface = *drawn->surface();
  ASSERT_EQ(surface.parts().size(), 2u);
  const SurfaceSelection& selection = *shot.experience().ocean().selection();
  ASSERT_LE(selection.patches.size(), Surface::probe_patches);
  const auto bytes = read_buffer(test::device(), shot.experience().surface().probed());
  const auto side = std::size_t(gpu::patch_quads + 1), vertices = side * side;
  const glm::dvec2 viewer(head.position_m.x - selection.grid_origin_m.x, head.position_m.z - selection.grid_origin_m.y);
  std::mt19937 random(7);
  double worst = 0.0, highest = 0.0, widest = 0.0;
  int moved = 0, both = 0;
  for (int i = 0; i < 6000; ++i) {
    const std::size_t at = (random() % selection.patches.size()) * vertices + random() % vertices;
    glm::vec4 rest, got;
    std::memcpy(&rest, &bytes[at * 32], 16);
    std::memcpy(&got, &bytes[at * 32 + 16], 16);
    const glm::dvec2 from_viewer = glm::dvec2(rest) - viewer;
    if (glm::length(from_viewer) > 2000.0) continue;
    const glm::dvec2 place = selection.grid_origin_m + glm::dvec2(rest);
    const glm::dvec3 want = surface.sea(place, double(rest.z)).displacement;
    const glm::dvec3 d(double(got.x) - from_viewer.x, got.z, double(got.y) - from_viewer.y);
    worst = std::max(worst, glm::length(d - want));
    highest = std::max(highest, std::abs(want.y));
    widest = std::max(widest, std::hypot(want.x, want.z));
    moved += std::abs(want.y) > 1e-3;
    both += std::abs(surface.sea(place, 0.0, 7).displacement.y - want.y) > 1e-3;
  }
  EXPECT_GT(moved, 300);
  EXPECT_GT(both, 100);
  EXPECT_GT(widest, 0.1 * highest);
  EXPECT_LE(worst, highest / 500.0) << "of " << highest << " m";
}

// The normals that pixels are lit by are those of the processor's surface, seen from above: by the regression of one on
// the other along either axis. Control seen: the displacement's image bound for that of slopes.
TEST_F(DrawnWakeSea, IsLitByTheProcessorsSlopes) {
  if (!test::device().facts().vertex_stores) GTEST_SKIP() << "this device's vertex shaders cannot write buffers";
  ShotOptions wanted = options();
  wanted.width = 160, wanted.height = 120;
  wanted.set.emplace_back("debug.view", "normals");
  SeaShot shot(wanted);
  const Pose head = above(7.0, -75.0);
  run(shot, head);
  const Viewpoint view = shot.viewpoint(head);
  const Image8 picture = shot.picture(view, 3.1);
  const WakeSurface& surface = *shot.experience().ocean().wakes()->surface();
  const auto shown = test::DrawnMesh(shot, view).shown(wanted.width, wanted.height);
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
    EXPECT_GT(xx[axis] / double(shown.size()), 1e-4) << "steep enough to see";
    EXPECT_NEAR(xy[axis] / xx[axis], 1.0, 0.05) << test::leave(picture, "wake_normals");
    EXPECT_GT(xy[axis] / std::sqrt(xx[axis] * yy[axis]), 0.98);
  }
}

// Still water is drawn as it would be without them, to the bit, and costs no pass; as soon as a boat moves they do.
// Controls seen: a pass in every frame; windows that are read at rest.
TEST_F(DrawnWakeSea, RestsWhereNoBodyMoves) {
  ShotOptions with = options();
  with.probe = false;
  with.effects = std::vector<std::string>{"waves", "wakes"};
  ShotOptions at_rest = with, without = with;
  at_rest.actor = nullptr;
  without.effects = std::vector<std::string>{"waves", "boats"};
  SeaShot moving(with), resting(at_rest), never(without);
  const Pose head = above(3.0, -20.0);
  for (int i = 0; i <= 20; ++i)
    for (SeaShot* shot : {&moving, &resting, &never}) shot->draw(head, 0.1 * i);
  EXPECT_EQ(test::differing_pixels(resting.picture(head, 2.1), never.picture(head, 2.1)), 0);
  EXPECT_GT(test::differing_pixels(moving.picture(head, 2.1), never.picture(head, 2.1)), 100);
  const auto passes = [&](SeaShot& shot) {
    shot.draw(head, 2.2);
    int count = 0;
    for (const PipelineWork& work : shot.experience().frame().work()) count += std::string_view(work.pass) == "wakes";
    return count;
  };
  EXPECT_EQ(passes(resting), 0);
  EXPECT_GT(passes(moving), 0);
}

// Both eyes in one pass are to the bit those of a pass an eye.
// Control: none of its own: the slots and the data of both are the same; the comparison is that of scenes_stereo_test.
TEST_F(DrawnWakeSea, OnePassForBothEyesIsOneAnEye) {
  ShotOptions wanted = options();
  wanted.probe = false;
  wanted.views = 2;
  wanted.effects = std::vector<std::string>{"waves", "wakes"};
  ShotOptions apart = wanted;
  apart.per_eye = true;
  SeaShot one(wanted), each(apart);
  const Pose head = above(2.0, -15.0);
  run(one, head), run(each, head);
  const auto a = one.pictures(head, 3.1), b = each.pictures(head, 3.1);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t eye = 0; eye < a.size(); ++eye) EXPECT_EQ(test::differing_pixels(a[eye], b[eye]), 0) << eye;
  EXPECT_GT(test::differing_pixels(a[0], a[1]), 0);
}

}  // namespace
}  // namespace seascape
