// A minute at the keys of a virtual display: aboard a rowing boat, a boat with an engine that runs into a buoy, and a
// yacht under sail. Control seen: board not obeyed.
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <thread>

#include "app/camera_path.h"
#include "engine/files.h"
#include "tests/support/desktop.h"

namespace seascape {
namespace {

using test::Background;
using test::TemporaryFolder;
using test::VirtualDisplay;
using test::wait_until;

constexpr const char* engines = R"({"version": 1, "effects": ["waves", "models", "boats", "wakes"],
  "waves": {"wind_speed_mps": 0},
  "objects": [
    {"model": "rowing_boat", "name": "dinghy", "at_m": [0, 0, -3], "float": {}},
    {"model": "rib", "name": "rib", "at_m": [0, 0, 16], "yaw_deg": 180, "float": {}},
    {"model": "buoy_lateral_port", "name": "buoy", "at_m": [0, 0, 32], "float": {"moored_m": [[0, 32]]}}],
  "camera": {"position_m": [1, 1.6, 0]}})";

constexpr const char* sailing = R"({"version": 1, "effects": ["waves", "models", "boats", "wakes"],
  "waves": {"wind_speed_mps": 9, "wind_to_deg": 112, "fetch_m": 300},
  "objects": [{"model": "yacht", "name": "yacht", "at_m": [0, 0, -4], "float": {}}],
  "camera": {"position_m": [1, 2, 1]}})";

constexpr const char* moorings = R"({"version": 1, "effects": ["waves", "models", "boats"],
  "waves": {"wind_speed_mps": 0, "depth_m": 6},
  "objects": [
    {"model": "rib", "name": "rib", "at_m": [0, 0, -4], "float": {}},
    {"model": "pier", "name": "pier", "at_m": [-4.5, 0, -4]}],
  "camera": {"position_m": [1, 1.8, 0]}})";

class Voyage {
 public:
  explicit Voyage(const char* scene) {
    write_atomically(folder_ / "s.json", std::string_view(scene));
    program_ = std::make_unique<Background>(
        std::vector<std::string>{SEASCAPE_BUILD_DIR "/seascape", "explore", "--display", "window", "--scene",
                                 (folder_ / "s.json").string(), "--preset", "low", "--set", "msaa=1", "--set",
                                 "waves.cascades=3", "--set", "models.seen_in_water=false", "--size", "240x160",
                                 "--out", (folder_ / "out").string()},
        std::vector<std::string>{display_.variable(), "SEASCAPE_VALIDATION=1"});
    wait_until([&] {
      window_ = display_.xdotool({"search", "--onlyvisible", "--name", "^Seascape: "});
      window_ = window_.substr(0, window_.find('\n'));
      return !window_.empty() || !program_->running();
    });
    display_.xdotool({"windowfocus", "--sync", window_});
  }
  void key(const std::string& name) { display_.xdotool({"key", name}); }
  void hold(const std::vector<std::string>& names, double seconds) {
    for (const std::string& name : names) display_.xdotool({"keydown", name});
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    for (const std::string& name : names) display_.xdotool({"keyup", name});
  }
  bool says(const std::string& line, double patience_s = 20.0) {
    wait_until([&] { return program_->out().find(line) != std::string::npos || !program_->running(); }, patience_s);
    return program_->out().find(line) != std::string::npos;
  }
  // Flies on until a boat is boarded; where it is one that he comes from, he steps off and flies farther.
  bool boards(const std::string& name) {
    double fly_s = 0.0;
    for (int i = 0; i < 40; ++i) {
      const std::size_t before = program_->out().size();
      key("b");
      const auto said = [&] { return program_->out().substr(before); };
      wait_until([&] { return said().find('\n') != std::string::npos || !program_->running(); }, 10.0);
      if (said().empty()) return false;
      if (said().find("aboard: " + name) != std::string::npos) return true;
      if (said().find("aboard: ") != std::string::npos) {
        key("b");
        wait_until([&] { return said().find("stepped off: ") != std::string::npos || !program_->running(); });
        hold({"w"}, fly_s += 0.4);
      } else {
        hold({"w"}, 0.12);
      }
    }
    return false;
  }
  Background& program() { return *program_; }
  TemporaryFolder folder_;

 private:
  VirtualDisplay display_;
  std::unique_ptr<Background> program_;
  std::string window_;
};

void end(Voyage& voyage) {
  voyage.key("Escape");
  EXPECT_EQ(voyage.program().exit_code(60.0), 0) << voyage.program().err();
  EXPECT_EQ(voyage.program().err().find("alidation"), std::string::npos) << voyage.program().err();
}

TEST(ExploreBoats, AMinuteAtTheKeys) {
  Voyage voyage(engines);
  ASSERT_TRUE(voyage.program().running()) << voyage.program().err();
  voyage.key("r");
  ASSERT_TRUE(voyage.says("path: recording")) << voyage.program().err();
  ASSERT_TRUE(voyage.boards("dinghy")) << voyage.program().out();
  voyage.hold({"j", "l"}, 6.0);
  voyage.key("2");  // from behind
  EXPECT_TRUE(voyage.says("looking from behind"));
  voyage.key("1");
  voyage.key("b");
  ASSERT_TRUE(voyage.says("stepped off: dinghy"));
  ASSERT_TRUE(voyage.boards("rib")) << voyage.program().out();  // a rower looks astern, and flies there
  voyage.hold({"w"}, 8.0);
  EXPECT_TRUE(voyage.says("rib: hit")) << voyage.program().out();
  voyage.key("b");
  ASSERT_TRUE(voyage.says("stepped off: rib"));
  voyage.key("r");
  ASSERT_TRUE(voyage.says("path: /"));
  end(voyage);
  const CameraPath path = load_camera_path((voyage.folder_ / "out" / "recorded_001.json").string());
  double least = 0.0, most = 0.0;
  for (const PathKey& key : path.keys)
    least = std::min(least, key.pose.position_m.z), most = std::max(most, key.pose.position_m.z);
  EXPECT_LT(least, -4.0) << "rowed";
  EXPECT_GT(most, 20.0) << "under engine";
}

// With the wind before the beam, the sheet is hauled in and she sails. Control seen: the sheet not asked for, so that
// her sails flog.
TEST(ExploreBoats, SailsAtTheKeys) {
  Voyage voyage(sailing);
  ASSERT_TRUE(voyage.program().running()) << voyage.program().err();
  ASSERT_TRUE(voyage.boards("yacht")) << voyage.program().out();
  voyage.key("r");
  ASSERT_TRUE(voyage.says("path: recording")) << voyage.program().err();
  voyage.hold({"e"}, 12.0);
  voyage.key("r");
  ASSERT_TRUE(voyage.says("path: /"));
  voyage.key("b");
  ASSERT_TRUE(voyage.says("stepped off: yacht"));
  end(voyage);
  const CameraPath path = load_camera_path((voyage.folder_ / "out" / "recorded_001.json").string());
  EXPECT_LT(path.keys.back().pose.position_m.z, path.keys.front().pose.position_m.z - 2.0);
}

// Made fast to a pier she stays under full throttle, and cast off she goes; anchored and weighed; put back where she
// began; and the recorded path has it all. Control
// seen: the key of `moor` without its action.
TEST(ExploreBoats, MoorsAnchorsAndComesBackAtTheKeys) {
  Voyage voyage(moorings);
  ASSERT_TRUE(voyage.program().running()) << voyage.program().err();
  voyage.key("r");
  ASSERT_TRUE(voyage.says("path: recording")) << voyage.program().err();
  ASSERT_TRUE(voyage.boards("rib")) << voyage.program().out();
  voyage.key("y");
  ASSERT_TRUE(voyage.says("moored: rib to pier")) << voyage.program().out();
  voyage.hold({"w"}, 8.0);
  voyage.key("y");
  ASSERT_TRUE(voyage.says("cast off: rib")) << voyage.program().out() << voyage.program().err();
  voyage.key("i");
  ASSERT_TRUE(voyage.says("anchored: rib, 6.0 m of water")) << voyage.program().out();
  voyage.key("i");
  ASSERT_TRUE(voyage.says("anchor weighed: rib"));
  voyage.hold({"w"}, 12.0);
  voyage.key("BackSpace");
  ASSERT_TRUE(voyage.says("back where she began: rib"));
  voyage.key("r");
  ASSERT_TRUE(voyage.says("path: /"));
  end(voyage);
  const CameraPath path = load_camera_path((voyage.folder_ / "out" / "recorded_001.json").string());
  ASSERT_TRUE(path.actions);
  std::map<Action, double> pressed_s;
  for (const ActionPress& press : InputTimeline(*path.actions).presses(-1.0, path.duration_s()))
    pressed_s[press.action] = press.time_s;
  for (const Action action : {Action::moor, Action::anchor, Action::respawn})
    EXPECT_TRUE(pressed_s.contains(action)) << row_of(action).name;
  // She swings at her lines, and goes wherever she points then.
  const glm::dvec3 cast_off_m = path.at(pressed_s[Action::moor]).pose.position_m;
  double moored = 0.0, loose = 0.0;
  for (const PathKey& key : path.keys) {
    if (key.time_s < pressed_s[Action::moor])
      moored = std::max(moored, glm::length(key.pose.position_m - path.keys.front().pose.position_m));
    else
      loose = std::max(loose, glm::length(key.pose.position_m - cast_off_m));
  }
  EXPECT_LT(moored, 18.0) << "her lines hold her";
  EXPECT_GT(loose, 10.0) << "without them she goes";
  EXPECT_GT(path.keys.back().pose.position_m.z, -8.0) << "back again";
}

}  // namespace
}  // namespace seascape
