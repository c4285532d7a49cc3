// What `auto` goes by where a display has a rate to hold: what a frame of each preset takes on this device, measured
// once and remembered.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "engine/disk_cache.h"

namespace seascape {

// A frame's time: a part that it has at any size, and a part of its pixels, all eyes together. Milliseconds.
struct FrameCost {
  double fixed_ms = 0.0, ms_a_megapixel = 0.0;
  double at(double megapixels) const { return fixed_ms + ms_a_megapixel * megapixels; }
};

// Through the times of two sizes, the first smaller; neither part is below 0.
FrameCost cost_through(double megapixels, double ms, double more_megapixels, double more_ms);

struct Calibration {
  std::array<std::optional<FrameCost>, 4> presets;  // from low to ultra; nothing: not measured
};

// What is asked of a preset.
struct FrameGoal {
  double megapixels = 0.0;  // of a frame, all eyes together
  double period_ms = 0.0;   // of the display
};
// Of the period, what a frame may take: the rest is for scenes that take longer than the one that was measured.
inline constexpr double share_of_period = 0.9;

// The preset to be measured next, or, where enough is known, the one to be taken: the finest that fits the goal, low
// where none does. The walk begins at `first`, the preset of such devices, and goes up or down from it.
struct AutoStep {
  std::size_t preset = 0;
  bool measure = false;
};
AutoStep auto_step(const Calibration& known, std::size_t first, const FrameGoal& goal);
// Where nothing more may be measured: the finest of those known to fit, low where none is.
std::size_t auto_choice(const Calibration& known, const FrameGoal& goal);

// By what it is kept: another driver may take other times.
struct CalibratedDevice {
  std::string device, driver;
};
void remember(const DiskCache& cache, const CalibratedDevice& device, const Calibration& known);
// Nothing known where there is no such file or it is damaged.
Calibration remembered(const DiskCache& cache, const CalibratedDevice& device);

// "low 2.10 ms and 3.40 ms a megapixel, medium ...", or "not measured".
std::string calibration_text(const Calibration& known);

}  // namespace seascape
