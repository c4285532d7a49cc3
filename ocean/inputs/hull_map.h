// What a closed model encloses, as a map seen from above in its own axes: at each place from which height to which.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/gltf.h"

namespace seascape {

// Texels of clip_hull_texels a side about the model's middle (shaders/shared/clip_volume.h). Read between texels it is
// off by at most a texel at an edge of the hull (two hundredths of a boat's length) and by the square of a texel, over
// eight times the radius, where it is round. What lies between the lowest and the highest face at a place counts as
// within: the water beneath a catamaran's bridge does not, for the bridge is the lowest face there, but that in a cave
// of its side does.
struct HullMap {
  glm::dvec3 middle_m{0.0};  // of the model
  double texel_m = 1.0, half_height_m = 1.0;
  std::vector<glm::vec3> texels;  // lowest and highest, of half_height_m from the middle; beyond the outline, texels,
                                  // below 0 within; rows along z

  // Between texels, at x and z from the middle; `beyond` is large where the map has nothing.
  glm::vec3 read(glm::dvec2 from_middle_m) const;
};

// What keeps a model from enclosing anything, "" where it does: "is not closed: ...", "encloses nothing".
std::string hull_fault(const Model& model);

// Of a model without fault. Takes some hundredths of a second.
HullMap make_hull_map(const Model& model);

}  // namespace seascape
