// The sun's own view of what stands around the viewer: where things are in the map of its light. Pure.
#pragma once
#include <glm/glm.hpp>

#include "shaders/shared/frame_data.h"

namespace seascape {

struct SunView {
  bool shines = false;                                                        // or else nothing is seen of it
  glm::dvec3 column{1.0, 0.0, 0.0}, row{0.0, 0.0, 1.0}, near{0.0, 1.0, 0.0};  // the map's axes; to the sun
  glm::dvec3 middle{0.0};  // of the map: a whole number of texels off the world's middle, along its axes
  double reach_m = 0.0, texel_m = 0.0;
  double share = 1.0;  // of the side of the image that it is drawn into

  // Whether a ball may throw a shadow into the map.
  bool may_shade(const glm::dvec3& at, double radius) const;
  // What shaders are told of it.
  void describe(gpu::FrameData& data, const glm::dvec3& viewer_m) const;
};

// `to_sun`: of unit length. The map goes with the viewer by whole texels of its own, so that a shadow's edge stands
// still while a head moves.
SunView sun_view(const glm::dvec3& to_sun, const glm::dvec3& viewer_m, int texels, double reach_m);

}  // namespace seascape
