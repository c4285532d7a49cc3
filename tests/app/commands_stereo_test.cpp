// What a second eye costs in commands.
#include <gtest/gtest.h>

#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/sea_shot.h"
#include "tests/support/sampled.h"

namespace seascape {
namespace {

class StereoCommands : public test::GpuTest {};

// A frame of both eyes records at most a twentieth more commands than one of a single eye: every pass is drawn once for
// both. All scenes, each at one preset; at all four with SEASCAPE_LONG. Controls: a pass per eye; the surface's draw
// recorded once more for a second view.
TEST_F(StereoCommands, AreAtMostATwentiethMore) {
  const std::vector<std::string> scenes{"baked",  "calm",     "gerstner",  "harbour", "harbour_clip",
                                        "lagoon", "open_sea", "rain_pool", "rivers",  "still_life",
                                        "storm",  "swell",    "whirlpool"};
  const std::vector<std::string> presets{"low", "medium", "high", "ultra"};
  double most = 0.0;
  for (std::size_t s = 0; s < scenes.size(); ++s)
    for (std::size_t p = 0; p < presets.size(); ++p) {
      if (!test::long_run() && s % presets.size() != p) continue;
      const auto commands = [&](int views) {
        test::SeaShot shot({.scene = scenes[s],
                            .preset = presets[p],
                            .width = 64,
                            .height = 48,
                            .views = views,
                            .set = {{"waves.resolution", "32"}, {"foam.settle_s", "0.1"}}});
        shot.draw(shot.scene().start, 10.0);
        shot.draw(shot.scene().start, 10.02);
        return double(shot.counts().commands);
      };
      const double one = commands(1), two = commands(2);
      EXPECT_GT(one, 5.0);
      EXPECT_LE(two, 1.05 * one) << scenes[s] << " " << presets[p] << ": " << two << " and " << one;
      most = std::max(most, two / one);
    }
  RecordProperty("most", std::to_string(most));
  std::printf("a stereo frame records at most %.3f times the commands of a mono frame\n", most);
}

}  // namespace
}  // namespace seascape
