// What a second eye costs in commands.
#include <gtest/gtest.h>

#include "app/quality.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

class StereoCommands : public test::GpuTest {};

// A frame of both eyes records at most a twentieth more commands than one of that eye alone which needs more: every
// pass is drawn once for both. An eye between them may be clear of water that both touch, and needs less. Every scene
// at every preset with SEASCAPE_LONG, else a nineteenth of them. Controls: a pass per eye; the surface's draw recorded
// once more for a second view.
TEST_F(StereoCommands, AreAtMostATwentiethMore) {
  const std::vector<std::string> scenes = content_names("scenes");
  ASSERT_FALSE(scenes.empty());
  double most = 0.0;
  std::size_t number = 0;
  for (const std::string& scene : scenes)
    for (const std::string_view preset : preset_names()) {
      if (!test::sampled(number++, 19)) continue;  // presets in turn
      const auto commands = [&](int views, int eye) {
        test::SeaShot shot({.scene = scene,
                            .preset = std::string(preset),
                            .width = 64,
                            .height = 48,
                            .views = views,
                            .eye = eye,
                            .set = {{"waves.resolution", "32"}, {"foam.settle_s", "0.1"}}});
        shot.draw(shot.scene().start, 10.0);
        shot.draw(shot.scene().start, 10.02);
        return double(shot.counts().commands);
      };
      const double one = std::max(commands(1, -1), commands(1, 1)), two = commands(2, 0);
      EXPECT_GT(one, 5.0);
      EXPECT_LE(two, 1.05 * one) << scene << " " << preset << ": " << two << " and " << one;
      most = std::max(most, two / one);
    }
  RecordProperty("most", std::to_string(most));
  std::printf("a stereo frame records at most %.3f times the commands of a mono frame\n", most);
}

}  // namespace
}  // namespace seascape
