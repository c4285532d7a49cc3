// What a person does in the simulated headset is recorded by explore and played again by replay: the same poses, hands
// and actions in the same frames. Controls are named beside the test; each was seen to fail.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "app/camera_path.h"
#include "app/explore_camera.h"
#include "app/input_script_file.h"
#include "app/scene.h"
#include "app/sea_spec.h"
#include "app/sea_time.h"
#include "ocean/sea/sea.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

constexpr double rate_hz = 32.0;  // times of frames are exact
constexpr int record_begins = 5, record_ends = 66, script_ends = 72;
constexpr int turns_at = 26, aims_at = 32, goes_at = 38;  // the frame in which what was aimed at is let go

Pose pose(glm::dvec3 position_m, const ViewAngles& looks = {}) { return {position_m, orientation_from_angles(looks)}; }

InputScript everything_at_once() {
  InputScript script;
  script.width = 48;
  script.height = 40;
  script.rate_hz = rate_hz;
  const auto at = [&](int frame, decltype(InputEvent::what) what) { script.events.push_back({frame / rate_hz, what}); };
  const auto hold = [&](int frame, int until, Action action, double value = 1.0) {
    at(frame, ActionEvent{action, value});
    at(until, ActionEvent{action, 0.0});
  };
  at(0, TrackerEvent{Tracker::head, pose({0.3, 1.7, -0.2})});
  at(24, TrackerEvent{Tracker::head, pose({0.4, 1.6, -0.3}, {25.0, -5.0, 3.0})});
  at(72, TrackerEvent{Tracker::head, pose({0.0, 1.75, 0.1}, {-15.0, 10.0, -2.0})});
  at(0, TrackerEvent{Tracker::left, pose({-0.2, 1.1, -0.4})});
  at(48, TrackerEvent{Tracker::left, pose({-0.5, 1.3, -0.1}, {40.0, 20.0, 70.0})});
  at(48, TrackerEvent{Tracker::left, std::nullopt});
  at(52, TrackerEvent{Tracker::left, pose({-0.1, 0.9, -0.3})});
  at(0, TrackerEvent{Tracker::right, pose({0.2, 1.2, -0.4}, {0.0, -20.0, 0.0})});
  at(36, TrackerEvent{Tracker::right, pose({0.25, 1.25, -0.5}, {15.0, -7.0, 0.0})});
  at(72, TrackerEvent{Tracker::right, pose({0.2, 1.0, -0.3})});
  hold(record_begins, record_begins + 2, Action::record);
  hold(8, 22, Action::move_z, -1.0);
  hold(10, 16, Action::move_x, 0.5);
  hold(turns_at, turns_at + 2, Action::snap_turn);
  hold(aims_at, goes_at, Action::teleport);
  hold(41, 46, Action::grab_right, 0.75);
  hold(42, 44, Action::grab_left);
  hold(54, 60, Action::move_z, 1.0);
  script.events.push_back({57.25 / rate_hz, ActionEvent{Action::select_right, 1.0}});  // over before the next frame
  script.events.push_back({57.75 / rate_hz, ActionEvent{Action::select_right, 0.0}});
  hold(record_ends, record_ends + 2, Action::record);
  std::stable_sort(script.events.begin(), script.events.end(),
                   [](const InputEvent& a, const InputEvent& b) { return a.time_s < b.time_s; });
  return script;
}

// What the program is to have shown in a frame, from the script and the laws of its rig.
struct Shown {
  Pose head;
  std::array<std::optional<Pose>, 2> hands;
};

std::vector<Shown> shown_by(const InputScript& script, const Scene& scene) {
  const InputTimeline timeline(script);
  Sea sea(sea_spec(scene));
  ExploreCamera camera(scene.start);
  std::vector<Shown> all;
  std::optional<Pose> head;  // of the frame before
  bool aims = false;
  glm::dvec3 aimed_m(0.0);
  for (int frame = 0; frame <= script_ends; ++frame) {
    const double time_s = frame / rate_hz;
    const ActionValues values = frame > 0 ? timeline.values(time_s) : ActionValues{};  // the focus comes with frame 1
    const auto value = [&](Action action) { return values[std::size_t(action)]; };
    CameraWish wish;
    wish.move = {value(Action::move_x), 0.0, -value(Action::move_z)};
    wish.head = head.value_or(pose({0.0, ExploreCamera::deck_height_m, 0.0}));
    if (frame == turns_at) wish.turn_deg.x = 30.0;
    camera.step(wish, frame > 0 ? 1.0 / rate_hz : 0.0, 0.0);
    if (value(Action::teleport) != 0.0) {
      const Pose from = composed(camera.carrier(), *timeline.pose(Tracker::right, time_s));
      const glm::dvec3 ahead = from.orientation * glm::dvec3(0.0, 0.0, -1.0);
      const RayAnswer met =
          sea.view_at(sea_time_s(scene.settings, time_s), SeaDetail::felt).ray(from.position_m, ahead);
      EXPECT_TRUE(met.hit);
      aims = true;
      aimed_m = from.position_m + met.distance_m * ahead;
    } else if (std::exchange(aims, false)) {
      EXPECT_EQ(frame, goes_at);
      const glm::dvec3 off = composed(camera.carrier(), *head).position_m - camera.pose().position_m;
      camera.jump({aimed_m.x - off.x, aimed_m.z - off.z}, aimed_m.y);
    }
    head = *timeline.pose(Tracker::head, time_s);
    Shown shown{composed(camera.carrier(), *head), {}};
    for (std::size_t hand = 0; hand < 2; ++hand)
      if (const auto at = timeline.pose(hand == 0 ? Tracker::left : Tracker::right, time_s))
        shown.hands[hand] = composed(camera.carrier(), *at);
    all.push_back(shown);
  }
  return all;
}

void expect_pose(const nlohmann::json& json, const Pose& expected) {
  const auto &p = json.at("position_m"), &q = json.at("orientation_xyzw");
  const glm::dvec3 at(p[0], p[1], p[2]);
  EXPECT_LT(glm::distance(at, expected.position_m), 1e-6);
  const glm::dvec4 turned(q[0], q[1], q[2], q[3]),
      wanted(expected.orientation.x, expected.orientation.y, expected.orientation.z, expected.orientation.w);
  EXPECT_LT(std::min(glm::distance(turned, wanted), glm::distance(turned, -wanted)), 1e-6);
}

// Controls: poses kept to 1e-5; hands kept as they are over the floor; a frame's presses kept with the next; the path
// begun with the frame after; a turn about the floor's middle.
TEST(HeadsetReplay, WhatIsRecordedInTheHeadsetIsReplayed) {
  const test::TemporaryFolder folder;
  const InputScript script = everything_at_once();
  std::ofstream(folder / "input.json") << input_script_text(script);
  const auto run = [&](std::vector<std::string> words) {
    for (const char* word : {"--scene", "calm", "--preset", "low", "--set", "msaa=1", "--set", "waves.cascades=3"})
      words.emplace_back(word);
    const test::ProgramResult result = test::run_program(words, {"SEASCAPE_VALIDATION=1"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  };
  run({"explore", "--display", "simulated", "--input", (folder / "input.json").string(), "--out",
       (folder / "out").string()});
  run({"replay", "--path", (folder / "out/recorded_001.json").string(), "--fps", fmt::format("{}", rate_hz), "--size",
       "32x32", "--out", (folder / "replayed").string()});
  const auto record = nlohmann::json::parse(std::ifstream(folder / "replayed/replay.json"));
  const auto& frames = record.at("frames");
  ASSERT_EQ(frames.size(), std::size_t(record_ends - record_begins));

  Scene scene = load_scene("calm", "low");
  set_from_text(scene.settings, "waves.cascades", "3", "test");
  const std::vector<Shown> expected = shown_by(script, scene);
  const InputTimeline timeline(script);
  int presses = 0, with_hands = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    SCOPED_TRACE(i);
    const auto& replayed = frames[i];
    const std::size_t frame = record_begins + i;
    const double time_s = double(frame) / rate_hz;
    expect_pose(replayed.at("viewer"), expected[frame].head);
    for (std::size_t hand = 0; hand < 2; ++hand) {
      const auto& at = replayed.at("actions").at(hand == 0 ? "left" : "right");
      ASSERT_EQ(at.is_null(), !expected[frame].hands[hand].has_value());
      if (at.is_null()) continue;
      expect_pose(at, *expected[frame].hands[hand]);
      ++with_hands;
    }
    // A quick press counts as held in its frame.
    ActionValues values = timeline.values(time_s);
    std::vector<std::pair<std::string, double>> pressed, told;
    for (const ActionPress& press : timeline.presses(time_s - 1.0 / rate_hz, time_s)) {
      pressed.emplace_back(row_of(press.action).name, press.value < 0.0 ? -1.0 : 1.0);
      if (values[std::size_t(press.action)] == 0.0) values[std::size_t(press.action)] = press.value;
    }
    for (const auto& press : replayed.at("actions").at("pressed"))
      told.emplace_back(press.at("action"), double(press.at("value")) < 0.0 ? -1.0 : 1.0);
    std::sort(pressed.begin(), pressed.end());
    std::sort(told.begin(), told.end());
    EXPECT_EQ(told, pressed);
    presses += int(told.size());
    std::map<std::string, double> wanted;
    for (const ActionRow& row : action_rows())
      if (values[std::size_t(row.action)] != 0.0) wanted[std::string(row.name)] = values[std::size_t(row.action)];
    EXPECT_EQ((replayed.at("actions").at("values").get<std::map<std::string, double>>()), wanted);
  }
  EXPECT_EQ(presses, 9);
  EXPECT_GT(with_hands, 100);
  // Something happened: stick, turn and teleport moved the rig.
  const auto moved = [&](int from, int to) {
    return glm::distance(expected[std::size_t(from)].head.position_m, expected[std::size_t(to)].head.position_m);
  };
  EXPECT_GT(moved(8, 22), 1.0);
  EXPECT_GT(moved(goes_at - 1, goes_at), 3.0);
}

}  // namespace
}  // namespace seascape
