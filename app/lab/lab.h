// What `seascape lab` measures: curves, each of one knob's settings with the time they take and the error they make.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/statistics.h"
#include "ocean/waves/sea_state.h"

namespace seascape {

// The sea states that curves are measured in: U, the wind at 10 m height, m/s, over a fetch of 300 km.
inline constexpr double lab_winds_mps[] = {3.0, 10.0, 25.0};

struct LabOptions {
  bool quick = false;      // fewer settings, sizes and rounds
  std::uint32_t seed = 1;  // of seas, places and random settings
  bool timed = true;       // false: errors alone (tests); whole frames then smaller and few
};

struct LabError {
  double value = 0.0;
  std::string unit;  // of what, as "of Hs, rms"
};

// One setting of a knob.
struct LabTask {
  std::string knob;           // what varies and by which way: points of one knob are one line of the plot
  double value = 0.0;         // of the knob
  std::function<void()> run;  // what is timed
  double parts = 1.0;         // a run does so many of what the curve's time is of
  std::function<std::vector<LabError>()> errors;  // asked after a run; the first is what the plot shows
  std::string preset;                             // the presets that have this setting, with spaces; empty: none
  std::string settings;  // "key=value key=value", as --set takes them; empty: no settings of the program make it
};

// How an error is to fall with the knob, by theory: as value^power, or (steps) to `power` of itself with each step of
// 1; of points of `knob` whose values are from `least` to `most`, where the setting and not rounding makes it.
struct LabLaw {
  std::string knob;  // the beginning of its name; empty: the curve has no law
  bool steps = false;
  double power = 0.0, tolerance = 0.0;  // the fitted power may be off by so much
  double least = 0.0, most = 0.0;
  std::string why;        // the law in a few words, with its source
  std::string unit = {};  // of the errors that follow it; empty: the curve's first
  std::string predicted =
      {};  // the unit of what theory predicts for each point, whose power is then in place of `power`
};

// A task measured: a row of curves.csv. Times in microseconds.
struct LabPoint {
  std::string curve, knob;
  double value = 0.0;
  std::string sea;  // "U10"
  Summary time_us;
  LabError error;
  std::string preset, settings;
};

struct LabCurve {
  std::string name;  // of --curve
  std::string title;
  std::string time_of;  // what one of `parts` is, as "one query"
  std::vector<LabLaw> laws;
  bool at_sea = true;  // measured in each sea state, or once without any (wind 0)
  bool gpu = false;    // needs a device
  std::function<std::vector<LabTask>(double wind_mps, const LabOptions& options)> tasks;
  // In place of tasks, where these have no room beside each other: all points of a sea. `step`: called with the share
  // done.
  std::function<std::vector<LabPoint>(double wind_mps, const LabOptions& options,
                                      const std::function<void(double)>& step)>
      points = {};
  // Presets are compared with points whose knob begins so (empty: with all that are no preset's), and a sentence that
  // says why not with the others.
  std::string rivals = {}, why_rivals = {};
};

// "U10"; "none" of 0, for curves in which no sea takes part.
std::string sea_name(double wind_mps);
SeaState lab_sea(double wind_mps, const LabOptions& options);

// What --curve takes, apart from "all".
inline constexpr std::string_view lab_curve_names[] = {
    "query",        "transform", "cascades", "particles", "baked",      "dynamic", "wakes",
    "wake_windows", "texel",     "fresnel",  "buoyancy",  "body_steps", "volume",  "dive_light",
    "waterline",    "adaptive",  "mesh",     "compute",   "levers",     "frame"};

// The curves that need no device: query, transform, cascades; particles, baked; dynamic, texel, fresnel; wakes,
// wake_windows; buoyancy, body_steps; volume, dive_light; waterline; adaptive; and all of these.
std::vector<LabCurve> sea_curves();
std::vector<LabCurve> source_curves();
std::vector<LabCurve> local_curves();
std::vector<LabCurve> wake_curves();
std::vector<LabCurve> body_curves();
std::vector<LabCurve> water_curves();
LabCurve waterline_curve();
std::vector<LabCurve> adaptive_curves();
std::vector<LabCurve> cpu_curves();

// Times the tasks in turn, each first as often as last, for about `seconds` and at least five rounds, a run of less
// than 0.2 ms repeated until it takes as long; then asks for their errors: a point for each error. Not timed
// (options.timed): each runs once. Throws Error for an error or a time that is no finite number. `step`: called with
// the share done, 0 to 1.
std::vector<LabPoint> measure(const std::string& curve, double wind_mps, std::vector<LabTask> tasks,
                              const LabOptions& options, double seconds, const std::function<void(double)>& step);

// What theory says of a sea, law.power unless points predict it; and the power that fits a law's points best (least
// squares of logarithms), NaN of fewer than two.
double stated_power(const LabLaw& law, const std::vector<LabPoint>& points, std::string_view sea);
double fitted_power(const LabLaw& law, const std::vector<LabPoint>& points, std::string_view sea);

}  // namespace seascape
