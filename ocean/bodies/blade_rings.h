// The rings that an oar or a paddle leaves: its blade pushes the water aside before it and draws it in behind.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "ocean/places/wave_source.h"

namespace seascape {

struct Blade {
  glm::dvec3 at_m{0.0};              // its middle, in the world
  glm::dvec3 normal{1.0, 0.0, 0.0};  // of its face, of length 1
  glm::dvec3 slip_mps{0.0};          // against the water
  glm::dvec3 velocity_mps{0.0};      // over the ground
  double area_m2 = 0.1, breadth_m = 0.2;
};

// The share of a blade under water whose middle is this deep (m, below 0 above), its breadth standing up.
double wetted_blade(double depth_m, double breadth_m);

// Appends a source and a sink of what the blade's face sweeps in a second (Rankine 1871), half a breadth before it and
// behind, as deep as its middle under a surface at `surface_m`. None where it slips edgeways, not at all, or in the
// air.
void add_blade_sources(const Blade& blade, double surface_m, double least_length_m, std::vector<WaveSource>& sources);

}  // namespace seascape
