// Solid things for both eyes in one pass: what each eye draws alone, bit for bit.
#include <gtest/gtest.h>

#include "engine/multiview_check.h"
#include "tests/support/gpu/each_eye.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::differing_pixels;
using test::pose;
using test::SeaShot;
using test::ShotOptions;

class SolidStereo : public test::GpuTest {};

SceneObjects things() {
  SceneObjects objects;
  const char* const glass =
      R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.2,0.9,0.4,0.5],"roughnessFactor":0.1}})";
  const char* const metal = R"({"pbrMetallicRoughness":{"roughnessFactor":0.3}})";
  test::stand(objects, test::solid_model(test::solid_sphere(0.5f, 16), metal), Pose{{-0.5, 0.4, -3.0}});
  test::stand(objects, test::solid_model(test::solid_box({0.3f, 0.3f, 0.3f}), "{}"),
              pose({0.6, 0.1, -2.5}, 30.0, 10.0));
  test::stand(objects, test::solid_model(test::solid_box({0.4f, 0.4f, 0.01f}), glass), Pose{{0.1, 0.6, -2.0}});
  test::stand(objects, test::solid_model(test::solid_box({0.4f, 0.2f, 0.4f}), metal), Pose{{-0.2, -0.5, -1.6}});
  return objects;
}

// Control seen: the first eye's matrix for both in solid.vert.
TEST_F(SolidStereo, OnePassEqualsEachEyeAndMono) {
  for (const test::FrameLook& look : test::stereo_looks()) {
    ShotOptions options{.scene = "calm", .preset = "medium", .width = 160, .height = 120, .set = look.set};
    options.set.emplace_back("waves.resolution", "32");
    options.effects = {{"waves", "models"}};
    options.objects = things();
    const Pose head = pose({0.2, 1.2, 0.0}, 3.0, -10.0, 4.0);
    const std::vector<Image8> alone = test::expect_each_eye_alone(options, head, 5.0, look.name);
    ShotOptions empty = options;
    empty.eye = 1;
    empty.effects = {{"waves"}};
    EXPECT_GT(differing_pixels(SeaShot(empty).picture(head, 5.0), alone[1]), 2000) << look.name << ": nothing is there";
  }
}

// Eyes far apart, each against a mono picture whose head stands there: highlights and haze are the eye's own. Control
// seen: light to the head instead of the eye (to_eye without view.eye).
TEST_F(SolidStereo, EachEyeSeesItsOwnHighlights) {
  for (const bool deferred : {false, true}) {
    ShotOptions options{.scene = "calm", .preset = "medium", .width = 128, .height = 96, .views = 2};
    options.per_eye = !multiview_works(test::device(), test::shaders());
    options.set = {{"waves.resolution", "32"},     {"waves.wind_speed_mps", "0"},
                   {"waves.swell_height_m", "0"},  {"sky.visibility_m", "100"},
                   {"msaa", deferred ? "1" : "4"}, {"frame.lighting", deferred ? "deferred" : "forward"}};
    options.effects = {{"waves", "models"}};
    options.objects = things();
    SeaShot stereo(options);
    options.views = 1;
    options.per_eye = false;
    SeaShot mono(options);
    const Pose head = pose({0.0, 1.2, 0.5}, 0.0, -10.0);
    const std::vector<View> eyes = stereo_views(head, symmetric_fov(70.0, 4.0 / 3.0), 1.6);
    const auto seen = stereo.pictures(Viewpoint{head, eyes, 0.0}, 5.0);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const Image8 own = mono.picture(Viewpoint{eyes[eye].pose, {eyes[eye]}, 0.0}, 5.0);
      EXPECT_LE(test::difference(seen[eye], own).mean, 0.0015)
          << deferred << eye << test::leave(seen[eye], "highlights") << " " << test::leave(own, "highlights_mono");
    }
  }
}

}  // namespace
}  // namespace seascape
