// A pattern's variances, and how fast it ceases to be like itself with distance.
#pragma once
#include <glm/glm.hpp>

#include "ocean/waves/tile_source.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

struct PatternMoments {
  double height_variance = 0.0;   // m^2
  glm::dvec3 slope_moments{0.0};  // E[hx^2], E[hz^2], E[hx hz]

  // A pattern and the same pattern d further on have the correlation R(d) = sum of E(k) cos(k . d) over sum of E(k).
  // Here R(d) = exp(-q), q = xx dx^2 + zz dz^2 + 2 xz dx dz, with these xx, zz and xz in 1/m^2: half of the slope
  // moments over the height's variance. Up to d^2 that is exact in every direction, for then R = 1 - E[(grad h . d)^2]
  // / (2 E[h^2]). So wave numbers count by their energy, and where waves run along d more than where they run across.
  // Zero of waves without height.
  glm::dvec3 decay_per_m2() const {
    return height_variance > 0.0 ? 0.5 / height_variance * slope_moments : glm::dvec3(0.0);
  }
};

// Of a cascade's bins, all of them, along the world's axes.
PatternMoments pattern_moments(const WaveBins& bins, int cascade);
// Of a source as one of its layings has it.
PatternMoments pattern_moments(const TileSource& source, const Laying& laying);

}  // namespace seascape
