// The panel's board before a headset: it is pointed at with a hand, and shown in front of the head. Controls are named
// beside each test; each was seen to fail.
#include "platform/headset_overlay.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <thread>

#include "tests/support/gpu/headset_rig.h"

namespace seascape {
namespace {

using test::acted;
using test::became;
using test::HeadsetRig;
using test::simulated;
using test::tracked;

class HeadsetOverlayTest : public test::GpuTest {};

constexpr double eyes_m = 1.7;

// Below the eyes, in front, pointing at the board's middle or past it.
Pose hand(double pitch_deg) {
  return {{0.1, 1.5, -0.3}, glm::angleAxis(glm::radians(pitch_deg), glm::dvec3(1.0, 0.0, 0.0))};
}

// A button over all of the board. Returns whether it was pressed.
bool button(Overlay& overlay) {
  overlay.begin(true);
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
  ImGui::Begin("board", nullptr, ImGuiWindowFlags_NoDecoration);
  const bool pressed = ImGui::Button("all", {-1.0f, -1.0f});
  ImGui::End();
  overlay.end();
  return pressed;
}

// Controls: the ray along +z; the share from the lower left; a board that is seen through from behind.
TEST(PointedAt, IsWhereTheRayMeetsTheFront) {
  const Pose board{{0.0, 1.5, -1.0}};
  const glm::dvec2 size(0.8, 1.0);
  const auto from = [&](const glm::dvec3& at, double yaw_deg = 0.0) {
    return pointed_at({at, glm::angleAxis(glm::radians(yaw_deg), glm::dvec3(0.0, 1.0, 0.0))}, board, size);
  };
  ASSERT_TRUE(from({0.0, 1.5, 0.0}));
  EXPECT_LT(glm::distance(*from({0.0, 1.5, 0.0}), glm::dvec2(0.5)), 1e-12);
  EXPECT_LT(glm::distance(*from({0.2, 1.9, 0.0}), glm::dvec2(0.75, 0.1)), 1e-12);
  EXPECT_FALSE(from({0.5, 1.5, 0.0}));
  EXPECT_FALSE(from({0.0, 1.5, -2.0}, 180.0));
  EXPECT_FALSE(from({0.0, 1.5, 0.0}, 180.0));
}

// A hand presses what it points at, and feels it; one that points past it, or is without the focus, does not. Controls:
// select_left for the right hand; the ray not asked for; the hand's buzz left out.
TEST_F(HeadsetOverlayTest, AHandPressesWhatItPointsAt) {
  HeadsetRig rig(simulated({tracked(0, Tracker::head, Pose{{0.0, eyes_m, 0.0}}), tracked(0, Tracker::right, hand(0.0)),
                            acted(4, Action::select_right, 1.0), acted(6, Action::select_right, 0.0),
                            tracked(9.9, Tracker::right, hand(0.0)), tracked(10, Tracker::right, hand(80.0)),
                            acted(14, Action::select_right, 1.0), acted(16, Action::select_right, 0.0),
                            tracked(19.9, Tracker::right, hand(80.0)), tracked(20, Tracker::right, hand(0.0)),
                            became(22, HeadsetState::unfocused), acted(24, Action::select_right, 1.0),
                            acted(26, Action::select_right, 0.0)}));
  const std::unique_ptr<Overlay> overlay = rig.headset.make_overlay();
  std::vector<int> pressed;
  for (int frame = 0; frame < 30; ++frame) {
    rig.step();
    if (button(*overlay)) pressed.push_back(frame);
    if (frame == 3 || frame == 12) {
      EXPECT_EQ(overlay->wants_pointer(), frame == 3) << frame;
    }
  }
  EXPECT_EQ(pressed, std::vector<int>{6});  // let go
  ASSERT_EQ(rig.runtime.buzzes().size(), 1u);
  EXPECT_EQ(rig.runtime.buzzes()[0].hand, 1);
}

// A lost session takes the board's images with it, and the next one has others. Control: the board kept.
TEST_F(HeadsetOverlayTest, OutlivesASession) {
  HeadsetRig rig(simulated({became(5, HeadsetState::lost)}));
  const std::unique_ptr<Overlay> overlay = rig.headset.make_overlay();
  for (int frame = 0; frame < 15; ++frame) {
    button(*overlay);
    rig.step();
  }
  EXPECT_GT(rig.runtime.frames_shown(), 10u);
}

// Runtimes use the queue also where swapchains come and go: another thread may submit all the while, as the mirror
// does. Controls seen: a swapchain that is made, or destroyed, without the lock.
TEST_F(HeadsetOverlayTest, AnotherThreadMaySubmitAllTheWhile) {
  HeadsetRig rig(simulated());
  const std::jthread other([&](const std::stop_token& ends) {
    while (!ends.stop_requested()) test::device().run_now([](VkCommandBuffer) {});
  });
  for (int board = 0; board < 10; ++board) {
    const std::unique_ptr<Overlay> overlay = rig.headset.make_overlay();
    button(*overlay);
    rig.step();
  }
  EXPECT_GE(rig.runtime.frames_shown(), 8u);
}

// A session may be lost in any call, those of the board too. Control: without the question in Headset::end.
TEST_F(HeadsetOverlayTest, OutlivesASessionThatEndsInItsCalls) {
  for (const int after : {1, 2, 3, 4, 5, 6, 7, 8, 9}) {
    SCOPED_TRACE(after);
    HeadsetRig rig(simulated(), [&](test::HostileRuntime& runtime) {
      runtime.fail("xrAcquireSwapchainImage", after, XR_ERROR_SESSION_LOST);
    });
    const std::unique_ptr<Overlay> overlay = rig.headset.make_overlay();
    for (int frame = 0; frame < 8; ++frame) {
      button(*overlay);
      rig.step();
    }
    EXPECT_GT(rig.runtime.frames_shown(), 4u);
  }
}

// Another overlay's context stays current, or none: what comes after it, such as a window's overlay where the runtime
// dies, would else begin with one that is gone. Control: the context left current by its constructor.
TEST_F(HeadsetOverlayTest, LeavesNoContextBehind) {
  ASSERT_EQ(ImGui::GetCurrentContext(), nullptr);
  {
    HeadsetRig rig(simulated());
    const std::unique_ptr<Overlay> overlay = rig.headset.make_overlay();
    EXPECT_EQ(ImGui::GetCurrentContext(), nullptr);
    rig.steps(2);
    (void)button(*overlay);
    rig.steps(1);
    EXPECT_EQ(ImGui::GetCurrentContext(), nullptr);
  }
  EXPECT_EQ(ImGui::GetCurrentContext(), nullptr);
}

}  // namespace
}  // namespace seascape
