// What a person sets for himself while he wears a headset: how high his eyes stand, which hand does what, how large and
// how many pictures are. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include "tests/support/gpu/headset_rig.h"

namespace seascape {
namespace {

using test::became;
using test::HeadsetRig;
using test::simulated;
using test::tracked;

class HeadsetWearerTest : public test::GpuTest {};

Pose at(double x, double y, double z) { return {{x, y, z}}; }

HeadsetOptions sitting(double eye_height_m = 1.7) {
  HeadsetOptions how;
  how.seated = true;
  how.eye_height_m = eye_height_m;
  return how;
}

// From the first picture on, hands with the head; measured as one sits down, changes the height or centres, and no more
// in between. Controls: measured with every frame; the hands' space left where it was; not measured anew by recentre().
TEST_F(HeadsetWearerTest, WhoSitsSeesFromStandingHeight) {
  HeadsetRig rig(
      simulated({tracked(0, Tracker::head, at(0.3, 1.15, -0.2)), tracked(4, Tracker::head, at(0.3, 1.15, -0.2)),
                 tracked(5, Tracker::head, at(0.3, 1.25, -0.2)), tracked(0, Tracker::right, at(0.5, 0.9, -0.6))}),
      sitting());
  const auto steps = [&](int count) {
    int moved = 0;
    for (int i = 0; i < count; ++i) moved += rig.step().moved;
    return moved;
  };
  EXPECT_EQ(steps(1), 1);
  EXPECT_NEAR(rig.seen().position_m.y, 1.7, 1e-6);
  EXPECT_NEAR(rig.seen().position_m.x, 0.3, 1e-6);  // nothing is centred by it
  EXPECT_EQ(steps(3), 0);
  EXPECT_NEAR(rig.headset.input().hands[1]->grip.position_m.y, 0.9 + 0.55, 1e-6);
  steps(2);
  EXPECT_NEAR(rig.seen().position_m.y, 1.8, 1e-6);  // one sits up
  rig.headset.set_stature(true, 1.5);
  EXPECT_EQ(steps(1), 1);
  EXPECT_NEAR(rig.seen().position_m.y, 1.5, 1e-6);
  rig.headset.set_stature(true, 1.5);
  EXPECT_EQ(steps(2), 0);
  rig.headset.set_stature(false, 1.5);
  EXPECT_EQ(steps(1), 1);
  EXPECT_NEAR(rig.seen().position_m.y, 1.25, 1e-6);
  EXPECT_NEAR(rig.headset.input().hands[1]->grip.position_m.y, 0.9, 1e-6);
  rig.headset.set_stature(false, 1.7);  // of no matter to who stands on a floor
  EXPECT_EQ(steps(1), 0);
}

// Controls: as above; the runtime's event without a measure.
TEST_F(HeadsetWearerTest, CentringMeasuresAnew) {
  for (const bool by_runtime : {false, true}) {
    SCOPED_TRACE(by_runtime);
    std::vector<InputEvent> events{tracked(0, Tracker::head, at(0.3, 1.2, -0.2)),
                                   tracked(4, Tracker::head, at(0.3, 1.2, -0.2)),
                                   tracked(4, Tracker::head, at(0.1, 1.0, 0.4))};
    if (by_runtime) events.push_back(became(8, HeadsetState::recentred));
    HeadsetRig rig(simulated(events), sitting());
    rig.steps(7);
    EXPECT_NEAR(rig.seen().position_m.y, 1.5, 1e-6);
    if (!by_runtime) rig.headset.recentre();
    rig.steps(4);
    EXPECT_LT(glm::length(rig.seen().position_m - glm::dvec3(0.0, 1.7, 0.0)), 1e-6);
  }
}

// A head that is not tracked is waited for; another session measures again. Controls: a lost head taken to be on the
// floor; measured once in a life.
TEST_F(HeadsetWearerTest, MeasuresATrackedHeadOfEachSession) {
  HeadsetRig rig(simulated({tracked(0, Tracker::head, std::nullopt), tracked(5, Tracker::head, at(0.0, 1.1, 0.0)),
                            became(9, HeadsetState::lost)}),
                 sitting());
  rig.steps(3);
  EXPECT_LT(rig.seen().position_m.y, 1e-6);
  rig.steps(4);
  EXPECT_NEAR(rig.seen().position_m.y, 1.7, 1e-6);
  rig.steps(8);
  EXPECT_NEAR(rig.seen().position_m.y, 1.7, 1e-6);
}

// LOCAL lies 1.6 m up here, and the floor as far below as it is said, at once. Controls: the height taken as the
// session begins and no more; counted twice for who sits.
TEST_F(HeadsetWearerTest, TheHeightWhereNoFloorIsKnown) {
  HeadsetRig rig(simulated({tracked(0, Tracker::head, at(0.0, 1.4, 0.0))}), [](test::HostileRuntime& calls) {
    calls.instead.EnumerateReferenceSpaces = [](XrSession, std::uint32_t, std::uint32_t* count, XrReferenceSpaceType*) {
      *count = 0;
      return XR_SUCCESS;
    };
  });
  rig.step();
  EXPECT_NEAR(rig.seen().position_m.y, 1.4 - 1.6 + 1.7, 1e-6);
  rig.headset.set_stature(false, 1.5);
  rig.step();
  EXPECT_NEAR(rig.seen().position_m.y, 1.4 - 1.6 + 1.5, 1e-6);
  rig.headset.set_stature(true, 1.6);
  rig.step();
  EXPECT_NEAR(rig.seen().position_m.y, 1.6, 1e-6);
  rig.headset.set_stature(false, 1.6);
  rig.step();
  EXPECT_NEAR(rig.seen().position_m.y, 1.4, 1e-6);
}

// While it runs, without another session; what is held as the hands change does nothing until it is let go. Controls:
// the flag taken as the session begins; the gatherer not reset.
TEST_F(HeadsetWearerTest, HandsChangePlaces) {
  SimulatedOptions options =
      simulated({tracked(0, Tracker::left, at(-0.2, 1.0, -0.4)), tracked(0, Tracker::right, at(0.2, 1.0, -0.4))});
  options.profile = "/interaction_profiles/oculus/touch_controller";
  HeadsetRig rig(options);
  rig.steps(2);
  const auto value = [&](Action action) { return rig.headset.input().value(action); };
  const auto sessions = [&] {
    return std::count(rig.calls.calls().begin(), rig.calls.calls().end(), "xrCreateSession");
  };
  rig.runtime.set_input("left/input/thumbstick/x", 1.0);
  rig.step();
  EXPECT_EQ(value(Action::move_x), 1.0);
  EXPECT_EQ(value(Action::turn), 0.0);
  rig.headset.set_left_handed(true);
  rig.steps(2);
  EXPECT_EQ(value(Action::move_x), 0.0);
  EXPECT_EQ(value(Action::turn), 0.0);  // held over
  rig.runtime.set_input("left/input/thumbstick/x", 0.0);
  rig.step();
  rig.runtime.set_input("left/input/thumbstick/x", 1.0);
  rig.runtime.set_input("right/input/squeeze/value", 1.0);
  rig.step();
  EXPECT_EQ(value(Action::turn), 1.0);
  EXPECT_EQ(value(Action::move_x), 0.0);
  EXPECT_EQ(value(Action::grab_right), 1.0);
  EXPECT_EQ(value(Action::grab_left), 0.0);
  rig.headset.set_left_handed(false);
  rig.runtime.set_input("left/input/thumbstick/x", 0.0);
  rig.step();
  rig.runtime.set_input("left/input/thumbstick/x", -1.0);
  rig.step();
  EXPECT_EQ(value(Action::move_x), -1.0);
  EXPECT_EQ(sessions(), 1);
}

// Asked for once a change, 0 gives the choice back, and a new session is asked again. Controls: asked with each frame;
// 0 not told; the options not kept.
TEST_F(HeadsetWearerTest, ARateIsAskedForWhenItChanges) {
  HeadsetRig rig(simulated({became(8, HeadsetState::lost)}));
  std::vector<float> asked;
  rig.calls.instead.RequestDisplayRefreshRateFB = [&](XrSession session, float rate) {
    asked.push_back(rate);
    return rig.calls.real.RequestDisplayRefreshRateFB(session, rate);
  };
  const auto run = [&](double rate_hz, int frames) {
    for (int i = 0; i < frames; ++i) {
      rig.headset.set_rate(rate_hz);
      rig.step();
    }
  };
  run(0.0, 2);
  EXPECT_TRUE(asked.empty());
  run(72.0, 2);
  run(64.0, 2);
  run(0.0, 1);
  EXPECT_EQ(asked, (std::vector<float>{72.0f, 64.0f, 0.0f}));
  run(64.0, 6);
  EXPECT_EQ(asked, (std::vector<float>{72.0f, 64.0f, 0.0f, 64.0f, 64.0f}));
}

// A scale that changes while a picture is drawn counts for the next, and is told as it came to be. Controls: the size
// changed at once, so that of a picture another part was shown than was drawn; the wish told.
TEST_F(HeadsetWearerTest, AScaleCountsFromTheNextPicture) {
  HeadsetRig rig(simulated());
  std::vector<std::int32_t> shown;
  bool meanwhile = false;
  rig.calls.instead.EndFrame = [&](XrSession session, const XrFrameEndInfo* info) {
    const auto& layer = *reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[0]);
    shown.push_back(layer.views[0].subImage.imageRect.extent.width);
    return rig.calls.real.EndFrame(session, info);
  };
  rig.calls.instead.LocateViews = [&](XrSession session, const XrViewLocateInfo* info, XrViewState* state,
                                      std::uint32_t room, std::uint32_t* count, XrView* views) {
    if (meanwhile) rig.headset.set_scale(9.0);
    return rig.calls.real.LocateViews(session, info, state, room, count, views);
  };
  rig.headset.set_scale(0.5);
  EXPECT_EQ(rig.step().width, 8u);
  EXPECT_EQ(rig.headset.scale(), 0.5);
  meanwhile = true;
  EXPECT_EQ(rig.step().width, 8u);
  EXPECT_EQ(rig.step().width, 24u);
  EXPECT_EQ(rig.headset.scale(), 1.5);
  EXPECT_EQ(shown, (std::vector<std::int32_t>{8, 8, 24}));
}

}  // namespace
}  // namespace seascape
