#include "ocean/lod/culling.h"

#include <algorithm>
#include <cmath>

namespace seascape {

void EyeFrusta::set(const std::vector<View>& eyes, const glm::dvec3& origin_m) {
  eyes_.resize(eyes.size());
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    const Fov& fov = eyes[e].fov;
    // A point (x, y, z) of eye space is inside while left * -z <= x <= right * -z, likewise for y, and z <= 0.
    const std::array<glm::dvec3, planes_per_eye> normals{
        glm::dvec3(1.0, 0.0, fov.left), glm::dvec3(-1.0, 0.0, -fov.right), glm::dvec3(0.0, -1.0, -fov.up),
        glm::dvec3(0.0, 1.0, fov.down), glm::dvec3(0.0, 0.0, -1.0)};
    Eye& eye = eyes_[e];
    eye.position = eyes[e].pose.position_m - origin_m;
    const glm::dmat3 rotation = glm::mat3_cast(eyes[e].pose.orientation);
    for (std::size_t p = 0; p < planes_per_eye; ++p) {
      const glm::dvec3 normal = rotation * normals[p];
      eye.planes[p] = {normal, -glm::dot(normal, eye.position)};
    }
    eye.all_up = eye.all_down = glm::bvec3(true);
    for (const double x : {fov.left, fov.right})
      for (const double y : {fov.down, fov.up}) {
        const glm::dvec3 ray = rotation * glm::dvec3(x, y, -1.0);
        for (int axis = 0; axis < 3; ++axis) {
          if (ray[axis] < 0.0) eye.all_up[axis] = false;
          if (ray[axis] > 0.0) eye.all_down[axis] = false;
        }
      }
  }
}

bool EyeFrusta::Eye::may_see_span(const glm::dvec3& low, const glm::dvec3& high) const {
  for (int axis = 0; axis < 3; ++axis)
    if ((all_up[axis] && high[axis] < position[axis]) || (all_down[axis] && low[axis] > position[axis])) return false;
  return true;
}

bool EyeFrusta::may_see_box(const glm::dvec3& centre_m, const glm::dvec3& half_m) const {
  if (eyes_.empty()) return true;
  for (const Eye& eye : eyes_) {
    bool seen = eye.may_see_span(centre_m - half_m, centre_m + half_m);
    for (std::size_t p = 0; seen && p < planes_per_eye; ++p) {
      const Plane& plane = eye.planes[p];
      const glm::dvec3& n = plane.normal;
      const double reach = std::abs(n.x) * half_m.x + std::abs(n.y) * half_m.y + std::abs(n.z) * half_m.z;
      if (glm::dot(n, centre_m) + plane.offset + reach < 0.0) seen = false;
    }
    if (seen) return true;
  }
  return false;
}

bool EyeFrusta::may_see_prism(const std::array<glm::dvec2, 4>& corners_m, double grow_m, double low_m,
                              double high_m) const {
  if (eyes_.empty()) return true;
  glm::dvec2 least = corners_m[0], greatest = corners_m[0];
  for (const glm::dvec2& corner : corners_m) {
    least = glm::min(least, corner);
    greatest = glm::max(greatest, corner);
  }
  for (const Eye& eye : eyes_) {
    bool seen = eye.may_see_span({least.x - grow_m, low_m, least.y - grow_m}, {greatest.x + grow_m, high_m, greatest.y + grow_m});
    for (std::size_t p = 0; seen && p < planes_per_eye; ++p) {
      const Plane& plane = eye.planes[p];
      const glm::dvec3& n = plane.normal;
      double most = n.x * corners_m[0].x + n.z * corners_m[0].y;
      for (std::size_t c = 1; c < 4; ++c) most = std::max(most, n.x * corners_m[c].x + n.z * corners_m[c].y);
      most += (std::abs(n.x) + std::abs(n.z)) * grow_m + std::max(n.y * low_m, n.y * high_m);
      if (most + plane.offset < 0.0) seen = false;
    }
    if (seen) return true;
  }
  return false;
}

}  // namespace seascape
