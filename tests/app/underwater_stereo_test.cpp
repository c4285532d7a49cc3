// Eyes in the water and across its surface, both in one pass: what each eye draws alone, bit for bit.
#include <gtest/gtest.h>

#include "engine/multiview_check.h"
#include "tests/support/gpu/frame_shapes.h"
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

// Over a bed of 3 m, with things in the water and above it. Control seen: the first eye's height for both in
// depth_in_water()'s callers.
TEST_F(UnderwaterStereo, OnePassEqualsEachEyeAndMono) {
  std::vector<test::FrameLook> looks(std::begin(test::frame_looks), std::end(test::frame_looks));
  looks.push_back({"tile_1", {{"frame.shape", "tile"}, {"msaa", "1"}, {"frame.lighting", "forward"}}});
  looks.push_back({"desktop_1", {{"frame.shape", "desktop"}, {"msaa", "1"}, {"frame.lighting", "forward"}}});
  for (const test::FrameLook& look : looks)
    for (const double height_m : {0.0, -1.0}) {
      ShotOptions options{.scene = "calm", .preset = "medium", .width = 128, .height = 96, .views = 2, .set = look.set};
      options.set.emplace_back("waves.resolution", "32");
      options.effects = {{"waves", "models", "underwater", "sea_depth"}};
      InputSpec bed;
      bed.to = InputTarget::sea_depth;
      bed.value = {3.0f, 0.0f, 0.0f, 0.0f};
      bed.blend = InputBlend::replace;
      bed.shape = AreaInput{.round = true, .at_m = {0.0, 0.0}, .size_m = {60.0, 60.0}};
      options.inputs = {bed};
      options.objects = things();
      const Pose head = pose({0.2, height_m, 0.0}, 3.0, height_m < 0.0 ? 20.0 : 0.0, 14.0);
      std::vector<Image8> together;
      if (multiview_works(test::device(), test::shaders())) together = SeaShot(options).pictures(head, 5.0);
      options.per_eye = true;
      const std::vector<Image8> by_eye = SeaShot(options).pictures(head, 5.0);
      options.per_eye = false;
      options.views = 1;
      std::vector<Image8> alone;
      for (const int eye : {-1, 1}) {
        options.eye = eye;
        alone.push_back(SeaShot(options).picture(head, 5.0));
      }
      for (std::size_t eye = 0; eye < 2; ++eye) {
        if (!together.empty()) {
          EXPECT_EQ(differing_pixels(together[eye], alone[eye]), 0)
              << look.name << height_m << eye << test::leave(together[eye], "underwater_together");
        }
        EXPECT_EQ(differing_pixels(by_eye[eye], alone[eye]), 0) << look.name << height_m << eye;
      }
      EXPECT_GT(differing_pixels(alone[0], alone[1]), 500) << look.name << height_m;
    }
}

}  // namespace
}  // namespace seascape
