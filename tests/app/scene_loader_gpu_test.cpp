// A scene is loaded while another one is drawn: on the same device, with nothing shared that both change.
#include "app/scene_loader.h"

#include <gtest/gtest.h>

#include "app/frame.h"
#include "app/program.h"
#include "engine/error.h"
#include "platform/headless.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

class Loader : public test::GpuTest {
 protected:
  static constexpr ExperienceOptions small{64, 48, 1};
  static SceneLoader::Request request(const char* name) {
    return {[=] {
              Scene scene = load_scene(name, "low");
              scene.settings.foam.settle_s = 2.0;
              return scene;
            },
            [](const Scene&) { return small; }};
  }
};

// The picture a frame after the start.
Image8 next_picture(Device& device, Experience& experience) {
  const Scene& scene = experience.scene();
  const Headless eyes(
      {.width = 64, .height = 48, .views = 1, .vertical_fov_deg = scene.settings.render.vertical_fov_deg});
  Frame& frame = experience.frame();
  frame.begin();
  draw_frame(experience, frame, eyes.viewpoint(scene.start), scene.settings.time_start_s + 1.0 / 72.0);
  frame.submit();
  frame.finish();
  return picture_of(device, experience, 0);
}

// Frames of the storm go on meanwhile, and the lagoon is the one that is loaded alone: its first frame here makes no
// pipeline. Control seen: a submission without the queue's lock fails by the validation layer.
TEST_F(Loader, AnotherSceneIsDrawnMeanwhile) {
  test::SeaShot shot({.scene = "storm", .preset = "low", .width = 64, .height = 48});
  Device& device = shot.device();
  ShaderLibrary& shaders = test::shaders();
  const Scene lagoon = request("lagoon").read();
  Experience alone(device, shaders, lagoon, small);
  (void)next_picture(device, alone);  // at its start, as the loader has it
  {
    SceneLoader loader(device, shaders);
    for (int times = 0; times < (test::long_run() ? 3 : 1); ++times) {
      loader.ask(request("lagoon"));
      std::unique_ptr<Experience> loaded;
      int drawn = 0;
      double time_s = 3.0;
      while (loaded == nullptr) {
        shot.draw(shot.scene().start, time_s += 1.0 / 72.0);
        ++drawn;
        loaded = loader.take();
        ASSERT_LT(drawn, 100000);
      }
      EXPECT_GE(drawn, 2);
      EXPECT_FALSE(loader.busy());
      const std::uint64_t pipelines = device.pipelines_made();
      const Image8 picture = next_picture(device, *loaded);
      EXPECT_EQ(device.pipelines_made(), pipelines);
      EXPECT_EQ(loaded->scene().name, "lagoon");
      EXPECT_EQ(test::differing_pixels(picture, next_picture(device, alone)), 0);
      for (int n = 0; n < 3; ++n) shot.draw(shot.scene().start, time_s += 1.0 / 72.0);
    }
  }
  // What went wrong is said once, and what is asked for last is what comes.
  SceneLoader loader(device, shaders);
  loader.ask(request("no_such_scene"));
  while (loader.busy()) shot.draw(shot.scene().start, 4.0);
  EXPECT_THROW((void)loader.take(), Error);
  EXPECT_EQ(loader.take(), nullptr);
  loader.ask(request("lagoon"));
  loader.ask(request("calm"));
  std::unique_ptr<Experience> loaded;
  while (loaded == nullptr) {
    shot.draw(shot.scene().start, 4.0);
    loaded = loader.take();
  }
  EXPECT_EQ(loaded->scene().name, "calm");
}

}  // namespace

}  // namespace seascape
