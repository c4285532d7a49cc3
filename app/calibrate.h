// Measures what presets take on a device, for `auto` before a display that has a rate to hold.
#pragma once
#include "app/arguments.h"
#include "app/calibration.h"
#include "app/program.h"

namespace seascape {

// What a display asks of a device.
struct DisplayGoal {
  std::uint32_t width = 0, height = 0;  // pixels of one eye
  int views = 1;
  double rate_hz = 0.0;
  std::string scene = {};  // that is shown: how much longer its frames take is told by content/presets.csv
};

// The preset that suits the device, the display and the scene, from what is remembered of the device; what is not yet
// known of it and matters is measured, in two seconds of frames at most, and remembered. Presets are measured in the
// scene storm; where content lacks it the preset is that of such devices. Throws Error as Experience does.
std::string calibrated_preset(Device& device, ShaderLibrary& shaders, const DisplayGoal& goal);

// All presets anew, whatever is remembered, which it replaces.
Calibration calibrated_anew(Device& device, ShaderLibrary& shaders, const DisplayGoal& goal);

CalibratedDevice calibrated_device(const DeviceFacts& facts);

}  // namespace seascape
