// A headset on the simulated runtime: its calls in their order, and what comes of the states that a person and a
// runtime bring it into. Controls are named beside each test; each was seen to fail.
#include "platform/headset.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/gpu/headset_record.h"
#include "tests/support/gpu/headset_rig.h"

namespace seascape {
namespace {

using test::became;
using test::HeadsetRig;
using test::rig_hz;
using test::simulated;
using test::time_of;
using test::tracked;
using Kind = HeadsetCall::Kind;

class HeadsetTest : public test::GpuTest {};

Pose standing(glm::dvec3 position_m, double yaw_rad = 0.0, double roll_rad = 0.0) {
  return {position_m,
          glm::angleAxis(yaw_rad, glm::dvec3(0.0, 1.0, 0.0)) * glm::angleAxis(roll_rad, glm::dvec3(0.0, 0.0, 1.0))};
}

double distance(const Pose& a, const Pose& b) { return glm::length(a.position_m - b.position_m); }
double angle(const Pose& a, const Pose& b) {
  const glm::dquat turned = glm::conjugate(a.orientation) * b.orientation;
  return 2.0 * std::asin(std::min(1.0, glm::length(glm::dvec3(turned.x, turned.y, turned.z))));
}

// A head that moves, an hour of states, and frames that show nothing although they should.
SimulatedOptions eventful() {
  SimulatedOptions options = simulated(
      {tracked(0, Tracker::head, standing({0.0, 1.7, 0.0})), became(150, HeadsetState::off),
       became(190, HeadsetState::focused), became(250, HeadsetState::unfocused), became(300, HeadsetState::focused),
       became(320, HeadsetState::recentred), became(400, HeadsetState::off), became(410, HeadsetState::focused)});
  options.script.events.push_back(tracked(500, Tracker::head, standing({2.0, 1.2, -1.0}, 1.5, 0.4)));
  return options;
}

// What the headset tells of its calls. Controls: views located before xrBeginFrame too; a frame without a picture not
// ended.
TEST_F(HeadsetTest, CallsInOrder) {
  HeadsetRig rig(eventful());
  std::vector<HeadsetCall> calls;
  rig.headset.report_to([&](const HeadsetCall& call) { calls.push_back(call); });
  constexpr int frames = 500;
  int pictures = 0, dark = 0;
  std::int64_t last_ns = 0;
  for (int frame = 0; frame < frames; ++frame) {
    calls.clear();
    const bool draws = frame % 7 != 3;
    const DisplayFrame shown = rig.step(draws);
    const bool picture = draws && shown.should_render;
    pictures += picture;
    dark += !shown.should_render;
    std::vector<Kind> kinds{Kind::wait, Kind::begin, Kind::locate, Kind::end};
    if (!picture) kinds.erase(kinds.begin() + 2);
    ASSERT_EQ(calls.size(), kinds.size()) << frame;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      ASSERT_EQ(calls[i].kind, kinds[i]) << frame << " " << i;
      ASSERT_EQ(calls[i].time_ns, calls[0].time_ns) << frame << " " << i;
    }
    ASSERT_GT(calls[0].time_ns, last_ns);
    last_ns = calls[0].time_ns;
    ASSERT_NEAR(shown.time_s, time_of(frame), 1e-9);
    ASSERT_EQ(calls.back().views.size(), picture ? 2u : 0u) << frame;
    for (std::size_t eye = 0; picture && eye < 2; ++eye)
      ASSERT_TRUE(test::same_view(calls[2].views[eye], calls[3].views[eye])) << frame;
  }
  EXPECT_EQ(dark, 50);
  EXPECT_EQ(rig.runtime.frames_ended(), std::size_t(frames));
  EXPECT_EQ(rig.runtime.frames_shown(), std::size_t(pictures));
}

// The same as the runtime sees it. Controls as above, and: xrEndFrame at the time plus 1; the left eye's view submitted
// for both; images released after xrEndFrame; actions synced after xrBeginFrame.
TEST_F(HeadsetTest, TheRuntimeIsCalledInOrder) {
  HeadsetRig rig(eventful());
  test::HeadsetRecord record(rig.calls);
  for (int frame = 0; frame < 500; ++frame) {
    const std::size_t from = rig.calls.calls().size();
    record.next_frame();
    const bool draws = frame % 7 != 3;
    const DisplayFrame shown = rig.step(draws);
    ASSERT_EQ(record.fault(draws && shown.should_render), "") << frame;
    ASSERT_EQ(record.taken().should_render, shown.should_render) << frame;
    // A colour and a depth.
    const auto& calls = rig.calls.calls();
    ASSERT_EQ(std::count(calls.begin() + std::ptrdiff_t(from), calls.end(), "xrReleaseSwapchainImage"),
              shown.should_render ? 2 : 0)
        << frame;
  }
  EXPECT_GT(record.pictures(), 350u);
}

// Eyes are where the script has them, with the script's fields of view. Control: the eyes exchanged.
TEST_F(HeadsetTest, EyesAreWhereTheHeadIs) {
  SimulatedOptions options = simulated({tracked(0, Tracker::head, standing({0.3, 1.6, -0.2}, 0.7, 0.5))});
  options.script.eye_distance_m = 0.2;
  options.script.eyes = {{{-50, 40, 30, -45}, {-35, 55, 25, -40}}};
  HeadsetRig rig(options);
  rig.step();
  ASSERT_EQ(rig.viewpoint.eyes.size(), 2u);
  const Pose head = standing({0.3, 1.6, -0.2}, 0.7, 0.5);
  EXPECT_LT(distance(rig.seen(), head), 1e-6);
  EXPECT_LT(angle(rig.seen(), head), 1e-6);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const View& view = rig.viewpoint.eyes[eye];
    EXPECT_LT(distance(view.pose, composed(head, Pose{{eye == 0 ? -0.1 : 0.1, 0.0, 0.0}})), 1e-6);
    EXPECT_LT(angle(view.pose, head), 1e-6);
    const Fov fov = options.script.eyes[eye].tangents();
    EXPECT_NEAR(view.fov.left, fov.left, 1e-6);
    EXPECT_NEAR(view.fov.right, fov.right, 1e-6);
    EXPECT_NEAR(view.fov.up, fov.up, 1e-6);
    EXPECT_NEAR(view.fov.down, fov.down, 1e-6);
  }
}

// Taken off, it shows nothing, and its clock goes on. Control: should_render kept true.
TEST_F(HeadsetTest, hard_42_off_it_shows_nothing_and_time_goes_on) {
  HeadsetRig rig(simulated({became(3, HeadsetState::off), became(8, HeadsetState::focused)}));
  for (int frame = 0; frame < 12; ++frame) {
    const DisplayFrame shown = rig.step();
    EXPECT_EQ(shown.should_render, frame < 3 || frame >= 8) << frame;
    EXPECT_EQ(shown.time_s, time_of(frame));
    EXPECT_FALSE(shown.away) << frame;
    EXPECT_FALSE(shown.closed);
  }
  EXPECT_EQ(rig.runtime.frames_ended(), 12u);
  EXPECT_EQ(rig.runtime.frames_shown(), 7u);
}

// While the runtime's menu has the input, the picture goes on and nothing is done; what was held then does not count
// when the focus comes back. Controls: what is held not forgotten as the focus comes; a simulated runtime
// that gives input without the focus.
TEST_F(HeadsetTest, WithoutTheFocusNothingIsDone) {
  HeadsetRig rig(simulated({tracked(0, Tracker::left, standing({-0.2, 1.0, -0.4})), test::acted(2, Action::move_x, 1.0),
                            became(4, HeadsetState::unfocused), test::acted(5, Action::board, 1.0),
                            test::acted(6, Action::board, 0.0), became(9, HeadsetState::focused),
                            test::acted(14, Action::move_x, 0.0), test::acted(16, Action::move_x, 1.0)}));
  for (int frame = 0; frame < 20; ++frame) {
    const DisplayFrame shown = rig.step();
    EXPECT_TRUE(shown.should_render) << frame;
    const Input& input = rig.headset.input();
    const bool focused = (frame >= 1 && frame < 4) || frame >= 10;  // events come a frame later
    EXPECT_EQ(input.hands[0].has_value(), focused) << frame;
    EXPECT_EQ(input.value(Action::move_x), frame == 2 || frame == 3 || frame >= 16 ? 1.0 : 0.0) << frame;
    EXPECT_EQ(input.pressed.size(), frame == 2 || frame == 16 ? 1u : 0u) << frame;
  }
}

// The session goes: another begins, with images of its own, and its clock goes on from where it was. Controls: the
// elapsed time cleared with the session; lent_ of the old session kept.
TEST_F(HeadsetTest, ALostSessionIsBegunAnew) {
  HeadsetRig rig(simulated({became(4, HeadsetState::lost)}));
  std::shared_ptr<const LentImages> before;
  double last_s = 0.0;
  int shown_after = 0;
  for (int frame = 0; frame < 12; ++frame) {
    const DisplayFrame shown = rig.step();
    EXPECT_GE(shown.time_s, last_s) << frame;
    EXPECT_LE(shown.time_s, last_s + 1.0 / rig_hz + 1e-9) << frame;
    EXPECT_EQ(shown.away, frame == 4 || frame == 5) << frame;
    if (frame == 3) before = shown.lent;
    if (frame > 4) {
      EXPECT_TRUE(shown.lent != before) << frame;
      shown_after += shown.should_render;
    }
    last_s = shown.time_s;
  }
  EXPECT_EQ(shown_after, 6);
  EXPECT_NEAR(last_s, time_of(8), 1e-9);  // frames 0 to 3, and 5 to 10 of another clock
  EXPECT_EQ(std::count(rig.calls.calls().begin(), rig.calls.calls().end(), "xrCreateSession"), 2);
}

// It ends by itself where the runtime says so, at the script's end, and where it is asked to leave. Controls: EXITING
// ignored; leave() empty.
TEST_F(HeadsetTest, ItEnds) {
  const auto frames_until_closed = [](HeadsetRig& rig) {
    int frame = 0;
    while (frame < 30 && !rig.step().closed) ++frame;
    return frame;
  };
  {
    HeadsetRig rig(simulated({became(5, HeadsetState::closed)}));
    EXPECT_EQ(frames_until_closed(rig), 6);
  }
  {
    SimulatedOptions ending = simulated({test::acted(7, Action::board, 1.0)});
    ending.ends = true;
    HeadsetRig rig(ending);
    EXPECT_EQ(frames_until_closed(rig), 9);
  }
  HeadsetRig rig(simulated());
  rig.steps(3);
  rig.headset.leave();
  EXPECT_LE(frames_until_closed(rig), 3);
  EXPECT_TRUE(rig.step().closed);  // and stays so
}

// The head's floor becomes the middle, what lies ahead forward: as the runtime centres it, and as we do. Controls: the
// yaw left out; with its sign turned; the old offset forgotten, which the second time shows.
TEST_F(HeadsetTest, RecentresUnderTheHead) {
  const Pose head = standing({1.3, 1.6, -0.8}, 0.9, 0.0), other = standing({-0.4, 1.2, 0.5}, -2.0, 0.0);
  const auto expect_middle = [](const Pose& seen, double height_m, const char* what) {
    EXPECT_LT(distance(seen, standing({0.0, height_m, 0.0})), 1e-6) << what;
    EXPECT_LT(angle(seen, Pose{}), 1e-6) << what;
  };
  {
    HeadsetRig rig(simulated({tracked(0, Tracker::head, head), became(3, HeadsetState::recentred)}));
    int moved = 0;
    for (int frame = 0; frame < 8; ++frame) {
      moved += rig.step().moved;
      if (frame == 2) {
        EXPECT_LT(distance(rig.seen(), head), 1e-6);
      }
    }
    expect_middle(rig.seen(), 1.6, "by the runtime");
    EXPECT_EQ(moved, 1);
  }
  {
    HeadsetRig rig(simulated(
        {tracked(0, Tracker::head, head), tracked(9, Tracker::head, head), tracked(9, Tracker::head, other)}));
    rig.steps(2);
    rig.headset.recentre();
    EXPECT_TRUE(rig.step().moved);
    expect_middle(rig.seen(), 1.6, "by us");
    EXPECT_FALSE(rig.step().moved);
    rig.steps(8);
    EXPECT_GT(distance(rig.seen(), standing({0.0, 1.2, 0.0})), 0.5);
    rig.headset.recentre();
    rig.step();
    expect_middle(rig.seen(), 1.2, "by us again");
  }
  // What was centred here counts no more once the runtime centres.
  HeadsetRig rig(simulated({tracked(0, Tracker::head, head), became(6, HeadsetState::recentred)}));
  rig.steps(2);
  rig.headset.recentre();
  rig.steps(8);
  expect_middle(rig.seen(), 1.6, "by both");
}

// What the runtime leaves in the poses of a head that it does not know counts for nothing. Control: located_ filled
// whatever the flags say.
TEST_F(HeadsetTest, ALostHeadStaysWhereItWas) {
  HeadsetRig rig(
      simulated({tracked(0, Tracker::head, standing({0.5, 1.5, 0.25})), tracked(3, Tracker::head, std::nullopt),
                 tracked(6, Tracker::head, standing({0.0, 2.0, 0.0}))}));
  rig.calls.instead.LocateViews = [&](XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                                      std::uint32_t room, std::uint32_t* count, XrView* views) {
    const XrResult result = rig.calls.real.LocateViews(session, info, state, room, count, views);
    if (state->viewStateFlags == 0) views[0].pose = views[1].pose = {{0, 0, 0, 1}, {9, 9, 9}};
    return result;
  };
  for (int frame = 0; frame < 9; ++frame) {
    EXPECT_TRUE(rig.step().should_render) << frame;
    const Pose expected = frame < 6 ? standing({0.5, 1.5, 0.25}) : standing({0.0, 2.0, 0.0});
    EXPECT_LT(distance(rig.seen(), expected), 1e-6) << frame;
  }
  EXPECT_EQ(rig.runtime.frames_shown(), 9u);
}

// Smaller and larger pictures within the room that there is: no image is made. Control: set_scale() beyond the room.
TEST_F(HeadsetTest, AnotherScaleMakesNothing) {
  HeadsetRig rig(simulated());
  rig.step();
  const std::uint64_t made = test::device().objects_made();
  for (const double scale : {0.7, 1.5, 9.0, 0.01, 1.0}) {
    rig.headset.set_scale(scale);
    const DisplayFrame shown = rig.step();
    const auto of = [&](double side) { return std::uint32_t(std::clamp(std::round(side * scale), 1.0, 1.5 * side)); };
    EXPECT_EQ(shown.width, of(16)) << scale;
    EXPECT_EQ(shown.height, of(12)) << scale;
    EXPECT_LE(shown.width, shown.lent->width);
  }
  EXPECT_EQ(test::device().objects_made(), made);
  EXPECT_EQ(rig.runtime.frames_shown(), 6u);
}

// A hand feels what it is given while one plays. Control: the hands exchanged.
TEST_F(HeadsetTest, HandsFeelBuzzes) {
  HeadsetRig rig(simulated({became(4, HeadsetState::unfocused)}));
  rig.headset.buzz(0, 1.0, 0.1);  // nobody has the focus yet
  rig.steps(3);
  rig.headset.buzz(1, 0.5, 0.25);
  rig.headset.buzz(0, 7.0, 0.5);
  rig.steps(3);
  rig.headset.buzz(0, 1.0, 0.1);
  const auto& felt = rig.runtime.buzzes();
  ASSERT_EQ(felt.size(), 2u);
  EXPECT_EQ(felt[0].hand, 1);
  EXPECT_NEAR(felt[0].strength, 0.5, 1e-6);
  EXPECT_NEAR(felt[0].seconds, 0.25, 1e-6);
  EXPECT_EQ(felt[1].hand, 0);
  EXPECT_EQ(felt[1].strength, 1.0);
}

}  // namespace
}  // namespace seascape
