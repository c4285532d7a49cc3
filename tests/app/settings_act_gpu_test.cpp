// The sentence of every setting is true at least in so far that the setting acts: in a scene where it matters two
// values draw two pictures, or the same one by other commands. Settings that act as the sea runs are asked by
// ExperienceApply.LiveSettingsActAndMakeNoObject.
#include <gtest/gtest.h>

#include <map>

#include "app/sea_time.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/settings_that_act.h"
#include "tests/support/sampled.h"

namespace seascape {

namespace {

class SettingsAct : public test::GpuTest {};

struct Shown {
  std::vector<Image8> pictures;
  std::uint64_t commands = 0, bytes = 0;  // recorded; of what is made
};

Shown shown(const test::ShotOptions& options) {
  test::SeaShot shot(options);
  const Pose head = options.scene == "storm" ? test::pose({0.0, 6.0, 0.0}, 20.0, -18.0) : shot.scene().start;
  for (int n = 0; n < 4; ++n) shot.draw(head, 4.0 + n / 12.0);
  Shown result;
  result.pictures = shot.pictures(test::pose(head.position_m, 40.0, -15.0), 4.4);
  result.commands = shot.counts().hash;
  for (const ObjectRecord& object : shot.device().objects()) result.bytes += object.bytes;
  return result;
}

// Rows that choose how a picture is made and promise no other one: other commands draw it, or of other images.
bool draws_the_same(std::string_view key) {
  for (const char* one : {"frame.shape", "frame.lighting", "frame.facing_only", "waves.where", "waves.half_storage",
                          "place.levels", "place.resolution", "foam.levels", "spray.most"})
    if (key == one) return true;
  return false;
}

// Control seen to fail: a mesher that ignores debug.drop_patch.
TEST_F(SettingsAct, EveryOneThatIsNotLive) {
  std::map<std::string, Shown> plain;
  int number = 0;
  for (const Setting& row : settings_table()) {
    SCOPED_TRACE(row.key);
    const bool time = row.key.starts_with("time.");
    const bool of_the_next_frame = row.key.starts_with("stereo.") || row.key.starts_with("camera.") ||
                                   row.key.starts_with("debug.") || row.key == "frame.facing_only";
    if (row.rebuild.empty() && !time && !of_the_next_frame) continue;
    // baked.loop: Loops.TheShippedOneIsInTheScenesAnswers; time.follow_clock: OneClock.TwoProcessesShowOneSea.
    if (row.key == "stereo.mode") {
      EXPECT_TRUE(draw_per_eye(test::device(), test::shaders(), StereoMode::per_eye, 2));
      EXPECT_FALSE(draw_per_eye(test::device(), test::shaders(), StereoMode::single, 2));
      continue;
    }
    if (row.key == "water.anisotropy" && test::device().facts().max_anisotropy <= 1.0f) continue;
    if (row.key == "baked.loop" || row.key == "time.follow_clock") continue;
    if (!test::sampled(number++, 9)) continue;
    test::ShotOptions options = test::where_it_acts(row.key);
    Settings settings = test::SeaShot(options).scene().settings;
    const std::string value = test::value_in(settings, row);
    if (time) {
      const double before = sea_time_s(settings, 7.0);
      set_from_text(settings, row.key, value, "test");
      EXPECT_NE(sea_time_s(settings, 7.0), before);
      continue;
    }
    const std::string key = options.scene + std::to_string(options.set.size()) + std::to_string(options.views);
    if (!plain.contains(key)) plain[key] = shown(options);
    options.set.emplace_back(std::string(row.key), value);
    const Shown with = shown(options);
    int differing = 0;
    for (std::size_t eye = 0; eye < with.pictures.size(); ++eye)
      differing += test::differing_pixels(with.pictures[eye], plain[key].pictures[eye]);
    if (draws_the_same(row.key)) {
      EXPECT_TRUE(with.commands != plain[key].commands || with.bytes != plain[key].bytes);
    } else {
      EXPECT_GT(differing, 0);
    }
  }
}

}  // namespace

}  // namespace seascape
