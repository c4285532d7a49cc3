// The tables of actions and bindings. Controls are named beside each test; each was seen to fail.
#include "platform/bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

namespace seascape {
namespace {

const ControllerProfile& profile(std::string_view name) {
  for (const ControllerProfile& one : controller_profiles())
    if (one.path.find(name) != std::string_view::npos) return one;
  throw std::runtime_error("no such profile");
}

// Control: two rows of one name.
TEST(Actions, HaveANameEach) {
  std::set<std::string_view> names;
  for (const ActionRow& row : action_rows()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.sentence.empty()) << row.name;
    EXPECT_EQ(action_named(row.name), row.action);
  }
  EXPECT_EQ(action_named("jibe"), std::nullopt);
}

// The names of shared/DESIGN.md, which files are written with. Control: snap_turn renamed.
TEST(Actions, KeepTheirFixedNames) {
  for (const char* name : {"move_x",    "move_z",     "move_y",   "turn",  "snap_turn", "teleport",   "swim",
                           "grab_left", "grab_right", "throttle", "helm",  "sheet",     "oar_left",   "oar_right",
                           "board",     "menu",       "recentre", "light", "mirror",    "screenshot", "record"})
    EXPECT_TRUE(action_named(name).has_value()) << name;
}

// One asks for every action with the keyboard; with the mouse for what a hand would select. Control: the row of B.
TEST(KeyBindings, GiveEveryAction) {
  for (const ActionRow& row : action_rows()) {
    if (row.action == Action::select_left || row.action == Action::select_right) continue;
    double least = 0.0, most = 0.0;
    for (const KeyBinding& key : key_bindings())
      if (key.action == row.action) {
        least = std::min(least, key.value);
        most = std::max(most, key.value);
      }
    EXPECT_EQ(most, 1.0) << row.name;
    EXPECT_EQ(least, row.least()) << row.name;
  }
}

// What is bound twice at one post would do two things at once. Control: C for board too.
TEST(KeyBindings, AskForOneThingEach) {
  for (const Post post : {Post::afoot, Post::aboard}) {
    std::set<int> seen;
    for (const KeyBinding& key : key_bindings())
      if (holds_at(key.post, post)) {
        EXPECT_TRUE(seen.insert(key.key).second) << key.key;
      }
  }
}

// Control: the row of the right thumb.
TEST(GamepadBindings, GiveWhatAPersonWithoutKeysNeeds) {
  std::map<Action, double> found;
  for (const GamepadBinding& binding : gamepad_bindings()) found[binding.action] = binding.value;
  for (const Action action :
       {Action::move_x,     Action::move_z,   Action::move_y,   Action::turn,      Action::snap_turn,
        Action::pitch,      Action::teleport, Action::swim,     Action::grab_left, Action::grab_right,
        Action::throttle,   Action::helm,     Action::sheet,    Action::oar_left,  Action::oar_right,
        Action::board,      Action::menu,     Action::recentre, Action::light,     Action::mirror,
        Action::screenshot, Action::record,   Action::fast,     Action::moor,      Action::anchor})
    EXPECT_TRUE(found.contains(action)) << row_of(action).name;
  std::set<std::tuple<int, int, bool>> seen;
  for (const Post post : {Post::afoot, Post::aboard})
    for (const GamepadBinding& binding : gamepad_bindings())
      if (holds_at(binding.post, post)) {
        EXPECT_TRUE(seen.insert({int(binding.part), binding.which, post == Post::aboard}).second) << binding.which;
      }
}

// Control: without the dead part; without the stretch that makes up for it.
TEST(GamepadBindings, SticksRestInTheMiddle) {
  EXPECT_EQ(stick_value(0.1), 0.0);
  EXPECT_EQ(stick_value(-0.1), 0.0);
  EXPECT_EQ(stick_value(1.0), 1.0);
  EXPECT_EQ(stick_value(-1.0), -1.0);
  EXPECT_LT(stick_value(0.16), 0.05);
}

// Controls: triggers read as sticks are; bindings of the other post not left out.
TEST(GamepadBindings, BecomeActions) {
  std::array<unsigned char, GLFW_GAMEPAD_BUTTON_LAST + 1> buttons{};
  std::array<float, GLFW_GAMEPAD_AXIS_LAST + 1> axes{0.0f, -1.0f, 0.05f, 0.0f, -1.0f, 1.0f};
  buttons[GLFW_GAMEPAD_BUTTON_START] = 1;
  InputGatherer gatherer;
  gather_gamepad(gatherer, Post::afoot, buttons, axes);
  Input input = gatherer.take();
  EXPECT_EQ(input.value(Action::move_z), -1.0);  // pushed away: forward
  EXPECT_EQ(input.value(Action::turn), 0.0);
  EXPECT_EQ(input.value(Action::grab_left), 0.0);
  EXPECT_EQ(input.value(Action::grab_right), 1.0);
  EXPECT_EQ(input.value(Action::throttle), 0.0);
  EXPECT_TRUE(input.held(Action::menu));
  axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = 0.0f;  // half pulled
  gather_gamepad(gatherer, Post::aboard, buttons, axes);
  input = gatherer.take();
  EXPECT_EQ(input.value(Action::move_z), 0.0);
  EXPECT_EQ(input.value(Action::throttle), stick_value(0.5));
  gather_gamepad(gatherer, Post::afoot, {}, {});  // a pad of fewer parts
  EXPECT_EQ(gatherer.take().value(Action::move_z), 0.0);
}

// Every profile moves on, points, and reaches the panel, from which the rest is reached; a profile with sticks does all
// that its input can. Control: without Vive's menu.
TEST(ControllerProfiles, ReachEverything) {
  for (const ControllerProfile& one : controller_profiles()) {
    std::set<Action> found;
    for (const ControllerBinding& binding : one.bindings) {
      found.insert(binding.action);
      EXPECT_TRUE(binding.path.starts_with("left/input/") || binding.path.starts_with("right/input/")) << binding.path;
    }
    for (const Action action : {Action::select_left, Action::select_right, Action::menu, Action::teleport})
      EXPECT_TRUE(found.contains(action)) << one.path << " " << row_of(action).name;
    if (one.path.ends_with("simple_controller")) continue;
    for (const Action action : {Action::move_x, Action::move_z, Action::move_y, Action::turn, Action::snap_turn,
                                Action::swim, Action::grab_left, Action::grab_right, Action::throttle, Action::helm,
                                Action::sheet, Action::oar_left, Action::oar_right})
      EXPECT_TRUE(found.contains(action)) << one.path << " " << row_of(action).name;
  }
  EXPECT_EQ(controller_profiles().size(), 6u);
}

// Controls: a throttle afoot in one profile; a stick that points the other way in one.
TEST(ControllerProfiles, AgreeAboutAnAction) {
  for (const ControllerProfile& one : controller_profiles())
    for (const ControllerBinding& binding : one.bindings) {
      EXPECT_EQ(binding.post, controller_post(binding.action)) << one.path << " " << binding.path;
      EXPECT_EQ(binding.value, controller_value(binding.action)) << one.path << " " << binding.path;
    }
}

// Controls: letters left as they are; the menu moved to where Touch has none.
TEST(ControllerProfiles, AreMirroredForTheLeftHanded) {
  const ControllerProfile& touch = profile("oculus/touch");
  EXPECT_EQ(mirrored(touch, "right/input/a/click"), "left/input/x/click");
  EXPECT_EQ(mirrored(touch, "left/input/y/click"), "right/input/b/click");
  EXPECT_EQ(mirrored(touch, "left/input/thumbstick/y"), "right/input/thumbstick/y");
  EXPECT_EQ(mirrored(touch, "left/input/menu/click"), "left/input/menu/click");
  EXPECT_EQ(mirrored(profile("index"), "right/input/a/click"), "left/input/a/click");
  EXPECT_EQ(mirrored(profile("vive"), "left/input/menu/click"), "right/input/menu/click");
  EXPECT_TRUE(stays_with_its_hand(Action::grab_left));
  EXPECT_FALSE(stays_with_its_hand(Action::move_x));
}

}  // namespace
}  // namespace seascape
