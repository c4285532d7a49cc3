// Eyes in the water and across its surface, both in one pass: what each eye draws alone, bit for bit.
#include <gtest/gtest.h>

#include "tests/support/gpu/each_eye.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::SeaShot;
using test::ShotOptions;

class UnderwaterStereo : public test::GpuTest {};

SceneObjects things() {
  SceneObjects objects;
  const char* const glass =
      R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0.2,0.9,0.4,0.5],"roughnessFactor":0.1}})";
  test::stand(objects, test::solid_model(test::solid_box({0.3f, 0.6f, 0.3f}), "{}"), Pose{{0.6, 0.0, -2.5}});
  test::stand(objects, test::solid_model(test::solid_sphere(0.4f, 12), "{}"), Pose{{-0.6, -1.2, -3.0}});
  test::stand(objects, test::solid_model(test::solid_box({0.3f, 0.3f, 0.01f}), glass), Pose{{-0.1, -0.2, -1.4}});
  return objects;
}

// Of a head there that has breathed for some seconds.
SeaShot shot_of(const ShotOptions& options, const Pose& head) {
  SeaShot shot(options);
  Pose mouth = head;
  mouth.position_m += glm::dvec3(0.0, -0.5, -1.5);
  for (double t = 0.0; t < 5.0; t += 0.25) shot.experience().breathe(t, mouth);
  return shot;
}

// (A fifth of the cases, all with SEASCAPE_LONG.) Over a bed of 3 m, with things in the water and above it, bubbles,
// and a lamp that shines. Controls seen: the first eye's height for both in depth_in_water()'s callers; the first
// eye's line of sight for both in lamp_in_water().
TEST_F(UnderwaterStereo, OnePassEqualsEachEyeAndMono) {
  std::size_t number = 0;
  for (const test::FrameLook& look : test::stereo_looks())
    for (const double height_m : {0.0, -1.0}) {
      if (!test::sampled(number++, 5)) continue;
      ShotOptions options{.scene = "calm", .preset = "medium", .width = 128, .height = 96, .set = look.set};
      options.set.emplace_back("waves.resolution", "32");
      options.set.emplace_back("dive_light.on", "true");
      if (height_m < 0.0) options.set.emplace_back("sky.sun_elevation_deg", "-4");  // the lamp is what is seen
      options.effects = {{"waves", "models", "underwater", "sea_depth"}};
      InputSpec bed;
      bed.to = InputTarget::sea_depth;
      bed.value = {3.0f, 0.0f, 0.0f, 0.0f};
      bed.blend = InputBlend::replace;
      bed.shape = AreaInput{.round = true, .at_m = {0.0, 0.0}, .size_m = {60.0, 60.0}};
      options.inputs = {bed};
      options.objects = things();
      const Pose head = pose({0.2, height_m, 0.0}, 3.0, height_m < 0.0 ? 20.0 : 0.0, 14.0);
      test::expect_each_eye_alone(options, head, 5.0, look.name + std::to_string(height_m),
                                  [&](const ShotOptions& made) { return shot_of(made, head); });
    }
}

}  // namespace
}  // namespace seascape
