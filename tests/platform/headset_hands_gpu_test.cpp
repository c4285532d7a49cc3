// Hands without controllers in a headset on the simulated runtime, up to the Input of each frame. Controls are named
// beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/gpu/headset_rig.h"

namespace seascape {
namespace {

using test::acted;
using test::became;
using test::HeadsetRig;
using test::HostileRuntime;
using test::tracked;

class HeadsetHandsTest : public test::GpuTest {};

const Pose left_at{{-0.2, 1.0, -0.4}, glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 0.4, -0.2)))},
    right_at{{0.25, 1.1, -0.45}, glm::angleAxis(-1.9, glm::normalize(glm::dvec3(0.3, 1.0, 0.6)))};

SimulatedOptions bare(std::vector<InputEvent> events, std::array<bool, 2> hands = {true, true}) {
  events.push_back(tracked(0, Tracker::left, left_at));
  events.push_back(tracked(0, Tracker::right, right_at));
  std::stable_sort(events.begin(), events.end(),
                   [](const InputEvent& a, const InputEvent& b) { return a.time_s < b.time_s; });
  SimulatedOptions options = test::simulated(std::move(events));
  options.bare_hands = hands;
  return options;
}

int pressed(const Input& input, Action action) {
  return int(std::count_if(input.pressed.begin(), input.pressed.end(),
                           [&](const Press& press) { return press.action == action; }));
}

void expect_at(const std::optional<Hand>& hand, const Pose& grip, int frame) {
  ASSERT_TRUE(hand.has_value()) << frame;
  EXPECT_LT(glm::distance(hand->grip.position_m, grip.position_m), 1e-5) << frame;
  EXPECT_GT(std::abs(glm::dot(hand->grip.orientation, grip.orientation)), 1.0 - 1e-6) << frame;
  // The palm's fingers point against the grip's y.
  EXPECT_LT(glm::distance(hand->aim.orientation * glm::dvec3(0, 0, -1), grip.orientation * glm::dvec3(0, -1, 0)), 1e-4)
      << frame;
}

// A pinch selects, a fist grabs, each with its own hand, where the script has it; and what needs a controller is
// silent. Controls: the hands exchanged; closing taken for a pinch; grip_of_palm() the palm itself.
TEST_F(HeadsetHandsTest, APinchSelectsAndAFistGrabs) {
  HeadsetRig rig(
      bare({acted(2, Action::select_left, 1.0), acted(5, Action::select_left, 0.0), acted(7, Action::grab_right, 1.0),
            acted(10, Action::grab_right, 0.0), acted(2, Action::move_x, 1.0), acted(12, Action::select_right, 1.0),
            acted(12, Action::grab_left, 1.0)}));
  for (int frame = 0; frame < 15; ++frame) {
    rig.step(false);
    const Input& input = rig.headset.input();
    if (frame == 0) continue;
    expect_at(input.hands[0], left_at, frame);
    expect_at(input.hands[1], right_at, frame);
    EXPECT_EQ(input.value(Action::select_left), frame >= 2 && frame < 5 ? 1.0 : 0.0) << frame;
    EXPECT_EQ(input.value(Action::grab_right), frame >= 7 && frame < 10 ? 1.0 : 0.0) << frame;
    EXPECT_EQ(input.value(Action::select_right), frame >= 12 ? 1.0 : 0.0) << frame;
    EXPECT_EQ(input.value(Action::grab_left), frame >= 12 ? 1.0 : 0.0) << frame;
    EXPECT_EQ(input.value(Action::move_x), 0.0) << frame;
    EXPECT_EQ(pressed(input, Action::select_left), frame == 2) << frame;
    EXPECT_EQ(pressed(input, Action::grab_right), frame == 7) << frame;
    EXPECT_EQ(input.pressed.size(), frame == 2 || frame == 7 ? 1u : frame == 12 ? 2u : 0u) << frame;
  }
}

// Half a fist is half a grab. Control: closed() as 0 or 1.
TEST_F(HeadsetHandsTest, AHandClosesByDegrees) {
  HeadsetRig rig(bare({acted(2, Action::grab_left, 0.5)}));
  rig.steps(4);
  EXPECT_GT(rig.headset.input().value(Action::grab_left), 0.2);
  EXPECT_LT(rig.headset.input().value(Action::grab_left), 0.9);
}

// A hand whose joints are lost lets go, and grabs and selects again only once it was open. Controls: see_hand() without
// lose().
TEST_F(HeadsetHandsTest, LostJointsLetGo) {
  HeadsetRig rig(bare({acted(2, Action::select_left, 1.0), acted(2, Action::grab_right, 1.0),
                       tracked(5, Tracker::left, std::nullopt), tracked(5, Tracker::right, std::nullopt),
                       tracked(8, Tracker::left, left_at), tracked(8, Tracker::right, right_at),
                       acted(11, Action::select_left, 0.0), acted(11, Action::grab_right, 0.0),
                       acted(13, Action::select_left, 1.0), acted(13, Action::grab_right, 1.0)}));
  for (int frame = 0; frame < 16; ++frame) {
    rig.step(false);
    const Input& input = rig.headset.input();
    const bool held = (frame >= 2 && frame < 5) || frame >= 13;
    for (const Action action : {Action::select_left, Action::grab_right}) {
      EXPECT_EQ(input.value(action), held ? 1.0 : 0.0) << frame;
      EXPECT_EQ(pressed(input, action), frame == 2 || frame == 13) << frame;
    }
    EXPECT_EQ(input.hands[0].has_value(), frame >= 1 && (frame < 5 || frame >= 8)) << frame;
  }
}

// A hand that holds a controller is where that says, and its joints are not asked for, whatever they are. Controls:
// joints asked for first; both at once.
TEST_F(HeadsetHandsTest, AControllerTakesPrecedence) {
  HeadsetRig rig(bare({acted(3, Action::select_right, 1.0), acted(3, Action::grab_left, 1.0)}, {true, false}));
  int asked = 0;
  rig.calls.instead.LocateHandJointsEXT = [&](XrHandTrackerEXT tracker, const XrHandJointsLocateInfoEXT* info,
                                              XrHandJointLocationsEXT* to) {
    ++asked;
    const XrResult result = rig.calls.real.LocateHandJointsEXT(tracker, info, to);
    for (std::uint32_t i = 0; i < to->jointCount; ++i) to->jointLocations[i].pose.position.y += 1.0f;
    return result;
  };
  rig.steps(6);
  const Input& input = rig.headset.input();
  EXPECT_EQ(asked, 5);  // of the left alone, from the second frame on, in which it has the focus
  ASSERT_TRUE(input.hands[0] && input.hands[1]);
  EXPECT_NEAR(input.hands[0]->grip.position_m.y, left_at.position_m.y + 1.0, 1e-5);
  EXPECT_NEAR(input.hands[1]->grip.position_m.y, right_at.position_m.y, 1e-5);
  EXPECT_EQ(input.value(Action::select_right), 1.0);
  EXPECT_EQ(input.value(Action::grab_left), 1.0);
  // A controller is taken up: from then on it is that.
  rig.calls.instead.GetActionStatePose = [](XrSession, const XrActionStateGetInfo*, XrActionStatePose* state) {
    state->isActive = XR_TRUE;
    return XR_SUCCESS;
  };
  rig.step();
  EXPECT_EQ(asked, 5);
  EXPECT_NEAR(rig.headset.input().hands[0]->grip.position_m.y, left_at.position_m.y, 1e-5);
  EXPECT_EQ(rig.headset.input().value(Action::grab_left), 0.0);
}

// Without the focus no hand is there and nothing is done; what is pinched when it comes back was meant for others.
// Control: sync() that goes on without the focus.
TEST_F(HeadsetHandsTest, UnfocusedHandsDoNothing) {
  HeadsetRig rig(
      bare({acted(2, Action::select_left, 1.0), became(4, HeadsetState::unfocused), became(9, HeadsetState::focused),
            acted(14, Action::select_left, 0.0), acted(16, Action::select_left, 1.0)}));
  for (int frame = 0; frame < 20; ++frame) {
    rig.step();
    const Input& input = rig.headset.input();
    const bool focused = (frame >= 1 && frame < 4) || frame >= 10;  // events come a frame later
    EXPECT_EQ(input.hands[0].has_value(), focused) << frame;
    EXPECT_EQ(input.value(Action::select_left), frame == 2 || frame == 3 || frame >= 16 ? 1.0 : 0.0) << frame;
    EXPECT_EQ(pressed(input, Action::select_left), frame == 2 || frame == 16) << frame;
  }
}

// Joints that are not valid, are no numbers, or lie where no hand reaches: no hand, and nothing done. Controls: the
// flags not looked at; isActive not looked at; pose_is_sound() left out.
TEST_F(HeadsetHandsTest, HostileJointsAreNoHand) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto spoil = [](XrHandJointLocationsEXT* to, std::size_t joint, const XrPosef& pose) {
    to->jointLocations[joint].pose = pose;
    return XR_SUCCESS;
  };
  using Spoil = std::function<XrResult(XrHandJointLocationsEXT*)>;
  for (const Spoil& harm : {
           Spoil([](auto* to) {
             to->jointLocations[10].locationFlags = XR_SPACE_LOCATION_POSITION_VALID_BIT;
             return XR_SUCCESS;
           }),
           Spoil([](auto* to) {
             to->jointLocations[25].locationFlags = 0;
             return XR_SUCCESS;
           }),
           Spoil([](auto* to) {
             to->isActive = XR_FALSE;
             return XR_SUCCESS;
           }),
           Spoil([&](auto* to) {
             return spoil(to, 5, {{0, 0, 0, 1}, {nan, 0, 0}});
           }),
           Spoil([&](auto* to) {
             return spoil(to, 0, {{nan, 0, 0, 1}, {-0.2f, 1.0f, -0.4f}});
           }),
           Spoil([&](auto* to) {
             return spoil(to, 0, {{0, 0, 0, 0}, {-0.2f, 1.0f, -0.4f}});
           }),
           Spoil([&](auto* to) {
             return spoil(to, 12, {{0, 0, 0, 1}, {1e30f, 0, 0}});
           }),
           Spoil([&](auto* to) {
             return spoil(to, 15, {{0, 0, 0, 1}, {3.0f, 1.0f, 0}});
           }),
           Spoil([](auto*) { return XR_ERROR_RUNTIME_FAILURE; }),
           Spoil([](auto*) { return XR_ERROR_TIME_INVALID; }),
       }) {
    HeadsetRig rig(bare({acted(2, Action::select_left, 1.0), acted(2, Action::grab_right, 1.0)}));
    rig.steps(4);
    EXPECT_EQ(rig.headset.input().value(Action::select_left), 1.0);
    rig.calls.instead.LocateHandJointsEXT = [&](XrHandTrackerEXT tracker, const XrHandJointsLocateInfoEXT* info,
                                                XrHandJointLocationsEXT* to) {
      (void)rig.calls.real.LocateHandJointsEXT(tracker, info, to);
      return harm(to);
    };
    rig.steps(2);
    for (const auto& hand : rig.headset.input().hands) EXPECT_FALSE(hand.has_value());
    for (const double value : rig.headset.input().values) EXPECT_EQ(value, 0.0);
    EXPECT_EQ(rig.runtime.frames_shown(), 6u);
  }
}

// A headset that does not see hands is not asked to. Control: the system's word not looked at.
TEST_F(HeadsetHandsTest, AHeadsetThatSeesNoneHasControllersAlone) {
  const auto made = [](const HeadsetRig& rig) {
    return std::count(rig.calls.calls().begin(), rig.calls.calls().end(), "xrCreateHandTrackerEXT");
  };
  {
    HeadsetRig rig(bare({acted(2, Action::grab_left, 1.0)}, {false, false}));
    rig.steps(4);
    EXPECT_EQ(made(rig), 0);
    EXPECT_EQ(rig.headset.input().value(Action::grab_left), 1.0);
  }
  HeadsetRig rig(bare({acted(2, Action::grab_left, 1.0)}),
                 [](HostileRuntime& calls) { calls.lack("xrLocateHandJointsEXT"); });
  rig.steps(4);
  EXPECT_EQ(made(rig), 0);
  EXPECT_FALSE(rig.headset.input().hands[0].has_value());
  EXPECT_EQ(rig.headset.input().value(Action::grab_left), 0.0);
}

// A session that is lost between the two hands gives the first one's tracker back. Control: the catch without its call.
TEST_F(HeadsetHandsTest, ATrackerIsGivenBackWhereTheOtherFails) {
  SimulatedRuntime runtime(bare({}));
  HostileRuntime calls(runtime);
  calls.fail("xrCreateHandTrackerEXT", 2, XR_ERROR_SESSION_LOST);
  HeadsetSystem system(calls.get(), runtime.next());
  EXPECT_THROW(Headset(system, test::device(), {}), SessionLost);
  EXPECT_EQ(std::count(calls.calls().begin(), calls.calls().end(), "xrDestroyHandTrackerEXT"), 1);
}

// A new session sees them anew, and the old one's trackers are given back. Control: a destructor without its calls.
TEST_F(HeadsetHandsTest, HandsAreSeenInANewSession) {
  HeadsetRig rig(bare({became(4, HeadsetState::lost), acted(10, Action::select_right, 1.0)}));
  rig.steps(14);
  EXPECT_EQ(rig.headset.input().value(Action::select_right), 1.0);
  const auto& calls = rig.calls.calls();
  EXPECT_EQ(std::count(calls.begin(), calls.end(), "xrCreateHandTrackerEXT"), 4);
  EXPECT_EQ(std::count(calls.begin(), calls.end(), "xrDestroyHandTrackerEXT"), 2);
}

}  // namespace
}  // namespace seascape
