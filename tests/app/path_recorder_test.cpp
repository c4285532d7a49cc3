// Recorded paths and what is done on them come back in the frames that they were recorded in. Controls are named beside
// each test; each was seen to fail.
#include "app/path_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/located_json.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

constexpr double rate_hz = 90.0;

// One frame of a made-up session.
struct Lived {
  double time_s, scene_time_s;
  Pose head;
  RecordedInput input;
};

Pose pose_of(double t, double phase) {
  return {{2.0 * std::sin(t + phase), 1.5 + 0.3 * std::cos(1.7 * t + phase), -0.5 * t},
          orientation_from_angles({40.0 * std::sin(0.9 * t + phase), 20.0 * std::cos(t), 10.0 * std::sin(3.0 * t)})};
}

// A head and hands that move, rest and are lost; keys that are held, and such as come and go within a frame; at a
// display whose clock is uneven by a tenth of a frame and began long ago.
std::vector<Lived> session(int frames) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> even(-0.1, 0.1);
  std::vector<Lived> lived;
  for (int i = 0; i < frames; ++i) {
    const double t = i / rate_hz;
    Lived now{86400.25 + (i + (i == 0 ? 0.0 : even(random))) / rate_hz, 7.0 + 2.0 * t, pose_of(t, 0.0), {}};
    const bool rests = i % 300 >= 120 && i % 300 < 200;
    const double left_t = rests ? double(i / 300 * 300 + 120) / rate_hz : t;
    if (i % 300 < 260) now.input.hands[0] = pose_of(left_t, 1.0);
    if (i >= 40 && i % 70 != 3) now.input.hands[1] = pose_of(t, 2.0);
    now.input.values[std::size_t(Action::throttle)] = std::sin(0.3 * t);
    now.input.values[std::size_t(Action::swim)] = i % 50 < 20 ? 1.0 : 0.0;
    now.input.values[std::size_t(Action::turn)] = i % 40 < 10 ? -1.0 : i % 40 < 20 ? 1.0 : 0.0;
    if (i % 50 == 0) now.input.presses.push_back({now.time_s, Action::swim, 1.0});   // as its value shows too
    if (i % 50 == 10) now.input.presses.push_back({now.time_s, Action::swim, 1.0});  // let go and pressed again
    if (i % 17 == 4) {
      now.input.presses.push_back({now.time_s, Action::menu, 1.0});
      now.input.presses.push_back({now.time_s, Action::snap_turn, -1.0});
      now.input.presses.push_back({now.time_s, Action::menu, 1.0});
    }
    lived.push_back(now);
  }
  return lived;
}

CameraPath recorded(const std::vector<Lived>& lived, PathRecorder::Every every) {
  PathRecorder recorder;
  recorder.start(lived[0].time_s, lived[0].head, lived[0].scene_time_s, every);
  for (const Lived& now : lived) recorder.sample(now.time_s, now.head, now.scene_time_s, now.input);
  const Lived& last = lived.back();
  return recorder.stop(last.time_s, last.head, last.scene_time_s, "session");
}

CameraPath saved_and_loaded(const CameraPath& path) {
  const test::TemporaryFolder folder;
  save_camera_path(path, folder / "session.json");
  return load_camera_path((folder / "session.json").string());
}

void expect_pose(const std::optional<Pose>& got, const std::optional<Pose>& expected, int frame, const char* what) {
  ASSERT_EQ(got.has_value(), expected.has_value()) << what << " of frame " << frame;
  if (!got) return;
  EXPECT_LE(glm::length(got->position_m - expected->position_m), 1e-6) << what << " of frame " << frame;
  const double sign = glm::dot(got->orientation, expected->orientation) < 0.0 ? -1.0 : 1.0;
  EXPECT_LE(glm::length(got->orientation - sign * expected->orientation), 1e-6) << what << " of frame " << frame;
}

using Presses = std::vector<std::pair<Action, double>>;

// What the values show by themselves, and what is listed beside.
Presses presses_of(const std::vector<Lived>& lived, std::size_t frame) {
  Presses presses;
  for (const ActionPress& press : lived[frame].input.presses) presses.emplace_back(press.action, press.value);
  for (const ActionRow& row : action_rows()) {
    const double value = lived[frame].input.values[std::size_t(row.action)];
    const double before = frame == 0 ? 0.0 : lived[frame - 1].input.values[std::size_t(row.action)];
    const bool told =
        std::any_of(presses.begin(), presses.end(), [&](const auto& one) { return one.first == row.action; });
    if (is_press(before, value) && !told) presses.emplace_back(row.action, value);
  }
  return presses;
}

void expect_session(const CameraPath& path, const std::vector<Lived>& lived) {
  ASSERT_TRUE(path.actions.has_value());
  const InputTimeline line(*path.actions);
  for (std::size_t i = 0; i < lived.size(); ++i) {
    const double time_s = double(i) / rate_hz;
    const int frame = int(i);
    const PathSample sample = path.at(time_s);
    expect_pose(sample.pose, lived[i].head, frame, "the head");
    EXPECT_EQ(sample.scene_time_s, lived[i].scene_time_s) << frame;
    expect_pose(line.pose(Tracker::left, time_s), lived[i].input.hands[0], frame, "the left hand");
    expect_pose(line.pose(Tracker::right, time_s), lived[i].input.hands[1], frame, "the right hand");
    EXPECT_EQ(line.values(time_s), lived[i].input.values) << frame;
    Presses presses;
    for (const ActionPress& press : line.presses((frame - 1) / rate_hz, time_s))
      presses.emplace_back(press.action, press.value);
    EXPECT_EQ(presses, presses_of(lived, i)) << frame;
    if (testing::Test::HasFailure()) return;
  }
}

// A thousand frames at 90 Hz, saved, loaded and asked for at that rate. Controls seen: the display's own times, without
// the beat of path_time(); a resting hand without the event at its end, which drifts from frame 121 on; the right hand
// not lost at the beginning; listed presses left out, or without a release between two; a key each half second; poses
// kept to a hundred-thousandth.
TEST(PathRecorder, ASessionComesBackFrameByFrame) {
  const std::vector<Lived> lived = session(1000);
  const CameraPath path = recorded(lived, {rate_hz});
  ASSERT_EQ(path.keys.size(), lived.size());
  EXPECT_EQ(path.actions->rate_hz, rate_hz);
  expect_session(path, lived);
  const CameraPath back = saved_and_loaded(path);
  expect_session(back, lived);
  EXPECT_EQ(back.actions->events.size(), path.actions->events.size());
}

// Only changes are written. Control: hands written each frame.
TEST(PathRecorder, WritesOnlyWhatHasChanged) {
  std::vector<Lived> lived = session(400);
  for (Lived& now : lived) {
    now.input = {};
    now.input.hands[0] = pose_of(0.0, 1.0);
    now.input.values[std::size_t(Action::helm)] = now.time_s > lived[200].time_s ? 1.0 : 0.0;
  }
  const CameraPath path = recorded(lived, {rate_hz});
  EXPECT_EQ(path.actions->events.size(), 2u);
  for (Lived& now : lived) now.input = {};
  EXPECT_FALSE(recorded(lived, {rate_hz}).actions.has_value()) << "nothing was done";
}

// In a window: keys each half second, what is done in the frame in which it is. Controls: actions at keys alone; times
// from the clock's beginning.
TEST(PathRecorder, TakesActionsBetweenItsKeysToo) {
  const std::vector<Lived> lived = session(400);
  const CameraPath path = saved_and_loaded(recorded(lived, {}));
  EXPECT_EQ(path.keys.size(), 10u);
  ASSERT_TRUE(path.actions.has_value());
  EXPECT_EQ(path.actions->rate_hz, InputScript().rate_hz);
  const InputTimeline line(*path.actions);
  for (std::size_t i = 0; i < lived.size(); ++i) {
    const double time_s = lived[i].time_s - lived[0].time_s;
    EXPECT_EQ(line.values(time_s), lived[i].input.values) << i;
    expect_pose(line.pose(Tracker::right, time_s), lived[i].input.hands[1], int(i), "the right hand");
  }
}

// What a file may not hold is not recorded. Controls: values as they come; poses that are not finite.
TEST(PathRecorder, WhatItRecordsIsReadBack) {
  std::vector<Lived> lived = session(3);
  lived[1].input.hands[0] = Pose{{std::nan(""), 0.0, 0.0}};
  lived[1].input.values[std::size_t(Action::swim)] = 1.0000001;
  lived[1].input.values[std::size_t(Action::helm)] = -3.0;
  lived[1].input.values[std::size_t(Action::sheet)] = std::nan("");
  const CameraPath path = saved_and_loaded(recorded(lived, {rate_hz}));
  const InputTimeline line(*path.actions);
  EXPECT_FALSE(line.pose(Tracker::left, 1.0 / rate_hz));
  const ActionValues values = line.values(1.0 / rate_hz);
  EXPECT_EQ(values[std::size_t(Action::swim)], 1.0);
  EXPECT_EQ(values[std::size_t(Action::helm)], -1.0);
  EXPECT_EQ(values[std::size_t(Action::sheet)], 0.0);
}

// A dropped frame leaves its beat empty; the frames after it keep theirs. Control: beats that are counted by frames.
TEST(PathRecorder, ADroppedFrameShiftsNothing) {
  std::vector<Lived> lived = session(30);
  const Lived last = lived.back();
  lived.erase(lived.begin() + 10, lived.begin() + 13);
  const CameraPath path = recorded(lived, {rate_hz});
  expect_pose(path.at(29 / rate_hz).pose, last.head, 29, "the head");
  EXPECT_EQ(path.duration_s(), 29 / rate_hz);
  EXPECT_EQ(path.keys.size(), 27u);
}

// It stops by itself where a file has all the keys that it may, says so, and what it has is read back. Controls:
// without has_room() it goes on; a key that stop() adds.
TEST(PathRecorder, StopsAtTheMostKeysAndSaysWhy) {
  PathRecorder recorder;
  const Pose pose{{0.0, 2.0, 0.0}};
  recorder.start(0.0, pose, 0.0, {rate_hz});
  int frame = 1;
  for (; frame < 100'100 && recorder.full().empty(); ++frame) recorder.sample(frame / rate_hz, pose, frame / rate_hz);
  EXPECT_EQ(frame, 100'001) << "the frame after the last key";
  EXPECT_EQ(recorder.full(), "the path has 100000 keys, the most that one may have");
  EXPECT_TRUE(recorder.recording()) << "it is still to be stopped";
  recorder.sample(9e3, pose, 9e3);
  const CameraPath path = recorder.stop(9e3, pose, 9e3, "long");
  EXPECT_EQ(path.keys.size(), most_path_keys);
  EXPECT_EQ(path.duration_s(), 99'999 / rate_hz);
  EXPECT_EQ(saved_and_loaded(path).keys.size(), most_path_keys);
  recorder.start(0.0, pose, 0.0);
  EXPECT_TRUE(recorder.full().empty());
}

// With hands the file is full first, after six minutes. Controls seen: no count of bytes, a file that is refused; poses
// with all their digits, four minutes.
TEST(PathRecorder, StopsBeforeItsFileIsTooLargeToRead) {
  if (test::sanitized) GTEST_SKIP() << "counted in the release build";
  PathRecorder recorder;
  std::vector<Lived> lived = session(1000);
  recorder.start(0.0, lived[0].head, 0.0, {rate_hz});
  std::size_t frame = 0;
  for (; frame < 99'000 && recorder.full().empty(); ++frame) {
    Lived now = lived[frame % 1000];
    recorder.sample(double(frame) / rate_hz, now.head, now.scene_time_s, now.input);
  }
  EXPECT_THAT(recorder.full(), testing::HasSubstr("fills a file of 16 MiB"));
  EXPECT_GT(double(frame) / rate_hz, 330.0);
  const CameraPath path = recorder.stop(1e4, lived[0].head, 0.0, "long");
  EXPECT_GT(camera_path_text(path).size(), largest_json_bytes * 4 / 5) << "it stops not much earlier than it has to";
  EXPECT_EQ(saved_and_loaded(path).keys.size(), path.keys.size());
}

}  // namespace
}  // namespace seascape
