// What the water looks like. Plain values.
#pragma once
#include <glm/glm.hpp>

namespace seascape {

struct WaterSettings {
  double chlorophyll_mg_m3 = 0.15;  // 0.01 the bluest ocean to 10 a green coast: sets absorption and scattering
  double crest_light = 1.0;         // strength of sunlight seen through thin crests, 1 as derived, 0 none
  double whitecaps = 1.0;           // strength of the instant whitecaps of the foam effect, 0 none
  double glitter = 1.0;             // strength of the sun's reflection, 1 as derived
  double anisotropy = 8.0;          // largest anisotropy of the samplers of slopes, 1 to 16, where the device has it
};

}  // namespace seascape
