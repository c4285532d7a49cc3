#include "ocean/lod/culling.h"

#include <algorithm>
#include <cmath>

#include "ocean/lod/culling_simd.h"

namespace seascape {

void EyeFrusta::set(const std::vector<View>& eyes, const glm::dvec3& origin_m) {
  planes_.resize(eyes.size() * planes_per_eye);
  all_ = none;
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    const Fov& fov = eyes[e].fov;
    FrustumPlane* const planes = &planes_[e * planes_per_eye];
    const glm::dvec3 position = eyes[e].pose.position_m - origin_m;
    std::size_t count = 0;
    const auto add = [&](const glm::dvec3& n, double offset) {
      planes[count++] = {n.x, n.z, offset, std::max(n.y, 0.0), std::min(n.y, 0.0), std::abs(n.x) + std::abs(n.z)};
    };
    const glm::dmat3 rotation = glm::mat3_cast(eyes[e].pose.orientation);
    // A point (x, y, z) of eye space is inside while left * -z <= x <= right * -z, likewise for y, and z <= 0.
    for (const glm::dvec3& of_eye : {glm::dvec3(1.0, 0.0, fov.left), glm::dvec3(-1.0, 0.0, -fov.right), glm::dvec3(0.0, -1.0, -fov.up),
                                     glm::dvec3(0.0, 1.0, fov.down), glm::dvec3(0.0, 0.0, -1.0)}) {
      const glm::dvec3 normal = rotation * of_eye;
      add(normal, -glm::dot(normal, position));
    }
    glm::bvec3 all_up(true), all_down(true);
    for (const double x : {fov.left, fov.right})
      for (const double y : {fov.down, fov.up}) {
        const glm::dvec3 ray = rotation * glm::dvec3(x, y, -1.0);
        for (int axis = 0; axis < 3; ++axis) {
          if (ray[axis] < 0.0) all_up[axis] = false;
          if (ray[axis] > 0.0) all_down[axis] = false;
        }
      }
    for (int axis = 0; axis < 3; ++axis) {
      if (!all_up[axis] && !all_down[axis]) continue;
      glm::dvec3 normal(0.0);
      normal[axis] = all_up[axis] ? 1.0 : -1.0;
      add(normal, all_up[axis] ? -position[axis] : position[axis]);
    }
    if (e < most_eyes) all_ |= ((Questions{1} << count) - 1) << (8 * e);
    for (; count < planes_per_eye; ++count) planes[count] = {0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  }
}

unsigned EyeFrusta::may_see(const QuarterBoxes& boxes, Questions asked, std::array<Questions, 4>& left) const {
  if (planes_.size() <= most_eyes * planes_per_eye) return ask_quarters(planes_.data(), boxes, asked, left.data());
  unsigned seen = 0;
  for (std::size_t first = 0; first < planes_.size(); first += planes_per_eye)
    seen |= ask_quarters(&planes_[first], boxes, of_an_eye, left.data());
  left.fill(asked);
  return seen;
}

}  // namespace seascape
