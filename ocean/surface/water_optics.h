// What open-ocean water absorbs and scatters back, from its chlorophyll (case 1 waters).
#pragma once
#include <glm/glm.hpp>

namespace seascape {

struct WaterOptics {
  glm::dvec3 absorption;   // 1/m at 620, 550, 450 nm
  glm::dvec3 backscatter;  // 1/m at the same
  glm::dvec3 scattering;   // 1/m, of all directions
};

// `chlorophyll` in mg/m^3, above 0. Absorption: pure water of Pope and Fry (1997) with Prieur and Sathyendranath (1981)
// as given by Morel (1991). Scattering and backscatter: water and particles after Morel (1988).
WaterOptics water_optics(double chlorophyll);

// Radiance that leaves the water upwards over the irradiance that has entered it, 1/sr: scattered back (Gordon et al.
// 1975) and out through the surface (Mobley 1994, eq. 3.27).
glm::dvec3 radiance_from_below(const WaterOptics& optics);

// Of the sun's irradiance on a plane that faces it, the share that enters a level sea; 0 below the horizon. `sine`: of
// its elevation.
double sun_share_entering(double sine);

}  // namespace seascape
