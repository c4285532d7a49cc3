// What the water looks like. Plain values.
#pragma once
#include <glm/glm.hpp>

namespace seascape {

// Jerlov's types of ocean and coast, from the clearest (I, IA, IB, II, III; 1C to 9C); water that chlorophyll colours;
// or a colour.
enum class WaterType {
  ocean_1,
  ocean_1a,
  ocean_1b,
  ocean_2,
  ocean_3,
  coast_1,
  coast_3,
  coast_5,
  coast_7,
  coast_9,
  chlorophyll,
  colour
};

struct WaterSettings {
  WaterType type = WaterType::chlorophyll;
  double red = 0.004, green = 0.025, blue = 0.05;  // type colour: of the light that enters, what deep water sends back
  double sight_m = 30.0;                           // type colour: how far off a black thing is seen, 0.5 to 100
  double chlorophyll_mg_m3 = 0.15;                 // type chlorophyll: 0.01 the bluest ocean to 10 a green coast
  double crest_light = 1.0;  // strength of sunlight seen through thin crests, 1 as derived, 0 none
  double whitecaps = 1.0;    // strength of the instant whitecaps of the foam effect, 0 none
  double glitter = 1.0;      // strength of the sun's reflection, 1 as derived
  double adaptation = 0.3;   // of the light lost under water, the share that the exposure makes up for
  double anisotropy = 8.0;   // largest anisotropy of the samplers of slopes, 1 to 16, where the device has it
};

}  // namespace seascape
