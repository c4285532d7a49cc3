// A headset on the simulated runtime, and frames for it that show nothing but a colour.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/headset.h"
#include "platform/simulated_runtime.h"
#include "tests/support/gpu/gpu_test.h"
#include "tests/support/gpu/hostile_runtime.h"

namespace seascape::test {

// The runtime shows this many frames a second: times of frames are exact.
inline constexpr double rig_hz = 64.0;
constexpr double time_of(double frame) { return frame / rig_hz; }

// A small headset that does not end by itself, and what happens to it.
SimulatedOptions simulated(std::vector<InputEvent> events = {});
InputEvent tracked(double frame, Tracker tracker, std::optional<Pose> pose);
InputEvent acted(double frame, Action action, double value);
InputEvent became(double frame, HeadsetState state);

// Made in this order and given up in the other. The first frame that is begun is the script's first.
struct HeadsetRig {
  explicit HeadsetRig(const SimulatedOptions& options, const HeadsetOptions& how = {}, Device& on = device());
  // Harm is done before the headset is made; `has_failed` (may be null) is told at the end, however it comes.
  using Harm = std::function<void(HostileRuntime&)>;
  HeadsetRig(const SimulatedOptions& options, const Harm& harm) : HeadsetRig(options, {}, harm) {}
  HeadsetRig(const SimulatedOptions& options, const HeadsetOptions& how, const Harm& harm, bool* has_failed = nullptr,
             Device& on = device());

  DisplayFrame step(bool picture = true);  // begins and ends a frame
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  // Where the head was drawn last, from a carrier at the world's middle.
  Pose seen() const { return viewpoint.viewer; }

  SimulatedRuntime runtime;
  struct Harmed : HostileRuntime {
    Harmed(SimulatedRuntime& behind, const Harm& harm, bool* told) : HostileRuntime(behind), has_failed_too(told) {
      if (harm) harm(*this);
    }
    ~Harmed() {
      if (has_failed_too) *has_failed_too = has_failed();
    }
    bool* has_failed_too;
  } calls;
  HeadsetSystem system;
  Headset headset;
  Viewpoint viewpoint;  // of the last picture

 private:
  Device& device_;
  Frame frame_;
  std::shared_ptr<const LentImages> lent_;
  RenderTarget target_;
};

// What is thrown where harm is done to a headset before so many frames are drawn; it has to be an Error.
std::string error_under(const HeadsetRig::Harm& harm, int frames = 8);

// Of tests that do a headset harm: nothing is left of what was made. The terminal is quiet meanwhile, for each harm is
// told.
class HarmTest : public GpuTest {
 protected:
  void SetUp() override;
  void TearDown() override;
  void expect_nothing_left(const std::string& after);

 private:
  std::size_t objects_ = 0;
};

}  // namespace seascape::test
