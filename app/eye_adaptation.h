// How eyes get used to the darkness under water.
#pragma once
#include <glm/glm.hpp>

namespace seascape {

// The light about an eye in the water: `sent_up`, radiance from deep water over the irradiance that enters it (1/sr, a
// value a colour), `fading` of irradiance with depth (1/m), and how deep the eye is (m, below 0 in the air).
struct LightInWater {
  glm::dvec3 sent_up, fading;
  double depth_m = 0.0;
};

// Stops that the exposure gains: `share` (0 to 1) of what the light about the eye has lost against that about an eye in
// the air, which is taken for all of the irradiance, evenly from all sides; ten stops are the most that may be lost. At
// the surface none, so that nothing jumps there, and in full from 1 m on.
double adaptation_stops(const LightInWater& light, double share);

}  // namespace seascape
