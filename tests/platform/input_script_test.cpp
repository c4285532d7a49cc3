// What the simulated headset is told by an input script. Controls are named beside each test; each was seen to fail.
#include "platform/input_script.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

Pose pose_at(double x, double yaw_deg = 0.0) {
  return {{x, 1.5, -2.0}, glm::angleAxis(glm::radians(-yaw_deg), glm::dvec3(0.0, 1.0, 0.0))};
}

InputEvent tracked(double time_s, Tracker tracker, std::optional<Pose> pose) {
  return {time_s, TrackerEvent{tracker, pose}};
}
InputEvent acted(double time_s, Action action, double value) { return {time_s, ActionEvent{action, value}}; }

InputTimeline timeline(std::vector<InputEvent> events) {
  InputScript script;
  script.events = std::move(events);
  return InputTimeline(script);
}

double x_at(const InputTimeline& line, Tracker tracker, double time_s) {
  const auto pose = line.pose(tracker, time_s);
  return pose ? pose->position_m.x : std::nan("");
}

std::string named(std::span<const ActionPress> presses) {
  std::string text;
  for (const ActionPress& press : presses)
    text += (text.empty() ? "" : " ") + std::string(row_of(press.action).name) + (press.value < 0.0 ? "-" : "");
  return text;
}

// Controls: a smooth cubic between events, as camera paths have it, 0.625 m for 1 m here; a mix of quaternions without
// their lengths.
TEST(InputScript, PosesGoStraightAndTurnEvenlyBetweenEvents) {
  const InputTimeline line = timeline(
      {tracked(1.0, Tracker::head, pose_at(0.0)), acted(1.5, Action::swim, 1.0),  // of another track: it parts nothing
       tracked(3.0, Tracker::head, pose_at(4.0, 120.0)), tracked(3.5, Tracker::head, pose_at(4.0, 120.0))});
  EXPECT_DOUBLE_EQ(x_at(line, Tracker::head, 1.5), 1.0);
  EXPECT_DOUBLE_EQ(x_at(line, Tracker::head, 2.5), 3.0);
  const Pose quarter = *line.pose(Tracker::head, 1.5);
  const Pose expected = pose_at(1.0, 30.0);
  EXPECT_NEAR(std::abs(glm::dot(quarter.orientation, expected.orientation)), 1.0, 1e-14);
  EXPECT_NEAR(glm::length(quarter.orientation), 1.0, 1e-15);
}

// A quaternion and its negative are one orientation. Control: glm::mix in the place of glm::slerp turns through 190
// degrees.
TEST(InputScript, OrientationsTurnTheShortWay) {
  Pose there = pose_at(0.0, 170.0);
  there.orientation = -there.orientation;
  const InputTimeline line =
      timeline({tracked(0.0, Tracker::left, pose_at(0.0, 0.0)), tracked(1.0, Tracker::left, there)});
  const glm::dvec3 forward = line.pose(Tracker::left, 0.5)->orientation * glm::dvec3(0.0, 0.0, -1.0);
  EXPECT_NEAR(forward.x, std::sin(glm::radians(85.0)), 1e-12);
}

// Controls: nothing before the first event; extrapolation after the last.
TEST(InputScript, HoldsBeforeTheFirstEventAndAfterTheLast) {
  const InputTimeline line =
      timeline({tracked(1.0, Tracker::right, pose_at(5.0)), tracked(2.0, Tracker::right, pose_at(7.0))});
  for (const auto& [time_s, x] : {std::pair{-1.0, 5.0}, {0.0, 5.0}, {1.0, 5.0}, {2.0, 7.0}, {1e9, 7.0}})
    EXPECT_EQ(x_at(line, Tracker::right, time_s), x) << time_s;
  EXPECT_EQ(line.end_s(), 2.0);
}

// There until the loss, and not back before the next pose. Controls: lost from the pose before the loss on; back
// halfway to the next pose.
TEST(InputScript, ALostTrackerIsLostFromItsLossToItsNextPose) {
  const InputTimeline line =
      timeline({tracked(0.0, Tracker::left, pose_at(0.0)), tracked(1.0, Tracker::left, pose_at(1.0)),
                tracked(2.0, Tracker::left, std::nullopt), tracked(4.0, Tracker::left, pose_at(9.0)),
                tracked(5.0, Tracker::right, std::nullopt)});
  EXPECT_EQ(x_at(line, Tracker::left, 0.5), 0.5);
  EXPECT_EQ(x_at(line, Tracker::left, 1.999), 1.0);
  for (const double time_s : {2.0, 3.0, 3.999}) EXPECT_FALSE(line.pose(Tracker::left, time_s)) << time_s;
  EXPECT_EQ(x_at(line, Tracker::left, 4.0), 9.0);
  EXPECT_FALSE(line.pose(Tracker::right, 0.0)) << "its first event holds before it too";
}

// Control: lost heads without events.
TEST(InputScript, AHeadWithoutEventsStandsAndHandsAreLost) {
  const InputTimeline line = timeline({});
  EXPECT_EQ(line.pose(Tracker::head, 3.0)->position_m, glm::dvec3(0.0, 1.7, 0.0));
  EXPECT_FALSE(line.pose(Tracker::left, 3.0));
  EXPECT_FALSE(line.pose(Tracker::right, 3.0));
  EXPECT_EQ(line.values(3.0), ActionValues{});
  EXPECT_TRUE(line.presses(-1.0, 1e9).empty());
  EXPECT_TRUE(line.states(-1.0, 1e9).empty());
  EXPECT_EQ(line.end_s(), 0.0);
}

// Controls: lower_bound in first_after(), where the first of two events at one time counts; values that interpolate.
TEST(InputScript, AValueHoldsUntilTheNextAndTheLastOfOneTimeCounts) {
  const InputTimeline line = timeline({acted(1.0, Action::throttle, 0.7), acted(2.0, Action::throttle, -0.2),
                                       acted(2.0, Action::throttle, 0.9), tracked(2.0, Tracker::head, pose_at(1.0)),
                                       tracked(2.0, Tracker::head, pose_at(8.0)), acted(2.0, Action::helm, -1.0)});
  const auto throttle = [&](double time_s) { return line.values(time_s)[std::size_t(Action::throttle)]; };
  EXPECT_EQ(throttle(0.999), 0.0);
  EXPECT_EQ(throttle(1.0), 0.7);
  EXPECT_EQ(throttle(1.999), 0.7);
  EXPECT_EQ(throttle(2.0), 0.9);
  EXPECT_EQ(throttle(1e6), 0.9);
  EXPECT_EQ(line.values(2.0)[std::size_t(Action::helm)], -1.0);
  EXPECT_EQ(x_at(line, Tracker::head, 2.0), 8.0);
  EXPECT_EQ(x_at(line, Tracker::head, 1.999), 1.0);
}

// A press that comes and goes between two frames is in the second's span, once. Controls: presses from the values of
// both ends of a span; spans with both of their ends; a turn from one side to the other that is no press.
TEST(InputScript, NoPressIsLostNorTwice) {
  const InputTimeline line =
      timeline({acted(0.0, Action::menu, 1.0), acted(0.0, Action::menu, 0.0), acted(0.101, Action::board, 1.0),
                acted(0.102, Action::board, 0.0), acted(0.103, Action::board, 1.0), acted(0.104, Action::board, 0.0),
                acted(0.1045, Action::teleport, 1.0), acted(0.2, Action::snap_turn, 0.4),
                acted(0.3, Action::snap_turn, 0.5), acted(0.31, Action::snap_turn, 0.9),
                acted(0.32, Action::snap_turn, -0.9), acted(0.33, Action::snap_turn, -0.6)});
  EXPECT_EQ(named(line.presses(-1.0, 0.0)), "menu");
  EXPECT_EQ(named(line.presses(0.0, 0.1)), "");
  EXPECT_EQ(named(line.presses(0.1, 0.2)), "board board teleport");
  EXPECT_EQ(named(line.presses(0.2, 0.3)), "snap_turn");
  EXPECT_EQ(named(line.presses(0.3, 0.4)), "snap_turn-");
  EXPECT_EQ(named(line.presses(0.4, 0.3)), "");
  std::string all;
  for (int frame = 0; frame <= 90; ++frame)
    if (const std::string now = named(line.presses((frame - 1) / 90.0, frame / 90.0)); !now.empty()) all += now + ",";
  EXPECT_EQ(all, "menu,board board teleport,snap_turn,snap_turn-,");
}

// Control: states that are looked for at their exact time.
TEST(InputScript, StatesComeInOrderWithinTheirSpan) {
  const InputTimeline line = timeline({{1.0, HeadsetState::off},
                                       {2.0, HeadsetState::focused},
                                       {2.0, HeadsetState::recentred},
                                       {9.0, HeadsetState::closed}});
  const auto first = line.states(0.5, 1.0);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].state, HeadsetState::off);
  const auto second = line.states(1.0, 8.0);
  ASSERT_EQ(second.size(), 2u);
  EXPECT_EQ(second[0].state, HeadsetState::focused);
  EXPECT_EQ(second[1].state, HeadsetState::recentred);
  EXPECT_EQ(line.states(8.0, 9.0).size(), 1u);
  EXPECT_EQ(line.end_s(), 9.0);
}

// DESIGN's headset. Control: up and down in the other order.
TEST(InputScript, AnglesBecomeTangents) {
  const InputScript script;
  const Fov left = script.eyes[0].tangents(), right = script.eyes[1].tangents();
  EXPECT_NEAR(left.left, -std::tan(glm::radians(50.0)), 1e-15);
  EXPECT_NEAR(left.right, 1.0, 1e-15);
  EXPECT_NEAR(left.up, std::tan(glm::radians(48.0)), 1e-15);
  EXPECT_NEAR(left.down, -std::tan(glm::radians(50.0)), 1e-15);
  EXPECT_EQ(right.left, -left.right);
  EXPECT_EQ(right.right, -left.left);
}

}  // namespace
}  // namespace seascape
