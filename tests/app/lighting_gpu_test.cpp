// Lit once a pixel or where triangles are drawn, the sea is the same: deferred against forward, from the air and from
// below.
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;

class DeferredLight : public test::GpuTest {};

test::ShotOptions options(const std::string& scene, const std::string& lighting) {
  return {.scene = scene,
          .preset = "high",
          .width = 192,
          .height = 108,
          .views = 2,
          .set = {{"msaa", "1"},
                  {"waves.where", "cpu"},     // whose waves say where eyes are in the air
                  {"water.adaptation", "0"},  // light is compared as it is
                  {"frame.lighting", lighting},
                  {"frame.facing_only", lighting == "deferred" ? "true" : "false"}}};
}

// Level and tilted, near and far, straight down, from 20 km; close above the water, where nothing may be culled by its
// facing, and under it.
std::vector<Pose> poses() {
  return {pose({3.0, 2.2, 5.0}, 10.0, -4.0),      pose({40.0, 12.0, -7.0}, 130.0, -20.0, 15.0),
          pose({0.0, 30.0, 0.0}, 0.0, -90.0),     pose({9.0, 300.0, 2.0}, 250.0, -12.0),
          pose({0.0, 20000.0, 0.0}, 80.0, -30.0), pose({-3.0, 0.3, 8.0}, 200.0, 0.0),
          pose({17.0, -1.5, 4.0}, 300.0, 20.0),   pose({5.0, 6.0, 5.0}, 305.0, -8.0)};
}

// Half floats carry the vertices' slopes and a pixel's footprint: a difference of 1e-3 of a slope, and at crests a
// pixel that belongs to one of two triangles. Of linear light. Controls seen, each fails here: a footprint twice as
// long (mean 6e-4, p99 0.009), the near plane's distance twice as far (5e-3, 0.07), one pair of derivatives for the
// other (2e-3, 0.03), back faces culled under water.
TEST_F(DeferredLight, ShowsWhatForwardLightShows) {
  // Scene; with its lace, which is white beside dark, or without; what the hundredth part that differs most may differ
  // by.
  const std::tuple<std::string, bool, double> rows[] = {{"open_sea", true, 5e-3},
                                                        {"calm", true, 5e-3},
                                                        {"swell", true, 5e-3},
                                                        {"storm", false, 5e-3},
                                                        {"storm", true, 7e-3}};
  std::size_t row = 0;
  for (const auto& [scene, lace, edges] : rows) {
    if (!test::sampled(row++, 2)) continue;
    test::ShotOptions one = options(scene, "forward"), other = options(scene, "deferred");
    if (!lace)
      for (test::ShotOptions* o : {&one, &other}) o->set.emplace_back("foam.simulated", "false");
    SeaShot forward(one), deferred(other);
    EXPECT_FALSE(forward.experience().deferred());
    EXPECT_TRUE(deferred.experience().deferred());
    int number = 0;
    for (const Pose& head : poses()) {
      const auto a = forward.pictures(head, 20.0), b = deferred.pictures(head, 20.0);
      for (std::size_t eye = 0; eye < 2; ++eye) {
        const auto d = test::difference(a[eye], b[eye]);
        const std::string name =
            "deferred_" + scene + (lace ? "_" : "_bare_") + std::to_string(number) + "_" + std::to_string(eye);
        EXPECT_TRUE(d.mean <= 3e-4 && d.p99 <= edges)
            << name << ": mean " << d.mean << ", p99 " << d.p99 << "; " << test::leave(a[eye], name + "_forward")
            << ", " << test::leave(b[eye], name);
      }
      ++number;
    }
  }
}

// In both shapes of the frame, a pass per eye or one for both, after a change of size.
TEST_F(DeferredLight, ServesEveryShape) {
  const Pose head = poses()[0];
  for (const char* shape : {"tile", "desktop"})
    for (const bool per_eye : {false, true}) {
      test::ShotOptions deferred = options("open_sea", "deferred"), forward = options("open_sea", "forward");
      for (test::ShotOptions* o : {&deferred, &forward}) {
        o->set.emplace_back("frame.shape", shape);
        o->per_eye = per_eye;
      }
      SeaShot a(forward), b(deferred);
      (void)b.pictures(head, 3.0);
      for (SeaShot* shot : {&a, &b}) shot->experience().resize(128, 96);
      const auto x = a.pictures(head, 20.0), y = b.pictures(head, 20.0);
      for (std::size_t eye = 0; eye < 2; ++eye) {
        const auto d = test::difference(x[eye], y[eye]);
        EXPECT_LE(d.mean, 3e-4) << shape << ", per eye " << per_eye << ", eye " << eye;
        EXPECT_LE(d.p99, 5e-3) << shape << ", per eye " << per_eye << ", eye " << eye;
      }
    }
}

// It takes one sample a pixel; views that colour triangles are drawn forward.
TEST_F(DeferredLight, IsForOneSampleAndForLight) {
  SeaShot shot(options("calm", "deferred"));
  EXPECT_TRUE(shot.experience().deferred());
  shot.set("debug.view", "lod");
  EXPECT_FALSE(shot.experience().deferred());
  shot.set("debug.view", "holes");
  EXPECT_TRUE(shot.experience().deferred());
  shot.set("debug.view", "none");
  shot.set("msaa", "4");
  EXPECT_FALSE(shot.experience().deferred());
  shot.set("msaa", "1");
  shot.set("frame.lighting", "auto");
  EXPECT_EQ(shot.experience().deferred(), test::device().facts().software);
}

// Culled by its facing, the sea has no hole, and a patch left out is one.
TEST_F(DeferredLight, LeavesNoHoles) {
  for (const char* scene : {"calm", "storm"}) {
    SeaShot shot(options(scene, "deferred"));
    shot.set("debug.view", "holes");
    int number = 0, from_air = 0;
    for (Pose head : poses()) {
      if (head.position_m.y < 5.0) head.position_m.y = 9.0;  // an eye under water sees the sky below the horizon
      const Viewpoint viewpoint = shot.viewpoint(head);
      for (const Image8& picture : shot.pictures(head, 11.0 + number))
        EXPECT_EQ(test::count_colour(picture, 255, 0, 255), 0)
            << scene << " " << number << " "
            << test::leave(picture, std::string("deferred_holes_") + scene + std::to_string(number));
      from_air += shot.experience().ocean().eyes_in_air(viewpoint);
      ++number;
    }
    EXPECT_GE(from_air, number - 2) << scene;
    int most = 0;
    for (int patch = 0; patch < 12; ++patch) {
      shot.set("debug.drop_patch", std::to_string(patch));
      most = std::max(most, test::count_colour(shot.picture(pose({5.0, 12.0, 5.0}, 0.0, -60.0), 5.0), 255, 0, 255));
    }
    EXPECT_GT(most, 1) << scene;
  }
}

// Eyes are in the air half a metre above the water where they are, not above the still sea.
TEST_F(DeferredLight, KnowsEyesInTheAir) {
  SeaShot shot(options("storm", "deferred"));
  const WaveField field(shot.scene().settings.sea, shot.scene().settings.waves);
  WaveTiles tiles;
  field.evaluate(ticks_from_seconds(5.0), tiles);
  int in_air = 0, below = 0, still_sea_differs = 0;
  for (int i = 0; i < 60; ++i) {
    const Pose head = pose({37.0 * i, -6.0 + 0.2 * i, 11.0 * i}, 0.0, 0.0);
    shot.draw(head, 5.0);
    const glm::dvec2 place{head.position_m.x, head.position_m.z};
    QueryAnswer water;
    query(field, tiles, {&place, 1}, {&water, 1});
    const bool says = shot.experience().ocean().eyes_in_air(shot.viewpoint(head));
    const double above = head.position_m.y - water.height_m;
    if (above < 0.3) {
      EXPECT_FALSE(says) << i << ": " << above;
    }
    if (above > 1.0 && head.position_m.y > 0.6 && water.converged) {
      EXPECT_TRUE(says) << i << ": " << above;
    }
    in_air += says;
    below += above < 0.0;
    still_sea_differs += (head.position_m.y > 0.5) != says;
  }
  EXPECT_GT(in_air, 10);
  EXPECT_GT(below, 10);
  EXPECT_GT(still_sea_differs, 2) << "the control: the still sea's level would do as well";
}

}  // namespace

}  // namespace seascape
