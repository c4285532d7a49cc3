// What the hands of explore's user feel, in the simulated headset. Controls are named beside each test; each was seen
// to fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/camera_path.h"
#include "app/explorer.h"
#include "platform/headset.h"
#include "platform/simulated_runtime.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

constexpr double rate_hz = 32.0;

struct Felt {
  int frame, hand;
  double strength;
  bool operator==(const Felt&) const = default;
};
void PrintTo(const Felt& f, std::ostream* out) {
  *out << "frame " << f.frame << ", hand " << f.hand << ": " << f.strength;
}

std::vector<Felt> felt(std::vector<InputEvent> events, const std::vector<std::string>& more = {}) {
  const test::TemporaryFolder folder;
  std::stable_sort(events.begin(), events.end(),
                   [](const InputEvent& a, const InputEvent& b) { return a.time_s < b.time_s; });
  SimulatedOptions options;
  options.script.width = 24;
  options.script.height = 20;
  options.script.rate_hz = rate_hz;
  options.script.events = std::move(events);
  std::vector<std::string> words{"explore",
                                 "--scene",
                                 "calm",
                                 "--preset",
                                 "low",
                                 "--set",
                                 "msaa=1",
                                 "--set",
                                 "waves.cascades=3",
                                 "--out",
                                 (folder / "out").string()};
  words.insert(words.end(), more.begin(), more.end());
  const Arguments arguments = parse_arguments(words);
  SimulatedRuntime runtime(options);
  HeadsetSystem system(runtime.get(), runtime.next());
  DeviceOptions device = device_options();
  device.validation = true;
  system.make_device(device);
  Program program = make_program(arguments, device);
  {
    HeadsetOptions how;
    how.in_real_time = false;
    Headset display(system, *program.device, how);
    Explorer(arguments, program, display).run();
  }
  expect_no_validation_messages(*program.device);
  std::vector<Felt> all;
  for (const SimulatedBuzz& buzz : runtime.buzzes()) {
    EXPECT_GT(buzz.seconds, 0.0);
    EXPECT_LE(buzz.seconds, 0.1);
    all.push_back({int(std::lround(buzz.time_s * rate_hz)), buzz.hand, std::round(buzz.strength * 100.0) / 100.0});
  }
  return all;
}

InputEvent hand(int frame, Tracker which, double pitch_deg) {
  return {frame / rate_hz, TrackerEvent{which, Pose{{0.0, 1.2, -0.4}, orientation_from_angles({0.0, pitch_deg, 0.0})}}};
}
void hold(std::vector<InputEvent>& events, int frame, int until, Action action, double value = 1.0) {
  events.push_back({frame / rate_hz, ActionEvent{action, value}});
  events.push_back({until / rate_hz, ActionEvent{action, 0.0}});
}

// One buzz as the aim finds water, again after it lost it, and one that is stronger as one arrives; none where there is
// no water, nor while it stays found. The hand that points feels it, of the left-handed the left one, and the other
// where that is not tracked. Controls: a buzz with each frame; the right hand always; one where there is no water.
TEST(ExploreFeel, AnAimThatFindsWaterAndAnArrival) {
  const auto aims = [](std::vector<Tracker> hands) {
    std::vector<InputEvent> events;
    for (const Tracker which : hands)
      for (const auto& [frame, pitch_deg] :
           {std::pair(0, 30.0), {11, 30.0}, {12, -20.0}, {15, -20.0}, {16, 30.0}, {17, 30.0}, {18, -10.0}, {30, -10.0}})
        events.push_back(hand(frame, which, pitch_deg));
    hold(events, 6, 22, Action::teleport);
    return events;
  };
  const auto expected = [](int of) { return std::vector<Felt>{{12, of, 0.25}, {18, of, 0.25}, {22, of, 0.6}}; };
  const std::vector<std::string> left_handed{"--set", "headset.left_handed=true"};
  EXPECT_EQ(felt(aims({Tracker::left, Tracker::right})), expected(1));
  EXPECT_EQ(felt(aims({Tracker::left})), expected(0));
  EXPECT_EQ(felt(aims({Tracker::left, Tracker::right}), left_handed), expected(0));
  EXPECT_EQ(felt(aims({})), std::vector<Felt>());
}

// Each step once. Control: a buzz for as long as the stick is held.
TEST(ExploreFeel, ATurnByAStep) {
  std::vector<InputEvent> events{hand(0, Tracker::right, 0.0), hand(30, Tracker::right, 0.0)};
  hold(events, 6, 12, Action::snap_turn);
  hold(events, 15, 18, Action::snap_turn, -1.0);
  hold(events, 20, 26, Action::turn);  // evenly, which nobody feels
  EXPECT_EQ(felt(events), (std::vector<Felt>{{6, 1, 0.4}, {15, 1, 0.4}}));
}

}  // namespace
}  // namespace seascape
