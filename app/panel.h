// Explore's panel: every row of the settings table as a widget, with what the frame took and drew.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/explore_camera.h"
#include "app/preset_costs.h"
#include "app/quality.h"
#include "app/settings.h"
#include "engine/frame.h"

namespace seascape {

// What the panel shows and does not change.
struct PanelFacts {
  std::string_view title, scene, preset, device, message;
  DeviceClass device_class = DeviceClass::discrete;
  const PresetCosts* costs = nullptr;            // of the scene's presets; null: not known
  std::span<const std::string> scenes, effects;  // effects: the scene's as they are now
  std::uint32_t width = 0, height = 0;
  int views = 1;
  Travel travel = Travel::fly;
  double speed_mps = 0.0, sea_time_s = 0.0, recorded_s = 0.0;
  bool paused = false, recording = false;
  bool aboard = false, moored = false, anchored = false;
  double frame_ms = 0.0, cpu_ms = 0.0, gpu_ms = 0.0;
  double period_ms = 0.0;              // from one frame to the next as the display has it; 0: it does not say
  double scale = 1.0;                  // of the size that the display asks for
  std::string quality;                 // what is done to hold the frame rate, and why
  std::uint64_t dropped = 0;           // frames that the display showed nothing new in
  std::string_view state = "focused";  // of a headset: "focused", "unfocused", "away"
  std::span<const PassTime> passes;
  std::span<const StageTime> stages;
  FrameCounts counts;
  std::size_t patches = 0;
};

// What the user has asked for in this frame.
struct PanelWish {
  std::optional<Settings> settings;
  std::optional<std::string> preset, scene;
  std::optional<std::vector<std::string>> effects;
  std::optional<Travel> travel;
  std::optional<double> sea_time_s;
  bool screenshot = false, record = false, pause = false;
  bool moor = false, anchor = false, respawn = false;  // of the boat that one is aboard of
};

// The lines that tell the keys, at the start and in the panel: key, then what it does.
std::span<const std::array<const char*, 2>> key_help();

class Panel {
 public:
  // Between Overlay::begin and end. `settings` are those in force, `initial` those that a right click goes back to. A
  // row that makes GPU objects anew is handed out when the mouse lets go of it, any other at once.
  PanelWish draw(const Settings& settings, const Settings& initial, const PanelFacts& facts);
  // A short line at the window's foot, also without the panel.
  static void draw_message(std::string_view message);

  bool visible = true;
  bool alone = false;  // on a board of its own, which it fills

 private:
  void draw_head(const Settings& settings, const PanelFacts& facts, PanelWish& wish);
  void draw_times(const PanelFacts& facts);
  static void draw_presets(const PanelFacts& facts);
  bool draw_rows(const Settings& initial);
  Settings edited_;  // in force, but for a row that is being dragged
  bool dragging_ = false;
  std::array<float, 120> history_ms_{};
  int history_at_ = 0;
};

}  // namespace seascape
