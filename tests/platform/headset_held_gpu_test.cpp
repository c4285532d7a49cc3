// A headset's picture while nobody draws. Controls are named beside each test; each was seen to fail.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

#include "tests/support/gpu/headset_rig.h"
#include "tests/support/gpu/hostile_runtime.h"

namespace seascape {
namespace {

using test::became;
using test::HeadsetRig;
using test::simulated;
using test::tracked;
using Kind = HeadsetCall::Kind;

class HeldPictureTest : public test::GpuTest {};

// A fault of these tests, and no slow machine.
constexpr std::chrono::seconds patience(60);

template <class Condition>
bool comes(const Condition& condition) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// Frames that are ended meanwhile, told by the thread that ends them.
struct Repeated {
  explicit Repeated(Headset& headset) {
    headset.report_to([this](const HeadsetCall& call) {
      if (call.kind == Kind::end && !call.repeated) drawn = call.views;
      if (!call.repeated) return;
      orderly = orderly && call.kind == next && call.time_ns >= last_ns;
      last_ns = call.time_ns;
      next = call.kind == Kind::wait ? Kind::begin : call.kind == Kind::begin ? Kind::end : Kind::wait;
      if (call.kind != Kind::end) return;
      same = same && call.views.size() == drawn.size() &&
             std::memcmp(call.views.data(), drawn.data(), drawn.size() * sizeof(XrView)) == 0;
      ++frames;
    });
  }
  std::atomic<int> frames = 0;
  std::vector<XrView> drawn;
  Kind next = Kind::wait;
  std::int64_t last_ns = 0;
  bool orderly = true, same = true;
};

// Frames end one after the other with the views of the last picture, and it goes on as if nothing had been. Controls:
// submit() without its layers; the views located anew; a second wait before the begin.
TEST_F(HeldPictureTest, IsShownUntilItIsLetGo) {
  HeadsetRig rig(simulated(
      {tracked(0, Tracker::head, Pose{{0.0, 1.7, 0.0}}), tracked(200, Tracker::head, Pose{{3.0, 1.5, 0.0}})}));
  Repeated repeated(rig.headset);
  for (int times = 0; times < 3; ++times) {
    rig.steps(3);
    const int before = repeated.frames;
    {
      const auto held = rig.headset.hold_picture();
      ASSERT_NE(held, nullptr);
      ASSERT_TRUE(comes([&] { return repeated.frames >= before + 5; }));
    }
    EXPECT_TRUE(repeated.orderly);
    EXPECT_TRUE(repeated.same);
    EXPECT_EQ(rig.runtime.frames_ended(), std::size_t(3 * (times + 1) + repeated.frames));
    EXPECT_EQ(rig.runtime.frames_shown(), rig.runtime.frames_ended());
  }
  EXPECT_GT(rig.seen().position_m.x, 0.1);
}

// Work that is soon done has no frame taken from it. Control: a thread without patience.
TEST_F(HeldPictureTest, TakesNoFrameFromWorkThatIsSoonDone) {
  SimulatedOptions options = simulated();
  options.script.rate_hz = 0.01;
  HeadsetRig rig(options);
  rig.steps(2);
  for (int times = 0; times < 5; ++times) {
    const auto held = rig.headset.hold_picture();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(rig.runtime.frames_ended(), 2u);
}

// Nobody sees anything, or time waits: there is nothing to hold. Controls: submitted_ kept when nothing is shown; no
// look at in_real_time.
TEST_F(HeldPictureTest, IsNotThereWhereNothingWasShown) {
  {
    HeadsetRig rig(simulated({became(3, HeadsetState::off)}));
    EXPECT_EQ(rig.headset.hold_picture(), nullptr);
    rig.steps(2);
    EXPECT_NE(rig.headset.hold_picture(), nullptr);
    rig.steps(3);
    EXPECT_EQ(rig.headset.hold_picture(), nullptr);
  }
  HeadsetOptions how;
  how.in_real_time = false;
  HeadsetRig scripted(simulated(), how);
  scripted.steps(2);
  EXPECT_EQ(scripted.headset.hold_picture(), nullptr);
}

// The session is lost, the headset taken off, or the person gone while the picture is held: the thread stops or goes on
// in the dark, and the next frame finds out. Control: repeat_frame() that goes on after a fault.
TEST_F(HeldPictureTest, EndsWithItsSession) {
  for (const HeadsetState state : {HeadsetState::lost, HeadsetState::off, HeadsetState::closed}) {
    SCOPED_TRACE(int(state));
    std::atomic<int> waits = 0;
    HeadsetRig rig(simulated({became(6, state)}), [&](test::HostileRuntime& calls) {
      calls.instead.WaitFrame = [&](XrSession session, const XrFrameWaitInfo* info, XrFrameState* frame) {
        ++waits;
        return calls.real.WaitFrame(session, info, frame);
      };
    });
    Repeated repeated(rig.headset);
    rig.steps(3);
    {
      const auto held = rig.headset.hold_picture();
      ASSERT_TRUE(comes([&] { return waits >= 7; }));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (state == HeadsetState::lost) {
      EXPECT_EQ(waits, 3 + repeated.frames + 1);
    }
    bool closed = false;
    for (int step = 0; step < 20 && !closed; ++step) closed = rig.step().closed;
    EXPECT_EQ(closed, state == HeadsetState::closed);
    if (state == HeadsetState::off) {
      EXPECT_EQ(rig.headset.hold_picture(), nullptr);
    } else if (state == HeadsetState::lost) {
      EXPECT_GT(rig.runtime.frames_shown(), 10u);  // by the next session
    }
  }
}

}  // namespace
}  // namespace seascape
