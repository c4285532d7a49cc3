#include "engine/view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace seascape {

Pose composed(const Pose& from, const Pose& pose) {
  return {from.position_m + from.orientation * pose.position_m, glm::normalize(from.orientation * pose.orientation)};
}

Pose inverse(const Pose& pose) {
  const glm::dquat back = glm::conjugate(pose.orientation);
  return {back * -pose.position_m, back};
}

glm::dquat heading(const glm::dquat& orientation) {
  const glm::dvec3 ahead = orientation * glm::dvec3(0.0, 0.0, -1.0), right = orientation * glm::dvec3(1.0, 0.0, 0.0);
  const double yaw =
      std::hypot(ahead.x, ahead.z) > 1e-3 ? std::atan2(-ahead.x, -ahead.z) : std::atan2(-right.z, right.x);
  return glm::angleAxis(yaw, glm::dvec3(0.0, 1.0, 0.0));
}

Fov symmetric_fov(double vertical_deg, double aspect) {
  const double t = std::tan(glm::radians(vertical_deg) * 0.5);
  return {-t * aspect, t * aspect, t, -t};
}

std::vector<View> stereo_views(const Pose& head, const Fov& fov, double eye_distance_m) {
  const glm::dvec3 right = head.orientation * glm::dvec3(1.0, 0.0, 0.0);
  View left{head, fov}, right_eye{head, fov};
  left.pose.position_m -= right * (0.5 * eye_distance_m);
  right_eye.pose.position_m += right * (0.5 * eye_distance_m);
  return {left, right_eye};
}

double pixels_per_radian(const std::vector<View>& eyes, double height_px) {
  double most = 0.0;
  for (const View& eye : eyes) most = std::max(most, height_px / (eye.fov.up - eye.fov.down));
  return most;
}

glm::dmat4 projection(const Fov& fov, double near_m) {
  const double width = fov.right - fov.left, height = fov.up - fov.down;
  glm::dmat4 m(0.0);
  m[0][0] = 2.0 / width;
  m[1][1] = -2.0 / height;
  m[2][0] = (fov.right + fov.left) / width;
  m[2][1] = -(fov.up + fov.down) / height;
  m[2][3] = -1.0;
  m[3][2] = near_m;
  return m;
}

glm::dmat4 eye_from_relative(const Pose& eye, const glm::dvec3& origin_m) {
  const glm::dmat3 rotation = glm::mat3_cast(glm::conjugate(eye.orientation));
  glm::dmat4 m(rotation);
  m[3] = glm::dvec4(-(rotation * (eye.position_m - origin_m)), 1.0);
  return m;
}

}  // namespace seascape
