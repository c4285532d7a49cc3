#include "platform/xr_pose.h"

#include <cmath>

namespace seascape {

Pose pose_from(const XrPosef& pose) {
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  return {{p.x, p.y, p.z}, glm::normalize(glm::dquat(q.w, q.x, q.y, q.z))};
}

bool pose_is_sound(const XrPosef& pose) {
  const auto& p = pose.position;
  const auto& q = pose.orientation;
  const double length = std::sqrt(double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w);
  constexpr float far_m = 1e5f;
  return std::abs(p.x) < far_m && std::abs(p.y) < far_m && std::abs(p.z) < far_m &&
         std::abs(length - 1.0) < 0.01;  // as OpenXR has it
}

XrPosef xr_pose(const Pose& pose) {
  const glm::quat q(pose.orientation);
  const glm::vec3 p(pose.position_m);
  return {{q.x, q.y, q.z, q.w}, {p.x, p.y, p.z}};
}

}  // namespace seascape
