#include "tests/support/gpu/headset_rig.h"

#include <spdlog/sinks/sink.h>
#include <spdlog/spdlog.h>

#include "tests/support/expect_error.h"

namespace seascape::test {

SimulatedOptions simulated(std::vector<InputEvent> events) {
  SimulatedOptions options;
  options.script.width = 16;
  options.script.height = 12;
  options.script.rate_hz = rig_hz;
  options.script.events = std::move(events);
  options.ends = false;
  return options;
}

InputEvent tracked(double frame, Tracker tracker, std::optional<Pose> pose) {
  return {time_of(frame), TrackerEvent{tracker, pose}};
}
InputEvent acted(double frame, Action action, double value) { return {time_of(frame), ActionEvent{action, value}}; }
InputEvent became(double frame, HeadsetState state) { return {time_of(frame), state}; }

HeadsetRig::HeadsetRig(const SimulatedOptions& options, const HeadsetOptions& how, Device& on)
    : HeadsetRig(options, how, {}, nullptr, on) {}

HeadsetRig::HeadsetRig(const SimulatedOptions& options, const HeadsetOptions& how, const Harm& harm, bool* has_failed,
                       Device& on)
    : runtime(options),
      calls(runtime, harm, has_failed),
      system(calls.get(), runtime.next()),
      headset(system, on, how),
      device_(on),
      frame_(on, 4096) {}

DisplayFrame HeadsetRig::step(bool picture) {
  const DisplayFrame shown = headset.begin();
  if (!shown.should_render || !picture) {
    headset.end(frame_, nullptr);
    return shown;
  }
  if (lent_ != shown.lent) {
    lent_ = shown.lent;
    TargetSpec spec;
    spec.width = lent_->width;
    spec.height = lent_->height;
    spec.views = 2;
    spec.colour = headset.colour();
    spec.show_depth = headset.shows_depth();
    spec.clear = {0.2f, 0.4f, 0.6f, 1.0f};
    target_ = RenderTarget(device_, "rig", spec, lent_.get());
  }
  target_.choose(shown.colour, shown.depth);
  target_.set_area(shown.width, shown.height);
  viewpoint = headset.viewpoint(Pose{});
  frame_.begin();
  frame_.draw_pass("rig", target_, {}, [](Commands&) {});
  headset.end(frame_, &target_, target_.shown_depth());
  return shown;
}

std::string error_under(const HeadsetRig::Harm& harm, int frames) {
  return error_of([&] {
    HeadsetRig rig(simulated(), harm);
    rig.steps(frames);
  });
}

void HarmTest::SetUp() {
  GpuTest::SetUp();
  HeadsetRig(simulated(), HeadsetOptions{}).steps(2);  // render passes are kept
  device().wait_idle();
  objects_ = device().objects().size();
  spdlog::default_logger()->sinks().front()->set_level(spdlog::level::off);  // not those that tests read
}

void HarmTest::TearDown() {
  spdlog::default_logger()->sinks().front()->set_level(spdlog::level::trace);
  expect_nothing_left("");
  GpuTest::TearDown();
}

void HarmTest::expect_nothing_left(const std::string& after) {
  device().wait_idle();
  EXPECT_EQ(device().objects().size(), objects_) << after;
}

}  // namespace seascape::test
