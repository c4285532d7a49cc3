// Another quality while frames are on their way: each picture is the old one's or the new one's, and nothing is left
// behind. Hard case 41.
#include "app/frame.h"
#include "app/program.h"
#include "app/quality.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/gpu/sea_shot.h"

namespace seascape {

namespace {

using test::pose;
using test::SeaShot;

class QualitySwitch : public test::GpuTest {};

const Pose head = test::pose({12.0, 5.0, -3.0}, 25.0, -12.0);
constexpr double time_s = 14.0;

SeaShot small(const char* preset) {
  return SeaShot({.scene = "storm",
                  .preset = preset,
                  .width = 96,
                  .height = 64,
                  .set = {{"waves.resolution", "32"}, {"frame.shape", "tile"}}});
}

// The settings of a preset as a user's switch makes them: the scene's, with the preset's column.
Settings at(const SeaShot& shot, const char* preset) {
  Settings settings = shot.scene().settings;
  apply_preset(settings, preset);
  set_from_text(settings, "waves.resolution", "32", "test");
  set_from_text(settings, "frame.shape", std::string(preset) == "high" ? "desktop" : "tile", "test");
  return settings;
}

void record(SeaShot& shot, Frame& frame) { draw_frame(shot.experience(), frame, shot.viewpoint(head), time_s); }

// Where the switch comes: before a frame begins, while the one before is still being drawn; between its beginning and
// its drawing; and between its drawing and its submission, when its commands name objects that the switch lets go.
// Controls seen: a device that frees what the newest frames use when an older one has ended (validation errors); and
// another quality draws another picture.
TEST_F(QualitySwitch, hard_41_in_mid_frame_gives_the_old_picture_or_the_new) {
  SeaShot shot = small("low");
  const char* const presets[] = {"low", "high", "medium", "ultra"};
  std::vector<Image8> fresh;
  for (const char* preset : presets) {
    shot.experience().apply(at(shot, preset), true);
    fresh.push_back(shot.picture(head, time_s));
  }
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT(test::differing_pixels(fresh[a], fresh[b]), 20);
  shot.experience().apply(at(shot, "low"), true);
  (void)shot.picture(head, time_s);
  test::device().wait_idle();
  const std::size_t objects = test::device().objects().size();
  const std::uint64_t bytes = test::device().memory().used_bytes();
  for (int turn = 0; turn < 12; ++turn) {
    const std::size_t to = std::size_t(turn + 1) % 4, from = std::size_t(turn) % 4;
    const int when = turn % 3;
    Frame& frame = shot.experience().frame();
    frame.begin();
    record(shot, frame);
    frame.submit();
    frame.begin();  // two frames of the old quality are on their way
    record(shot, frame);
    if (when == 2) shot.experience().apply(at(shot, presets[to]), true);
    frame.submit();
    if (when == 0) shot.experience().apply(at(shot, presets[to]), true);
    if (when == 1) {
      frame.finish();
      EXPECT_EQ(test::differing_pixels(picture_of(test::device(), shot.experience(), 0), fresh[from]), 0)
          << turn << ": the old picture";
    }
    frame.begin();
    if (when == 1) shot.experience().apply(at(shot, presets[to]), true);
    record(shot, frame);
    frame.submit();
    frame.finish();
    EXPECT_EQ(test::differing_pixels(picture_of(test::device(), shot.experience(), 0), fresh[to]), 0)
        << turn << ": the new picture";
  }
  (void)shot.picture(head, time_s);
  test::device().wait_idle();
  EXPECT_EQ(test::device().objects().size(), objects);
  EXPECT_EQ(test::device().memory().used_bytes(), bytes);
}

}  // namespace

}  // namespace seascape
