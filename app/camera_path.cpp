#include "app/camera_path.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace seascape {

namespace {

// The rotation vector (rad) of a unit quaternion by the shorter way, and back.
glm::dvec3 rotation_vector(glm::dquat q) {
  if (q.w < 0.0) q = -q;
  const glm::dvec3 v(q.x, q.y, q.z);
  const double s = glm::length(v);
  return s < 1e-12 ? 2.0 * v : v * (2.0 * std::atan2(s, q.w) / s);
}

glm::dquat rotation(const glm::dvec3& vector) {
  const double angle = glm::length(vector);
  const double scale = angle < 1e-9 ? 0.5 : std::sin(0.5 * angle) / angle;
  return glm::normalize(glm::dquat(std::cos(0.5 * angle), vector.x * scale, vector.y * scale, vector.z * scale));
}

// The velocity at a key between two segments of mean velocities `before` and `after`: the parabola through the three
// keys, held to three times the slower of the two so that the curve never swings past a hold (the bound of Fritsch and
// Carlson 1980 for monotone cubics).
glm::dvec3 key_velocity(const glm::dvec3& before, double before_s, const glm::dvec3& after, double after_s) {
  const glm::dvec3 velocity = (before * after_s + after * before_s) / (before_s + after_s);
  const double most = 3.0 * std::min(glm::length(before), glm::length(after));
  const double size = glm::length(velocity);
  return size > most ? velocity * (most / size) : velocity;
}

// The same for a number: 0 at a turn, else the weighted harmonic mean (Fritsch and Butland 1984).
double key_rate(double before, double before_s, double after, double after_s) {
  if (before * after <= 0.0) return 0.0;
  const double w0 = 2.0 * after_s + before_s, w1 = after_s + 2.0 * before_s;
  return (w0 + w1) / (w0 / before + w1 / after);
}

// The same for positions, with the height monotone between keys: a path whose keys lie above the waves never dips
// between them.
glm::dvec3 key_motion(const glm::dvec3& before, double before_s, const glm::dvec3& after, double after_s) {
  const glm::dvec3 level = key_velocity({before.x, 0.0, before.z}, before_s, {after.x, 0.0, after.z}, after_s);
  return {level.x, key_rate(before.y, before_s, after.y, after_s), level.z};
}

struct Segment {
  const PathKey *from, *to;
  // Keys may be as near in time as doubles are; speeds between such are held to what can be squared.
  double duration() const { return std::max(to->time_s - from->time_s, 1e-12); }
  glm::dvec3 velocity() const { return (to->pose.position_m - from->pose.position_m) / duration(); }
  // rad/s about the axes of the head; with one turn a segment it is constant, so both ends' heads agree on it.
  glm::dvec3 turn() const {
    return rotation_vector(glm::conjugate(from->pose.orientation) * to->pose.orientation) / duration();
  }
  double rate() const { return (to->scene_time_s - from->scene_time_s) / duration(); }
};

}  // namespace

glm::dquat orientation_from_angles(const ViewAngles& angles) {
  const glm::dquat yaw = glm::angleAxis(glm::radians(-angles.yaw_deg), glm::dvec3(0.0, 1.0, 0.0));
  const glm::dquat pitch = glm::angleAxis(glm::radians(angles.pitch_deg), glm::dvec3(1.0, 0.0, 0.0));
  const glm::dquat roll = glm::angleAxis(glm::radians(-angles.roll_deg), glm::dvec3(0.0, 0.0, 1.0));
  return glm::normalize(yaw * pitch * roll);
}

ViewAngles angles_from_orientation(const glm::dquat& orientation) {
  const glm::dvec3 forward = orientation * glm::dvec3(0.0, 0.0, -1.0);
  const glm::dvec3 up = orientation * glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 right = orientation * glm::dvec3(1.0, 0.0, 0.0);
  ViewAngles angles;
  angles.pitch_deg = glm::degrees(std::asin(std::clamp(forward.y, -1.0, 1.0)));
  if (std::hypot(forward.x, forward.z) < 1e-9) {
    angles.yaw_deg = glm::degrees(std::atan2(right.z, right.x));  // straight up or down: the way of the right ear
  } else {
    angles.yaw_deg = glm::degrees(std::atan2(forward.x, -forward.z));
    angles.roll_deg = glm::degrees(std::atan2(-right.y, up.y));
  }
  return angles;
}

PathSample CameraPath::at(double time_s) const {
  if (keys.empty()) return {};
  const auto sample_of = [](const PathKey& key) { return PathSample{key.pose, key.scene_time_s}; };
  if (!(time_s > keys.front().time_s)) return sample_of(keys.front());
  if (time_s >= keys.back().time_s) return sample_of(keys.back());
  const auto after = std::upper_bound(keys.begin(), keys.end(), time_s,
                                      [](double time, const PathKey& key) { return time < key.time_s; });
  const Segment here{&*after - 1, &*after};
  if (time_s == here.from->time_s) return sample_of(*here.from);

  const double duration = here.duration(), s = (time_s - here.from->time_s) / duration;
  const glm::dvec3 velocity = here.velocity(), turn = here.turn();
  glm::dvec3 velocity0(0.0), velocity1(0.0), turn0(0.0), turn1(0.0);
  double rate0 = here.rate(), rate1 = here.rate();
  if (here.from != &keys.front()) {
    const Segment last{here.from - 1, here.from};
    velocity0 = key_motion(last.velocity(), last.duration(), velocity, duration);
    turn0 = key_velocity(last.turn(), last.duration(), turn, duration);
    rate0 = key_rate(last.rate(), last.duration(), here.rate(), duration);
  }
  if (here.to != &keys.back()) {
    const Segment next{here.to, here.to + 1};
    velocity1 = key_motion(velocity, duration, next.velocity(), next.duration());
    turn1 = key_velocity(turn, duration, next.turn(), next.duration());
    rate1 = key_rate(here.rate(), duration, next.rate(), next.duration());
  }

  PathSample sample;
  // Hermite's cubic in position, relative to the nearer key so that far from the origin nothing is lost.
  const glm::dvec3 step = velocity * duration, v0 = velocity0 * duration, v1 = velocity1 * duration;
  const double r = 1.0 - s;
  sample.pose.position_m = s < 0.5
                               ? here.from->pose.position_m + s * (s * (3.0 - 2.0 * s) * step + r * r * v0 - s * r * v1)
                               : here.to->pose.position_m + r * (-r * (3.0 - 2.0 * r) * step + r * s * v0 - s * s * v1);
  // Kim, Kim and Shin 1995, "A general construction scheme for unit quaternion curves with simple high order
  // derivatives": Bezier's cubic in its cumulative form, with the angular velocities of the keys at its ends.
  const glm::dvec3 w0 = turn0 * (duration / 3.0), w1 = turn1 * (duration / 3.0);
  const glm::dvec3 middle = rotation_vector(rotation(-w0) * rotation(turn * duration) * rotation(-w1));
  sample.pose.orientation = glm::normalize(here.from->pose.orientation * rotation(w0 * (1.0 - r * r * r)) *
                                           rotation(middle * (s * s * (3.0 - 2.0 * s))) * rotation(w1 * (s * s * s)));
  // Hermite's cubic around the straight line: a steady clock stays exact.
  const double bend0 = (rate0 - here.rate()) * duration, bend1 = (rate1 - here.rate()) * duration;
  sample.scene_time_s =
      here.from->scene_time_s + here.rate() * (time_s - here.from->time_s) + s * r * (r * bend0 - s * bend1);
  return sample;
}

}  // namespace seascape
