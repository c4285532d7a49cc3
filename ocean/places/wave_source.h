// What pushes the water: a hump of pressure or of water, at the surface or below it.
#pragma once
#include <glm/glm.hpp>
#include <span>

namespace seascape {

// A push on the water with the profile exp(-pi^2 r^2 / length^2) (Darmon, Benzaquen and Raphael 2014).
struct WaveSource {
  glm::dvec2 place_m{0.0};  // its middle at the end of the time that is advanced by
  glm::dvec2 velocity_mps{0.0};
  double length_m = 1.0;
  double head_m = 0.0;    // pressure on its middle, in metres of water
  double rise_mps = 0.0;  // water that is added there (above 0) or taken away, as a speed of the level
  double depth_m =
      0.0;  // how deep it acts: waves of number k feel exp(-k depth) of it (Airy 1845); below 0 counts as 0
};

// a exp(-k^2 b^2): what is as wide as a Gaussian more (b, m).
struct DepthTerm {
  double amplitude = 1.0, width_m2 = 0.0;
};
// exp(-k depth) for wave numbers from `least` to `most` (1/m) as a sum of such terms, so that depth only widens a
// source's profile: written to `terms`, at most two; gives how many. Off by 0.7 % of 1 at most over three to one in k
// (one level of the dynamic waves), 4 % over eight to one (the coarsest, 256 texels a side).
int depth_terms(double depth_m, double least, double most, std::span<DepthTerm, 2> terms);

}  // namespace seascape
