// Waves that bodies make, in windows of their own: the settings of the effect wakes. Plain values, in SI units.
#pragma once
#include "ocean/places/dynamic_waves_settings.h"

namespace seascape {

struct WakeSettings {
  // windows: 2 to gpu::max_wake_levels slices. The sea sets the rate of its steps, gravity and depth.
  DynamicWavesSettings waves{.windows = {.resolution = 128, .slices = 3, .texel_m = 0.25}};
  double least_speed_mps = 0.3;   // a body that moves faster and pushes at all asks for a window, 0 or more,
  double least_push_m3ps = 0.05;  // and so does one that pushes harder (push_m3ps), 0 or more
};

// Throws Error naming the setting.
void validate(const WakeSettings& settings);

}  // namespace seascape
