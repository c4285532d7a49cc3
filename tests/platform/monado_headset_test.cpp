// A headset on a real runtime, Monado's: focus, the order of calls, and pictures that are to the bit those drawn
// without a headset for the views that were submitted. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include "tests/support/gpu/headset_pictures.h"
#include "tests/support/gpu/monado_headset.h"
#include "tests/support/gpu/picture.h"

#include "platform/xr_pose.h"

namespace seascape {
namespace {

using test::has_focus;
using test::HeadsetLook;
using test::HeadsetPicture;
using test::HeadsetScene;
using test::MonadoHeadset;
using test::MonadoTest;

// What the simulated headset's pictures are drawn of, for the views in the recording.
HeadsetPicture recorded(HeadsetPicture drawn, const std::vector<XrView>& submitted) {
  for (std::size_t eye = 0; eye < submitted.size(); ++eye) {
    const XrFovf& fov = submitted[eye].fov;
    const auto tangent = [](float angle) { return std::tan(double(angle)); };
    drawn.viewpoint.eyes[eye] = {
        composed(HeadsetScene::carrier, pose_from(submitted[eye].pose)),
        {tangent(fov.angleLeft), tangent(fov.angleRight), tangent(fov.angleUp), tangent(fov.angleDown)}};
  }
  return drawn;
}

bool comes_to_focus(HeadsetScene& sea) {
  for (int i = 0; i < 600; ++i)
    if (has_focus(sea.step())) return true;
  return false;
}

// So many frames with the focus, in order; every `every`th is drawn again without a headset.
void expect_pictures(const HeadsetLook& look, int frames, int every) {
  MonadoHeadset monado;
  const Scene scene = scene_of(look);
  HeadsetScene sea(*monado.device, *monado.headset, scene);
  ASSERT_TRUE(comes_to_focus(sea)) << "it does not come to have the focus";
  std::vector<HeadsetPicture> seen, as;
  double last_s = 0.0;
  for (int frame = 0; frame < frames; ++frame) {
    monado.record.next_frame();
    const bool kept = frame % every == every / 2;
    const DisplayFrame shown = sea.step(kept);
    ASSERT_TRUE(has_focus(shown)) << frame;
    ASSERT_EQ(monado.record.fault(true), "") << look.name << " frame " << frame;
    ASSERT_GT(shown.time_s, last_s) << frame;
    last_s = shown.time_s;
    if (!kept) continue;
    seen.push_back(sea.drawn());
    as.push_back(recorded(sea.drawn(), monado.record.taken().submitted));
  }
  const std::vector<HeadsetPicture> expected =
      drawn_without(*monado.device, scene, test::options_of(*monado.headset), as, monado.headset->hidden());
  ASSERT_EQ(seen.size(), std::size_t(frames / every));
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::string what = fmt::format("{} picture {} at {} s", look.name, i, seen[i].time_s);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      EXPECT_EQ(test::differing_pixels(seen[i].pictures[eye], expected[i].pictures[eye]), 0) << what << " eye " << eye;
      EXPECT_EQ(seen[i].pictures[eye].width, int(monado.system.facts().width)) << what;
      EXPECT_GT(test::statistics(seen[i].pictures[eye]).deviation, 5.0) << what;
    }
    EXPECT_GT(test::differing_pixels(seen[i].pictures[0], seen[i].pictures[1]), 1000) << what;
    if (i > 0) {
      EXPECT_GT(test::differing_pixels(seen[i - 1].pictures[0], seen[i].pictures[0]), 1000) << what;
    }
  }
}

// Controls seen: the eyes' views exchanged in end_frame(); their layers exchanged there; a pose moved there by a
// thousandth of a millimetre; xrEndFrame at the time plus 1.
TEST_F(MonadoTest, FiveHundredFrames) {
  expect_pictures({"low, 4 samples", {{"frame.shape", "tile"}, {"msaa", "4"}}}, 500, 25);
}

// Controls seen: the eyes exchanged in viewpoint(); drawn again with the views of the picture before.
TEST_F(MonadoTest, OtherFrames) {
  expect_pictures({"low, deferred", {{"msaa", "1"}}}, 20, 5);
  expect_pictures({"low, forward", {{"msaa", "1"}, {"frame.lighting", "forward"}}}, 20, 5);
  expect_pictures({"desktop, 4 samples", {{"frame.shape", "desktop"}, {"msaa", "4"}}}, 20, 5);
  expect_pictures({"high", {}, {}, "high"}, 20, 5);
}

}  // namespace
}  // namespace seascape
