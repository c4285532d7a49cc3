#include "app/outside_camera.h"

#include <algorithm>
#include <cmath>

#include "app/camera_path.h"

namespace seascape {

namespace {

constexpr double farthest_m = 20.0;  // from one step to the next: beyond it is another place

// x'' = -2 w x' - w^2 x, solved exactly for a time: x is what is left to go.
template <class T>
void damp(T& left, T& velocity, double w, double dt_s) {
  const double decay = std::exp(-w * dt_s);
  const T push = velocity + w * left;
  left = (left + push * dt_s) * decay;
  velocity = (velocity - w * push * dt_s) * decay;
}

// (1 + w t) exp(-w t) is a tenth at w t = 3.89.
double frequency(double smooth_s) { return 3.89 / std::max(smooth_s, 1e-3); }

// Where the head looks along the water; a head that looks straight up or down looks where its crown or chin points.
double heading_deg(const glm::dquat& orientation) {
  const glm::dvec3 ahead = orientation * glm::dvec3(0.0, 0.0, -1.0), up = orientation * glm::dvec3(0.0, 1.0, 0.0);
  glm::dvec2 along(ahead.x, ahead.z);
  if (std::abs(ahead.y) > 0.98) along = (ahead.y > 0.0 ? -1.0 : 1.0) * glm::dvec2(up.x, up.z);
  return glm::degrees(std::atan2(along.x, -along.y));
}

}  // namespace

void OutsideCamera::step(const Pose& head, const OutsideCameraSettings& settings, double dt_s) {
  settings_ = settings;
  const double yaw_deg = heading_deg(head.orientation);
  if (!known_ || settings.smooth_s <= 0.0 || glm::distance(head.position_m, head_m_) > farthest_m) {
    known_ = true;
    head_m_ = head.position_m;
    yaw_deg_ = yaw_deg;
    velocity_mps_ = glm::dvec3(0.0);
    turning_deg_per_s_ = 0.0;
    return;
  }
  const double w = frequency(settings.smooth_s);
  glm::dvec3 left_m = head_m_ - head.position_m;
  damp(left_m, velocity_mps_, w, dt_s);
  head_m_ = head.position_m + left_m;
  double left_deg = std::remainder(yaw_deg_ - yaw_deg, 360.0);  // the shorter way round
  damp(left_deg, turning_deg_per_s_, w, dt_s);
  yaw_deg_ = yaw_deg + left_deg;
}

Pose OutsideCamera::pose(double water_m) const {
  const glm::dvec3 ahead = orientation_from_angles({yaw_deg_, 0.0, 0.0}) * glm::dvec3(0.0, 0.0, -1.0);
  glm::dvec3 at = head_m_ - settings_.distance_m * ahead + glm::dvec3(0.0, settings_.height_m, 0.0);
  at.y = std::max(at.y, water_m + clearance_m);
  const double pitch_deg = glm::degrees(std::atan2(head_m_.y - at.y, settings_.distance_m));
  return {at, orientation_from_angles({yaw_deg_, pitch_deg, 0.0})};
}

}  // namespace seascape
