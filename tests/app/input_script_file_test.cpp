// Input scripts as files, and as the actions of a camera path. Controls are named beside each test; each was seen.
#include "app/input_script_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/camera_path.h"
#include "engine/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

// The example of shared/DESIGN.md, with what it leaves out.
const std::string example = R"({"version": 1, "size": "1000x1100", "rate_hz": 72, "eye_distance_m": 0.07,
 "fov_deg": {"left": [-50, 45, 48, -50], "right": [-40, 51, 47, -49]},
 "events": [{"time_s": 0, "head": {"position_m": [0, 1.7, 0], "yaw_deg": 90, "pitch_deg": 0, "roll_deg": 0}},
            {"time_s": 1, "left": {"position_m": [-0.2, 1, -0.3], "orientation": [0, 1, 0, 0]}, "right": null},
            {"time_s": 2, "action": "throttle", "value": 0.7},
            {"time_s": 2, "action": "throttle", "value": -0.7, "state": "off"},
            {"time_s": 9, "state": "closed"}]})";

bool same(const InputEvent& a, const InputEvent& b) {
  if (a.time_s != b.time_s || a.what.index() != b.what.index()) return false;
  if (const auto* one = std::get_if<ActionEvent>(&a.what)) {
    const auto& other = std::get<ActionEvent>(b.what);
    return one->action == other.action && one->value == other.value;
  }
  if (const auto* one = std::get_if<HeadsetState>(&a.what)) return *one == std::get<HeadsetState>(b.what);
  const auto &one = std::get<TrackerEvent>(a.what), &other = std::get<TrackerEvent>(b.what);
  if (one.tracker != other.tracker || one.pose.has_value() != other.pose.has_value()) return false;
  return !one.pose ||
         (one.pose->position_m == other.pose->position_m && one.pose->orientation == other.pose->orientation);
}

void expect_same(const InputScript& a, const InputScript& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.rate_hz, b.rate_hz);
  EXPECT_EQ(a.eye_distance_m, b.eye_distance_m);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    EXPECT_EQ(a.eyes[eye].left_deg, b.eyes[eye].left_deg);
    EXPECT_EQ(a.eyes[eye].right_deg, b.eyes[eye].right_deg);
    EXPECT_EQ(a.eyes[eye].up_deg, b.eyes[eye].up_deg);
    EXPECT_EQ(a.eyes[eye].down_deg, b.eyes[eye].down_deg);
  }
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) EXPECT_TRUE(same(a.events[i], b.events[i])) << i;
}

// Controls: the eyes exchanged; up and down in the other order; width and height; "state" before "action".
TEST(InputScriptFile, ReadsWhatTheDesignSays) {
  const InputScript script = parse_input_script(example, "i.json");
  EXPECT_EQ(script.width, 1000);
  EXPECT_EQ(script.height, 1100);
  EXPECT_EQ(script.rate_hz, 72.0);
  EXPECT_EQ(script.eye_distance_m, 0.07);
  EXPECT_EQ(script.eyes[0].right_deg, 45.0);
  EXPECT_EQ(script.eyes[1].left_deg, -40.0);
  EXPECT_EQ(script.eyes[1].right_deg, 51.0);
  EXPECT_EQ(script.eyes[1].up_deg, 47.0);
  EXPECT_EQ(script.eyes[1].down_deg, -49.0);
  ASSERT_EQ(script.events.size(), 7u);
  const InputTimeline line(script);
  const glm::dvec3 forward = line.pose(Tracker::head, 5.0)->orientation * glm::dvec3(0.0, 0.0, -1.0);
  EXPECT_NEAR(forward.x, 1.0, 1e-12);
  EXPECT_EQ(line.pose(Tracker::left, 5.0)->position_m, glm::dvec3(-0.2, 1.0, -0.3));
  EXPECT_FALSE(line.pose(Tracker::right, 5.0));
  EXPECT_EQ(line.values(2.0)[std::size_t(Action::throttle)], -0.7);
  EXPECT_EQ(line.presses(1.0, 2.0).size(), 2u);
  EXPECT_EQ(line.states(1.0, 2.0)[0].state, HeadsetState::off);
  EXPECT_EQ(std::get<HeadsetState>(script.events[5].what), HeadsetState::off);
  EXPECT_EQ(line.end_s(), 9.0);
}

// Control: a default of 80 Hz.
TEST(InputScriptFile, EverythingButVersionAndEventsHasADefault) {
  expect_same(parse_input_script(R"({"version": 1, "events": []})", "i.json"), InputScript());
}

// Absurd but legal. Control: a bound of 120 Hz.
TEST(InputScriptFile, TakesAbsurdHeadsets) {
  const InputScript script = parse_input_script(R"({"version": 1, "size": "16384x1", "rate_hz": 1000,
    "eye_distance_m": 1, "fov_deg": {"left": [88, 89, -88, -89]}, "events": []})",
                                                "i.json");
  EXPECT_EQ(script.width, 16384);
  EXPECT_EQ(script.eyes[0].left_deg, 88.0);
  EXPECT_EQ(script.eyes[1].left_deg, InputScript().eyes[1].left_deg);
}

InputScript all_kinds() {
  InputScript script = parse_input_script(example, "i.json");
  script.rate_hz = 1000.0 / 11.0;
  script.eyes[1].up_deg = 100.0 / 3.0;
  const Pose odd{{1.0 / 3.0, 1e-7, 123456.789}, glm::normalize(glm::dquat(0.1, 0.7, -0.3, 0.2))};
  for (const InputEvent& event : std::initializer_list<InputEvent>{
           {9.0 + 1.0 / 3.0, HeadsetState::lost},  // at one time in no order of an event's keys
           {9.0 + 1.0 / 3.0, TrackerEvent{Tracker::right, odd}},
           {9.0 + 1.0 / 3.0, TrackerEvent{Tracker::left, odd}},
           {9.0 + 1.0 / 3.0, TrackerEvent{Tracker::left, std::nullopt}},
           {9.0 + 1.0 / 3.0, ActionEvent{Action::helm, -1.0 / 3.0}},
           {9.0 + 1.0 / 3.0, ActionEvent{Action::swim, 2.0 / 3.0}}})
    script.events.push_back(event);
  return script;
}

// Controls: six digits in text_from; all things of one time in one event, where keys are given twice.
TEST(InputScriptFile, AWrittenScriptReadsBackToTheBit) {
  const InputScript script = all_kinds();
  const std::string text = input_script_text(script);
  const InputScript back = parse_input_script(text, "i.json");
  expect_same(back, script);
  EXPECT_EQ(input_script_text(back), text);
  expect_same(parse_input_script(input_script_text(InputScript()), "i.json"), InputScript());
}

// Control: files that are looked for in content/paths.
TEST(InputScriptFile, IsFoundByItsFileOrByItsName) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "walk.json") << example;
  expect_same(load_input_script((folder / "walk.json").string()), parse_input_script(example, "i.json"));
  EXPECT_THAT(test::error_of([] { (void)load_input_script("no_such_walk"); }),
              testing::MatchesRegex("no input script is called 'no_such_walk'; take .*a file input.json; names are "
                                    "looked up in .*/inputs"));
}

// Controls seen: "left" for a value of 0.7 in its example; without the sentence of recentred.
TEST(PathsDoc, ItsExamplesAreReadAndItNamesEveryKey) {
  const std::string text = read_text(std::filesystem::path(SEASCAPE_TEST_DIR) / ".." / "docs" / "paths.md");
  std::vector<std::string> examples;
  for (std::size_t at = text.find("```json\n"); at != std::string::npos; at = text.find("```json\n", at + 1))
    examples.push_back(text.substr(at + 8, text.find("\n```", at + 8) - at - 8));
  ASSERT_EQ(examples.size(), 2u);
  EXPECT_TRUE(parse_camera_path(examples[0], "a path").actions.has_value());
  EXPECT_EQ(parse_input_script(examples[1], "a script").events.size(), 6u);
  for (const std::string_view state : headset_state_names())
    EXPECT_NE(text.find("`" + std::string(state) + "`:"), std::string::npos) << state;
  for (const char* key :
       {"version",   "title",    "keys",        "actions", "time_s",  "scene_time_s",   "position_m", "yaw_deg",
        "pitch_deg", "roll_deg", "orientation", "size",    "rate_hz", "eye_distance_m", "fov_deg",    "events",
        "head",      "left",     "right",       "action",  "value",   "state"})
    EXPECT_NE(text.find("`" + std::string(key) + "`"), std::string::npos) << key;
}

std::vector<std::string> faults_of(const std::string& text) {
  Faults faults(true);
  (void)parse_input_script(text, "i.json", faults);
  std::vector<std::string> told;
  for (const Error& fault : faults.list()) told.emplace_back(fault.what());
  return told;
}

// A script with this event, which stands on line 2.
std::string with_event(const std::string& event) { return "{\"version\": 1, \"events\": [\n" + event + "]}"; }

// Each fault is one, with its place, key, value, range and remedy. Controls: each check of app/input_script_file.cpp
// left out; EventReader without finish(); a fov with one of its two comparisons.
TEST(InputScriptFile, EachFaultIsOneAndNamesPlaceKeyValueRangeAndRemedy) {
  const std::pair<std::string, std::string> cases[] = {
      {R"({"version": 2, "events": []})",
       "i.json:1: version: 2 is not known; give version 1, the one this program reads"},
      {R"({"version": 1})",
       "i.json:1: the key 'events' is missing; add \"events\": [{\"time_s\": 0, \"head\": {\"position_m\": [0, 1.7, "
       "0]}}, ...]"},
      {R"({"version": 1, "events": {}})", "i.json:1: events: an object; give a list of at most 1000000 events"},
      {R"({"version": 1, "events": [], "sizes": 1})",
       "i.json:1: unknown key 'sizes' (did you mean 'size'?); remove it, or take one of: version, size, rate_hz, "
       "eye_distance_m, fov_deg and events"},
      {R"({"version": 1, "events": [], "size": "0x5"})",
       "i.json:1: size: '0x5' is out of range; give two whole numbers from 1 to 16384, as \"1440x1584\""},
      {R"({"version": 1, "events": [], "size": 5})",
       "i.json:1: size: 5 is not text; give two whole numbers from 1 to 16384, as \"1440x1584\""},
      {R"({"version": 1, "events": [], "size": "big"})",
       "i.json:1: size: 'big' is not WIDTHxHEIGHT; give two whole numbers from 1 to 16384, as \"1440x1584\""},
      {R"({"version": 1, "events": [], "rate_hz": 0.5})",
       "i.json:1: rate_hz: 0.5 is out of range; give a number from 1 to 1000 Hz"},
      {R"({"version": 1, "events": [], "eye_distance_m": -1})",
       "i.json:1: eye_distance_m: -1 is out of range; give a number from 0 to 1 m"},
      {R"({"version": 1, "events": [], "fov_deg": {"left": [1, 2]}})",
       "i.json:1: fov_deg.left: a list of 2 is not a list of 4 numbers; write [left, right, up, down] in degrees, as "
       "[-50, 45, 48, -50]"},
      {R"({"version": 1, "events": [], "fov_deg": {"right": [-90, 45, 48, -50]}})",
       "i.json:1: fov_deg.right[0]: -90 is out of range; give a number from -89 to 89 deg"},
      {R"({"version": 1, "events": [], "fov_deg": {"right": [45, 45, 48, -50]}})",
       "i.json:1: fov_deg.right: left is not left of right; write [left, right, up, down] with left < right and down < "
       "up, as [-50, 45, 48, -50]"},
      {R"({"version": 1, "events": [], "fov_deg": {"right": [-45, 45, -50, 48]}})",
       "i.json:1: fov_deg.right: down is not below up; write [left, right, up, down] with left < right and down < up, "
       "as [-50, 45, 48, -50]"},
      {R"({"version": 1, "events": [], "fov_deg": {"centre": [-45, 45, 50, -48]}})",
       "i.json:1: unknown key 'fov_deg.centre'; remove it, or take one of: left and right"},
      {with_event(R"({"head": null})"),
       "i.json:2: the key 'events[0].time_s' is missing; add \"time_s\": a number from 0 to 1000000000 s"},
      {with_event(R"({"time_s": -1, "head": null})"),
       "i.json:2: events[0].time_s: -1 is out of range; give a number from 0 to 1000000000 s"},
      {with_event("{\"time_s\": 2, \"head\": null},\n{\"time_s\": 1.5, \"head\": null}, {\"time_s\": 2, \"head\": "
                  "null}"),
       "i.json:3: events[1].time_s: 1.5 comes before 2 of the event before; order the events by time_s"},
      {with_event(R"({"time_s": 1})"),
       "i.json:2: events[0]: nothing happens in it; give head, left, right, action and value, or state"},
      {with_event("7"), "i.json:2: events[0]: 7 is not an object; write {\"key\": value, ...}"},
      {with_event(R"({"time_s": 1, "head": {"yaw_deg": 1}})"),
       "i.json:2: the key 'events[0].head.position_m' is missing; add \"position_m\": [x, y, z]"},
      {with_event(R"({"time_s": 1, "left": {"position_m": [0, 1, 1e8]}})"),
       "i.json:2: events[0].left.position_m[2]: 100000000 is out of range; give a number from -10000000 to 10000000 m"},
      {with_event(R"({"time_s": 1, "left": {"position_m": [0, 1, 0], "orientation": [0, 0, 0, 1], "roll_deg": 1}})"),
       "i.json:2: events[0].left.roll_deg and events[0].left.orientation are both given; keep one of the two"},
      {with_event(R"({"time_s": 1, "left": {"position_m": [0, 1, 0], "orientation": [0, 0, 0, 0.5]}})"),
       "i.json:2: events[0].left.orientation: its length is 0.5, not 1; give a unit quaternion [x, y, z, w]"},
      {with_event(R"({"time_s": 1, "left": {"position_m": [0, 1, 0], "yaw": 1}})"),
       "i.json:2: unknown key 'events[0].left.yaw' (did you mean 'yaw_deg'?); remove it, or take one of: position_m, "
       "orientation, yaw_deg, pitch_deg and roll_deg"},
      {with_event(R"({"time_s": 1, "left": 3})"),
       "i.json:2: events[0].left: 3 is not an object; write {\"key\": value, ...}"},
      {with_event(R"({"time_s": 1, "action": "throttle"})"),
       "i.json:2: the key 'events[0].value' is missing; add \"value\": a number from -1 to 1"},
      {with_event(R"({"time_s": 1, "action": "swim", "value": -0.1})"),
       "i.json:2: events[0].value: -0.1 is out of range; give a number from 0 to 1"},
      {with_event(R"({"time_s": 1, "action": "helm", "value": 1.1})"),
       "i.json:2: events[0].value: 1.1 is out of range; give a number from -1 to 1"},
      {with_event(R"({"time_s": 1, "value": 1})"),
       "i.json:2: events[0].value: it is no action's; add \"action\": the name of one, as \"throttle\""},
      {with_event(R"({"time_s": 1, "state": "closd"})"),
       "i.json:2: events[0].state: 'closd' is not known (did you mean 'closed'?); take unfocused, focused, off, lost, "
       "recentred or closed"},
      {with_event(R"({"time_s": 1, "state": null})"),
       "i.json:2: events[0].state: null is not known; take unfocused, focused, off, lost, recentred or closed"},
      {with_event(R"({"time_s": 1, "heads": null, "state": "off"})"),
       "i.json:2: unknown key 'events[0].heads' (did you mean 'head'?); remove it, or take one of: time_s, head, left, "
       "right, action, value and state"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_EQ(faults_of(text), std::vector<std::string>{message}) << text;
    EXPECT_EQ(test::error_of([&, text = text] { (void)parse_input_script(text, "i.json"); }), message);
  }
  EXPECT_THAT(faults_of(with_event(R"({"time_s": 1, "action": "throtle", "value": 1})")),
              testing::ElementsAre(testing::StartsWith("i.json:2: events[0].action: 'throtle' is not known (did you "
                                                       "mean 'throttle'?); take move_x, move_z, ")));
}

std::string path_with(const std::string& actions) {
  return "{\"version\": 1, \"keys\": [{\"time_s\": 0, \"position_m\": [0, 2, 0]}],\n\"actions\": " + actions + "}";
}

// Controls: paths that take a head; names without "actions." before them; a written path without its actions.
TEST(CameraPathFile, HasActionsOfItsHands) {
  EXPECT_FALSE(parse_camera_path(R"({"version": 1, "keys": [{"time_s": 0, "position_m": [0, 2, 0]}]})", "p.json")
                   .actions.has_value());
  const std::string object = R"({"version": 1, "rate_hz": 72, "events": [
    {"time_s": 1, "left": {"position_m": [5000, 1, -7000]}}, {"time_s": 2, "action": "board", "value": 1}]})";
  CameraPath path = parse_camera_path(path_with(object), "p.json");
  ASSERT_TRUE(path.actions.has_value());
  EXPECT_EQ(path.actions->rate_hz, 72.0);
  EXPECT_EQ(InputTimeline(*path.actions).pose(Tracker::left, 2.0)->position_m, glm::dvec3(5000, 1, -7000));
  expect_same(*parse_camera_path(camera_path_text(path), "p.json").actions, *path.actions);
  path.actions = all_kinds();
  std::erase_if(path.actions->events, [](const InputEvent& event) {
    const auto* tracker = std::get_if<TrackerEvent>(&event.what);
    return tracker != nullptr && tracker->tracker == Tracker::head;
  });
  expect_same(*parse_camera_path(camera_path_text(path), "p.json").actions, *path.actions);

  const auto fault = [](const std::string& actions) {
    return test::error_of([&] { (void)parse_camera_path(path_with(actions), "p.json"); });
  };
  EXPECT_EQ(fault(R"({"version": 1, "events": [{"time_s": 0, "head": null}]})"),
            "p.json:2: actions.events[0].head: the head of a path is its keys; put its poses among \"keys\" and remove "
            "it here");
  EXPECT_EQ(fault("7"), "p.json:2: actions: 7 is not an object; write {\"key\": value, ...}");
  EXPECT_EQ(fault(R"({"version": 3, "events": []})"),
            "p.json:2: actions.version: 3 is not known; give version 1, the one this program reads");
  EXPECT_EQ(fault(R"({"version": 1, "events": [], "rate_hz": 0})"),
            "p.json:2: actions.rate_hz: 0 is out of range; give a number from 1 to 1000 Hz");
}

}  // namespace
}  // namespace seascape
