// The command line: what was asked for, checked, before anything is opened or made.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/camera_path.h"
#include "app/quality.h"
#include "app/scene.h"

namespace seascape {

enum class Command { text, explore, replay, capture, lab, bake, plan, query, validate, doctor };
enum class DisplayKind { automatic, window, headset, simulated, headless };
enum class Eye { left, right, centre };
enum class PictureFormat { png, exr };

// --set key=value, or an option that stands for one (--seed, --stereo, --debug).
struct Override {
  std::string option, key, value;
};

// --times A:B:STEP.
struct TimeSpan {
  double from_s, to_s, step_s;
  std::vector<double> all() const;
};

struct Arguments {
  Command command = Command::explore;
  std::string text;  // of Command::text: help or version, to print and exit 0

  std::string scene = "open_sea";  // a file, or a name in content/scenes
  std::string preset = "auto";     // of quality.h; "auto"; "all" for capture
  std::string path;                // a file or a name in content/paths; empty: named like the scene
  DisplayKind display = DisplayKind::automatic;
  int width = 0, height = 0;  // pixels an eye; 0: the display's own choice; bake: texels a side
  int views = 2;              // 1: one picture from `eye`, the default of explore; 2: left and right
  Eye eye = Eye::centre;
  double fps = 30.0;    // frames a second of simulated time
  int frames = 0;       // how many; 0: to the path's end (replay, capture), until closed (explore)
  int start = 0;        // replay: the path's first frame to draw
  std::string input;    // explore: the simulated headset's script, a file or a name in content/inputs; empty: none
  int every = 0;        // explore: the simulated headset keeps every Nth frame; 0: none
  int warmup = 10;      // capture: frames drawn before measuring
  int repeat = 1;       // capture: how often the path is measured
  std::string against;  // capture: the capture.csv of another build; empty: none
  std::string out;      // folder of results; query: the file
  PictureFormat format = PictureFormat::png;
  bool json = false;                // plan, doctor: machine-readable
  std::string matrix;               // plan: a folder for the plans of every preset; empty: none
  std::string presets;              // plan: the file of what presets cost; empty: none
  bool calibrate = false;           // doctor
  std::string curve = "all";        // lab: of lab_curve_names
  bool quick = false;               // lab
  bool recommend = false;           // lab: names settings for budget_ms
  double budget_ms = 0.0;           // lab: 0, none is given
  double time_s = 0.0;              // query
  std::optional<TimeSpan> times;    // query: instead of time_s
  bool all_columns = false;         // query
  double footprint_m = 0.0;         // query
  bool ray = false;                 // query: the points are rays
  double tile_m = 0.0;              // bake: the loop's side; 0: of the sea's own choice
  std::string points;               // query: CSV of x,z or of rays
  std::vector<std::string> files;   // validate
  std::vector<Override> overrides;  // in the order they take effect
  std::string log_level = "info";   // trace debug info warn error off
};

// `words` without the program's name. No command means explore. Throws Error with exit code 2 for wrong usage, naming
// the nearest known option.
Arguments parse_arguments(std::span<const std::string> words);

// The scene with the preset (resolved, see resolve_preset) and then the overrides applied; between them, where a device
// is known, what the preset is otherwise on it (suit_device).
Scene scene_from(const Arguments& arguments, std::string_view preset, std::optional<DeviceClass> device = std::nullopt);
// Warns of what in the scene gives nothing or is not drawn as asked (remarks_of).
void tell_remarks(const Scene& scene);

// The path of --path, or the one in content/paths that is named like the scene.
CameraPath path_from(const Arguments& arguments, const Scene& scene);

}  // namespace seascape
