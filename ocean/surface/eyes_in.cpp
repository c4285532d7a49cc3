#include "ocean/surface/eyes_in.h"

#include <algorithm>

namespace seascape {

NearWater near_water(const View& eye, double near_m, double reach_m, const glm::dvec3& over, double unsure_m) {
  const glm::dvec3 ahead = eye.pose.orientation * glm::dvec3(0.0, 0.0, -1.0),
                   normal = glm::normalize(glm::dvec3(-over.y, 1.0, -over.z));
  // In the near plane, away from the water, and along it.
  const glm::dvec3 up = normal - glm::dot(normal, ahead) * ahead;
  const double rises = glm::length(up);
  // Water is drawn out or pressed together by less than half, but where crests fold.
  constexpr double drawn_out = 0.5;
  if (rises < 0.64) {  // it leans over the water by more than 50 degrees, and may meet it on any side
    const double half_m = (1.0 + drawn_out) * (reach_m + unsure_m + 1.2 * (std::abs(over.x) + unsure_m));
    return {.half_m = glm::dvec2(half_m)};
  }
  const glm::dvec3 upwards = up / rises, along = glm::cross(ahead, upwards);
  // The line where it passes the water, which is a plane but for what it bends by within the picture.
  const double passes_m = (over.x * normal.y - near_m * glm::dot(normal, ahead)) / rises,
               half_picture_m = std::sqrt(std::max(reach_m * reach_m - near_m * near_m, 0.0));
  const glm::dvec3 middle = near_m * ahead + passes_m * upwards;
  const double bends_m = unsure_m + 0.35 * reach_m,
               off_m = glm::length(glm::dvec2(upwards.x, upwards.z)) / rises * bends_m;
  const glm::dvec2 flat(along.x, along.z);
  const glm::dvec2 at(middle.x, middle.z);
  const double farthest_m = glm::length(at) + half_picture_m + off_m, margin_m = drawn_out * farthest_m + unsure_m;
  return {at, glm::normalize(flat), glm::dvec2(half_picture_m, off_m) + margin_m};
}

}  // namespace seascape
