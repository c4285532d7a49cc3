#include "app/explore_camera.h"

#include <algorithm>
#include <cmath>

#include "app/camera_path.h"

namespace seascape {

namespace {

constexpr double response_per_s = 8.0;  // how fast the velocity follows the keys
constexpr double swim_response_per_s = 2.0;
constexpr double height_per_s = 4.0;  // how fast a change of travel comes to its height
constexpr double fast_factor = 5.0;
constexpr double notch_factor = 1.2, slowest_factor = 0.05, fastest_factor = 200.0;

// Metres per second at full push.
double base_speed(Travel travel) {
  switch (travel) {
    case Travel::fly:
      return 12.0;
    case Travel::walk:
      return 1.6;
    case Travel::ride:
      return 3.0;
  }
  return 0.0;
}

double wrapped_deg(double deg) {
  const double turned = std::remainder(deg, 360.0);
  return turned == 180.0 ? -180.0 : turned;
}

}  // namespace

const char* travel_name(Travel travel) {
  switch (travel) {
    case Travel::fly:
      return "fly";
    case Travel::walk:
      return "walk at deck height";
    case Travel::ride:
      return "ride the waves";
  }
  return "";
}

ExploreCamera::ExploreCamera(const Pose& start) : position_m_(start.position_m) {
  const ViewAngles angles = angles_from_orientation(start.orientation);
  yaw_deg_ = wrapped_deg(angles.yaw_deg);
  pitch_deg_ = std::clamp(angles.pitch_deg, -largest_pitch_deg, largest_pitch_deg);
}

double ExploreCamera::speed_mps() const { return base_speed(travel_) * speed_factor_; }

double ExploreCamera::rest_height(double water_m) const {
  return travel_ == Travel::walk ? deck_height_m : water_m + ride_height_m;
}

void ExploreCamera::set_travel(Travel travel) {
  travel_ = travel;
  height_known_ = false;
  climb_m_ = 0.0;
  if (travel != Travel::fly) velocity_mps_.y = 0.0;
}

void ExploreCamera::jump(const glm::dvec2& place_m, double water_m) {
  const double height_m = travel_ == Travel::fly ? water_m + deck_height_m : rest_height(water_m);
  position_m_ = {place_m.x, height_m, place_m.y};
  velocity_mps_ = glm::dvec3(0.0);
  height_above_rest_m_ = climb_m_ = 0.0;
  swims_head_m_.reset();
  dived_ = false;
}

// The height comes to a new one within about a second.
void ExploreCamera::come_to(double rest_m, double dt_s) {
  if (!height_known_) height_above_rest_m_ = position_m_.y - rest_m;
  height_known_ = true;
  height_above_rest_m_ *= std::exp(-height_per_s * dt_s);
  position_m_.y = rest_m + height_above_rest_m_;
}

void ExploreCamera::swim(const CameraWish& wish, double dt_s, double water_m) {
  const double head_m = wish.head ? wish.head->position_m.y : deck_height_m;
  const bool begins = !swims_head_m_;
  if (begins) {
    swims_head_m_ = head_m;
    flown_at_m_ = position_m_.y + climb_m_;
    climb_m_ = 0.0;
    height_known_ = false;
  }
  // He dives where the water may be dived into, and then stays under it until he comes up to it again.
  const double eyes_m = position_m_.y + head_m - deck_height_m;
  if (!wish.dives_to_m) dived_ = false;
  if (wish.dives_to_m && (wish.move.y < -0.5 || (begins && eyes_m < water_m))) dived_ = true;
  if (dived_) return swim_under(wish, dt_s, water_m);
  const glm::dvec3 &moved = wish.swum->moved_m, &v = wish.swum->velocity_mps;
  position_m_ += glm::dvec3(moved.x, 0.0, moved.z);
  velocity_mps_ = {v.x, 0.0, v.z};
  come_to(water_m + swim_height_m + deck_height_m - *swims_head_m_, dt_s);
  position_m_.y = std::max(position_m_.y, water_m + swim_clearance_m + deck_height_m - head_m);
}

void ExploreCamera::swim_under(const CameraWish& wish, double dt_s, double water_m) {
  const double head_m = wish.head ? wish.head->position_m.y - deck_height_m : 0.0;  // above the camera
  const double rises_mps = dives_mps * std::clamp(wish.move.y, -1.0, 1.0);
  position_m_ += wish.swum->moved_m + glm::dvec3(0.0, rises_mps * dt_s, 0.0);
  velocity_mps_ = wish.swum->velocity_mps + glm::dvec3(0.0, rises_mps, 0.0);
  position_m_.y = std::max(position_m_.y, *wish.dives_to_m + clearance_m - head_m);
  flown_at_m_ = position_m_.y;  // who lets go stays where he is
  if (position_m_.y + head_m < water_m + swim_height_m || velocity_mps_.y < 0.0) return;
  dived_ = height_known_ = false;  // up again: he floats as high as he is, and comes to his own height
  swims_head_m_ = head_m + deck_height_m;
}

void ExploreCamera::step(const CameraWish& wish, double dt_s, double water_m) {
  speed_factor_ =
      std::clamp(speed_factor_ * std::pow(notch_factor, wish.faster_notches), slowest_factor, fastest_factor);
  if (wish.head) {  // the head stays where it is while all turns about it
    const auto place = [&](double yaw_deg) {
      return orientation_from_angles({yaw_deg, 0.0, 0.0}) *
             glm::dvec3(wish.head->position_m.x, 0.0, wish.head->position_m.z);
    };
    position_m_ += place(yaw_deg_) - place(yaw_deg_ + wish.turn_deg.x);
  }
  yaw_deg_ = wrapped_deg(yaw_deg_ + wish.turn_deg.x);
  pitch_deg_ = std::clamp(pitch_deg_ + wish.turn_deg.y, -largest_pitch_deg, largest_pitch_deg);

  if (wish.swum) return swim(wish, dt_s, water_m);
  if (swims_head_m_) {  // out of the water again
    swims_head_m_.reset();
    height_known_ = dived_ = false;
    if (travel_ == Travel::fly) climb_m_ = flown_at_m_ - position_m_.y;
  }

  // Where the keys push: along the view when flying, along the sea else. Two keys together are no faster than one.
  const bool flying = travel_ == Travel::fly;
  ViewAngles look{yaw_deg_, pitch_deg_, 0.0};
  if (wish.head) look = angles_from_orientation(carrier().orientation * wish.head->orientation);
  const glm::dquat along = orientation_from_angles({look.yaw_deg, flying ? look.pitch_deg : 0.0, 0.0});
  glm::dvec3 push = along * glm::dvec3(wish.move.x, 0.0, -wish.move.z);
  if (flying) push.y += wish.move.y;
  if (const double length = glm::length(push); length > 1.0) push /= length;
  const double head_m = wish.head ? wish.head->position_m.y - deck_height_m : 0.0;  // above the camera
  // Under water flying is swimming: slower, and slower to come to its speed.
  const bool under = flying && wish.dives_to_m && position_m_.y + head_m < water_m;
  const double full_mps = under ? under_water_mps * speed_factor_ : speed_mps(),
               response = under ? swim_response_per_s : response_per_s;
  const glm::dvec3 wanted = push * (full_mps * (wish.fast ? fast_factor : 1.0));

  // dv/dt = (wanted - v) response, solved exactly: the velocity and its integral over the step.
  const double decay = std::exp(-response * dt_s);
  const glm::dvec3 lag = velocity_mps_ - wanted;
  position_m_ += wanted * dt_s + lag * ((1.0 - decay) / response);
  velocity_mps_ = wanted + lag * decay;

  if (flying) {
    const double climbed_m = -climb_m_ * std::expm1(-height_per_s * dt_s);
    position_m_.y += climbed_m;
    climb_m_ -= climbed_m;
  } else {
    come_to(rest_height(wish.ridden_m.value_or(water_m)), dt_s);
  }
  const double least_m = (flying ? wish.dives_to_m.value_or(water_m) : water_m) +
                         (flying && climb_m_ > 0.01 ? swim_clearance_m : clearance_m) - head_m;
  held_ = position_m_.y < least_m;
  position_m_.y = std::max(position_m_.y, least_m);
  if (held_) velocity_mps_.y = std::max(velocity_mps_.y, 0.0);
}

Pose ExploreCamera::carrier() const {
  return {position_m_ - glm::dvec3(0.0, deck_height_m, 0.0), orientation_from_angles({yaw_deg_, 0.0, 0.0})};
}

Pose ExploreCamera::pose() const { return {position_m_, orientation_from_angles({yaw_deg_, pitch_deg_, 0.0})}; }

}  // namespace seascape
