// The effect dynamic_waves as a scene has it: how the waves move, and the rain that raises them. Plain values, in SI
// units.
#pragma once
#include "ocean/places/dynamic_waves_settings.h"
#include "ocean/places/rain_settings.h"

namespace seascape {

struct DynamicSeaSettings {
  DynamicWavesSettings waves;
  RainSettings rain;
  double settle_s = 4.0;  // simulated before the first moment shown, and after each jump of the time, 0 to 60
};

// Throws Error naming the setting.
void validate(const DynamicSeaSettings& settings);
// Whether anything can ever push the water. `pressed`: inputs do.
bool still(const DynamicSeaSettings& settings, bool pressed = false);

}  // namespace seascape
