#include "ocean/bodies/helmsman.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/sea/state_hash.h"

namespace seascape {

namespace {

// Lengths ahead that he looks, and before a place that he turns.
constexpr double looks_ahead = 2.5, turns_before = 1.2;
// Of the helm for a radian off, and against a turn of one of her lengths a second: an estimate, damped well for boats
// whose turn follows their helm within a few lengths.
constexpr double helm_per_rad = 1.6, helm_per_turn = 1.2;

}  // namespace

Helmsman::Helmsman(std::vector<glm::dvec2> course, double length, const BoatControls& controls)
    : course_m_(std::move(course)), length_m_(length), controls_(controls) {}

BoatControls Helmsman::step(const BoatSpec& boat, const BodyState& state) {
  const glm::dvec2 here(state.motion.centre_m.x, state.motion.centre_m.z);
  const auto leg_from = [&] { return course_m_[(next_ + course_m_.size() - 1) % course_m_.size()]; };
  for (std::size_t n = 0; n < course_m_.size(); ++n) {
    const glm::dvec2 left = course_m_[next_] - here;
    const bool past = begun_ && glm::dot(left, course_m_[next_] - leg_from()) <= 0.0;
    if (glm::length(left) > turns_before * length_m_ && !past) break;
    next_ = (next_ + 1) % course_m_.size();
    begun_ = true;
  }
  glm::dvec2 aim = course_m_[next_] - here;
  if (const glm::dvec2 leg = course_m_[next_] - leg_from(); begun_ && glm::length(leg) > 1e-6) {
    const glm::dvec2 along = glm::normalize(leg);
    const double sailed = glm::dot(here - leg_from(), along);
    aim = leg_from() + along * std::min(sailed + looks_ahead * length_m_, glm::length(leg)) - here;
  }
  const glm::dvec3 ahead = state.motion.orientation * glm::dvec3(0.0, 0.0, -1.0);
  const double off = std::remainder(std::atan2(aim.x, -aim.y) - std::atan2(ahead.x, -ahead.z), 2.0 * std::numbers::pi);
  const double speed = std::max(glm::length(state.motion.velocity.linear), 0.5);
  // Clockwise from above, in radians a length that she sails.
  const double turns = -state.motion.velocity.angular.y * length_m_ / speed;
  const double helm = std::clamp(helm_per_rad * off - helm_per_turn * turns, -1.0, 1.0);
  BoatControls asks = controls_;
  asks.helm = helm;
  if (boat.engine || boat.oars.empty()) return asks;
  asks.oar_left = std::clamp(controls_.throttle * (1.0 + helm), -1.0, 1.0);
  asks.oar_right = std::clamp(controls_.throttle * (1.0 - helm), -1.0, 1.0);
  asks.throttle = 0.0;
  return asks;
}

std::uint64_t Helmsman::mixed_into(std::uint64_t hash) const {
  return mixed(mixed(hash, std::uint64_t(next_)), std::uint64_t(begun_));
}

}  // namespace seascape
