// Where lines of sight are in water among a frame's shapes: the C++ twin of shaders/lib/water_shapes.glsl, in double.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "shaders/shared/frame_data.h"

namespace seascape {

// Shapes of a frame: the first so many of them are there. Places are in metres relative to the viewer.
struct WaterLines {
  const gpu::WaterShapes& shapes;
  int air = 0, portals = 0;

  // Of the line from + t ray (ray of unit length), where it is within a shape, or behind a sheet: from x to y; none
  // where y is not the larger.
  glm::dvec2 span(const gpu::WaterShape& shape, const glm::dvec3& from, const glm::dvec3& ray) const;
  // Where the air of a pocket is.
  glm::dvec2 air_span(const gpu::WaterShape& shape, const glm::dvec3& from, const glm::dvec3& ray) const;
  // Where water may be seen through a portal.
  glm::dvec2 portal_span(const gpu::WaterShape& shape, const glm::dvec3& from, const glm::dvec3& ray) const;
  bool in_air(const glm::dvec3& at) const;  // in any pocket's
  // In any pocket's, or with portals in none of the volumes that one flies through.
  bool keep_dry(const glm::dvec3& at) const;
  // The parts of the line's first `way` metres that are in water, in their order, where the sea is all around.
  std::vector<glm::dvec2> wet_parts(const glm::dvec3& from, const glm::dvec3& ray, double way) const;
};

}  // namespace seascape
