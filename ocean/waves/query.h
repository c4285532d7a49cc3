// Where the displaced surface stands at a place: the inverse of the sea's horizontal displacement.
#pragma once
#include <glm/glm.hpp>
#include <span>

#include "ocean/waves/wave_field.h"

namespace seascape {

struct QueryAnswer {
  double height_m = 0.0;            // above the still sea
  glm::dvec3 displacement{0.0};     // of the surface point found there, from its rest position
  glm::dvec3 normal{0.0, 1.0, 0.0};
  glm::dvec3 velocity_mps{0.0};     // orbital: of the water particle at the surface there; 0 if the tiles have no velocity
  bool converged = false;           // a surface point within tolerance was found and the surface is not folded there
  int iterations = 0;               // steps taken
  double residual_m = 0.0;          // horizontal distance between the point found and the place asked
};

struct QueryOptions {
  double footprint_m = 0.0;   // size of the object asking: shorter waves are left out
  int most_iterations = 8;    // of x <- q - D(x), which converges at the rate sup |grad D| where that is below 1
  double tolerance_m = 1e-3;  // stop when a step is shorter
};

// Answers for world places (x, z in metres), `answers` as long as `places`. No allocation, any number of threads at once.
void query(const WaveField& field, const WaveTiles& tiles, std::span<const glm::dvec2> places, std::span<QueryAnswer> answers,
           const QueryOptions& options = {});

}  // namespace seascape
