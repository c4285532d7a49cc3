// What hands and controllers do with a headset on the simulated runtime, up to the Input of each frame. Controls are
// named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/gpu/headset_rig.h"

namespace seascape {
namespace {

using test::acted;
using test::became;
using test::HeadsetRig;
using test::simulated;
using test::tracked;

class HeadsetInputTest : public test::GpuTest {};

Pose at(double x, double y, double z) { return {{x, y, z}}; }

// Both hands are there, or nothing can be grabbed.
std::vector<InputEvent> hands() {
  return {tracked(0, Tracker::left, at(-0.2, 1.0, -0.4)), tracked(0, Tracker::right, at(0.2, 1.0, -0.4))};
}

// Every action of a script: its value in the frames that it is held in, a press in the first of them and no other; one
// that is over between two frames counts in the second. Controls: the quick ones left out by the simulated
// runtime; its values not divided by controller_value().
TEST_F(HeadsetInputTest, EveryActionCountsInItsFrame) {
  constexpr int each = 12;
  std::vector<InputEvent> events = hands();
  for (const ActionRow& row : action_rows()) {
    const int begin = each * int(row.action);
    events.push_back(acted(begin + 2, row.action, 1.0));
    events.push_back(acted(begin + 4, row.action, 0.0));
    if (row.kind == ActionKind::axis) {
      events.push_back(acted(begin + 5, row.action, -0.75));
      events.push_back(acted(begin + 7, row.action, 0.0));
    }
    events.push_back(acted(begin + 8.25, row.action, 1.0));
    events.push_back(acted(begin + 8.75, row.action, 0.0));
  }
  HeadsetRig rig(simulated(events));
  for (int frame = 0; frame < each * int(action_count); ++frame) {
    const ActionRow& row = action_rows()[std::size_t(frame / each)];
    rig.headset.set_post(controller_post(row.action));
    rig.step(false);
    const int in = frame % each;
    const bool axis = row.kind == ActionKind::axis;
    const double value = in == 2 || in == 3 || in == 9 ? 1.0 : axis && (in == 5 || in == 6) ? -0.75 : 0.0;
    const Input& input = rig.headset.input();
    for (const ActionRow& one : action_rows())
      ASSERT_NEAR(input.value(one.action), one.action == row.action ? value : 0.0, 1e-6)
          << one.name << " in frame " << in << " of " << row.name;
    const bool pressed = in == 2 || in == 9 || (axis && in == 5);
    ASSERT_EQ(input.pressed.size(), pressed ? 1u : 0u) << row.name << " in frame " << in;
    if (!pressed) continue;
    EXPECT_EQ(input.pressed.front().action, row.action);
    EXPECT_EQ(input.pressed.front().value, in == 5 ? -1.0 : 1.0) << row.name;
  }
}

// What steers a boat is silent afoot, and what moves one afoot is silent in a boat. Controls: every set active at every
// post, with holds_at() left out; the set of one post active at all.
TEST_F(HeadsetInputTest, ActionsHoldAtTheirPost) {
  std::vector<InputEvent> events = hands();
  for (const ActionRow& row : action_rows()) events.push_back(acted(1, row.action, 1.0));
  HeadsetRig rig(simulated(events));
  for (const Post post : {Post::anywhere, Post::afoot, Post::aboard}) {
    rig.headset.set_post(post);
    rig.steps(2);
    for (const ActionRow& row : action_rows())
      EXPECT_EQ(rig.headset.input().value(row.action), holds_at(controller_post(row.action), post) ? 1.0 : 0.0)
          << row.name << " at post " << int(post);
  }
}

// Each input of each controller does what its rows say and nothing else, in either direction, for either hand.
// Controls: a row's value turned in one profile; controller_value() not applied; bindings of one profile suggested for
// another; left_handed not handed on.
TEST_F(HeadsetInputTest, EveryBindingOfEveryControllerActs) {
  int tried = 0;
  for (const ControllerProfile& profile : controller_profiles())
    for (const bool left_handed : {false, true}) {
      SimulatedOptions options = simulated(hands());
      options.profile = profile.path;
      HeadsetOptions how;
      how.left_handed = left_handed;
      HeadsetRig rig(options, how);
      rig.steps(2);
      const auto path_of = [&](const ControllerBinding& binding) {
        return left_handed && !stays_with_its_hand(binding.action) ? mirrored(profile, binding.path)
                                                                   : std::string(binding.path);
      };
      std::set<std::string> paths;
      for (const ControllerBinding& binding : profile.bindings) paths.insert(path_of(binding));
      for (const Post post : {Post::afoot, Post::aboard})
        for (const std::string& path : paths)
          for (const double pushed : {1.0, -1.0}) {
            if (pushed < 0.0 && !path.ends_with("/x") && !path.ends_with("/y")) continue;
            std::map<Action, double> expected;
            for (const ControllerBinding& binding : profile.bindings)
              if (path_of(binding) == path && holds_at(binding.post, post))
                expected[binding.action] = std::clamp(pushed * binding.value, row_of(binding.action).least(), 1.0);
            rig.headset.set_post(post);
            rig.runtime.set_input(path, pushed);
            rig.step(false);
            const Input input = rig.headset.input();
            std::size_t presses = 0;
            for (const ActionRow& row : action_rows()) {
              const double value = expected.contains(row.action) ? expected[row.action] : 0.0;
              ASSERT_EQ(input.value(row.action), value) << profile.path << " " << path << " " << row.name;
              presses += value != 0.0;
            }
            ASSERT_EQ(input.pressed.size(), presses) << profile.path << " " << path;
            for (const Press& press : input.pressed) ASSERT_EQ(press.value, expected[press.action]) << path;
            rig.runtime.set_input(path, 0.0);
            rig.step(false);
            ASSERT_TRUE(rig.headset.input().pressed.empty());
            ++tried;
          }
    }
  EXPECT_GT(tried, 300);
}

// The path of an input that stands for another's, written out: which hand's stick moves a left-handed person. Control:
// left_handed not handed on.
TEST_F(HeadsetInputTest, TheLeftHandedMoveWithTheRight) {
  SimulatedOptions options = simulated(hands());
  options.profile = "/interaction_profiles/oculus/touch_controller";
  HeadsetOptions how;
  how.left_handed = true;
  HeadsetRig rig(options, how);
  rig.steps(2);
  rig.runtime.set_input("right/input/thumbstick/x", 1.0);
  rig.runtime.set_input("left/input/squeeze/value", 1.0);
  rig.step(false);
  EXPECT_EQ(rig.headset.input().value(Action::move_x), 1.0);
  EXPECT_EQ(rig.headset.input().value(Action::turn), 0.0);
  EXPECT_EQ(rig.headset.input().value(Action::grab_left), 1.0);
  EXPECT_EQ(rig.headset.input().value(Action::grab_right), 0.0);
}

// Hands are where the script has them, and move as fast. Controls: the hands exchanged; the velocity of one frame taken
// for that of a second.
TEST_F(HeadsetInputTest, HandsAreWhereTheyAreTracked) {
  HeadsetRig rig(
      simulated({tracked(0, Tracker::right, at(0.2, 1.0, -0.4)), tracked(64, Tracker::right, at(0.2, 3.0, -0.4)),
                 tracked(4, Tracker::left, at(-0.3, 1.1, -0.5)), tracked(6, Tracker::left, std::nullopt)}));
  for (int frame = 0; frame < 10; ++frame) {
    rig.step(false);
    const auto& hands = rig.headset.input().hands;
    ASSERT_EQ(hands[1].has_value(), frame >= 1) << frame;
    ASSERT_EQ(hands[0].has_value(), frame >= 1 && frame < 6) << frame;
    if (hands[0]) {
      EXPECT_LT(glm::length(hands[0]->grip.position_m - glm::dvec3(-0.3, 1.1, -0.5)), 1e-6);
    }
    if (!hands[1]) continue;
    EXPECT_LT(glm::length(hands[1]->grip.position_m - glm::dvec3(0.2, 1.0 + test::time_of(2 * frame), -0.4)), 1e-6);
    EXPECT_LT(glm::length(hands[1]->velocity_mps - glm::dvec3(0.0, 2.0, 0.0)), 1e-3) << frame;
  }
}

// A hand that is lost while it holds something lets go, and holds again only once it was open. Controls: without
// let_go(); without its memory, in frame 9.
TEST_F(HeadsetInputTest, ALostHandLetsGo) {
  std::vector<InputEvent> events = hands();
  events.push_back(acted(2, Action::grab_left, 1.0));
  events.push_back(acted(2, Action::grab_right, 1.0));
  events.push_back(tracked(5, Tracker::left, std::nullopt));
  events.push_back(tracked(8, Tracker::left, at(-0.2, 1.0, -0.4)));
  events.push_back(acted(11, Action::grab_left, 0.0));
  events.push_back(acted(13, Action::grab_left, 1.0));
  HeadsetRig rig(simulated(events));
  for (int frame = 0; frame < 16; ++frame) {
    rig.step(false);
    const Input& input = rig.headset.input();
    const bool left = (frame >= 2 && frame < 5) || frame >= 13;
    EXPECT_EQ(input.value(Action::grab_left), left ? 1.0 : 0.0) << frame;
    EXPECT_EQ(input.value(Action::grab_right), frame >= 2 ? 1.0 : 0.0) << frame;
    EXPECT_EQ(input.pressed.size(), frame == 2 ? 2u : frame == 13 ? 1u : 0u) << frame;
  }
}

// A new session has controllers of its own. Control: its action sets attached once only.
TEST_F(HeadsetInputTest, ControllersWorkInANewSession) {
  std::vector<InputEvent> events = hands();
  events.push_back(became(4, HeadsetState::lost));
  events.push_back(acted(10, Action::move_x, 1.0));
  HeadsetRig rig(simulated(events));
  rig.steps(14);
  EXPECT_EQ(rig.headset.input().value(Action::move_x), 1.0);
  EXPECT_TRUE(rig.headset.input().hands[0].has_value());
}

}  // namespace
}  // namespace seascape
