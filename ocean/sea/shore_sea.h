// What waves along curves add to the water at a place: the pattern as it lies there, turned, stretched and weakened.
#pragma once
#include <array>
#include <glm/glm.hpp>

#include "ocean/places/flow_phase.h"
#include "ocean/places/shore_lines.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

// The C++ twin of shaders/lib/shore.glsl.
struct ShorePart {
  ShorePlace at;
  WaveField::Filter filter;        // of the footprint, and of what a current leaves of the pattern
  double share = 0.0;              // of its displacement: at.share and what the bed leaves of it
  glm::dvec2 share_gradient{0.0};  // a metre

  // A displacement or a velocity, of the pattern's axes, as it is along the world's.
  glm::dvec3 turned(const glm::dvec3& d) const;
  glm::dvec3 displacement(const WaveField& field, const WaveTiles& tiles) const {
    return share * turned(field.displacement_curved(tiles, at.bent_m, filter));
  }
  glm::dvec3 velocity(const WaveField& field, const WaveTiles& tiles) const {
    return share * turned(field.velocity_curved(tiles, at.bent_m, filter));
  }
  // Adds displacement, derivatives and what the footprint leaves out of the divergence's moment; of the shift's two
  // halves of shear, which differ where the share or the direction does, their mean.
  void add(const WaveField& field, const WaveTiles& tiles, SeaSample& to) const;
  // The two of it that a current of this velocity (m/s) has brought from elsewhere, which together are as high as it
  // is.
  std::array<ShorePart, 2> carried(const WaveField& field, glm::dvec2 velocity_mps, const FlowPhase& phase) const;
};

}  // namespace seascape
