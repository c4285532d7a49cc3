#include "ocean/inputs/clip_body.h"

namespace seascape {

ClipBody carried(const ClipBody& body, double dt_s) {
  ClipBody result = body;
  result.velocity_mps = result.spin_rad_s = glm::dvec3(0.0);
  if (dt_s == 0.0) return result;
  result.at_m += dt_s * body.velocity_mps;
  const double turned_rad = dt_s * glm::length(body.spin_rad_s);
  if (turned_rad != 0.0)
    result.orientation = glm::normalize(glm::angleAxis(turned_rad, glm::normalize(body.spin_rad_s)) * body.orientation);
  return result;
}

}  // namespace seascape
