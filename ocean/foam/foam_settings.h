// Foam as it is kept on the water: how it comes, how long it stays and where it is simulated. Plain values, in SI
// units.
#pragma once
#include "ocean/places/lod_windows.h"

namespace seascape {

struct FoamSettings {
  bool simulated =
      false;  // foam outlives the crest that made it; inputs of foam and shores have it simulated in any case
  // Lace is broken up by pixels: from 24 m the finest texels are still to be told apart.
  LodWindowSettings windows{.resolution = 256, .slices = 4, .texel_m = 0.5, .scale_height_m = 24.0};
  double rate_hz = 12.0;  // steps a second, 1 to 240; any gives the same decay
  double life_s = 3.85;  // in which foam that nothing feeds falls to 1/e, 0.1 to 1000 (whitecaps of salt water: Monahan
                         // and Zietlow 1969)
  double breaking = 1.0;     // what breaking waves leave, 0 none to 4: times breaking_per_s
  double shore_m = 0.65;     // water less deep than this foams
  double shore_per_s = 2.0;  // share of the water at its very edge that comes to be covered in a second, 0 to 100
  double settle_s = 8.0;     // simulated before the first moment shown, and after each jump of the time, 0 to 60
};

// The share of the water that foam comes to cover in a second where it breaks all over.
inline constexpr double foam_breaking_per_s = 2.0;

// In which the trail behind a hull falls to 1/e: fine bubbles that stay 30 to 60 s behind small boats, and minutes
// behind ships.
inline constexpr double foam_trail_life_s = 45.0;

// Throws Error naming the setting.
void validate(const FoamSettings& settings);

}  // namespace seascape
