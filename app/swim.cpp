#include "app/swim.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace seascape {

namespace {

constexpr double longest_step_s = 10.0;  // he has settled by then
constexpr double short_step_s = 0.004;
constexpr double response_per_s = 2.0;  // without hands: how fast he comes to his own speed

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// (exp(-z) - 1) / -z and ((1 - z) - exp(-z)) / -z^2: what an exponential step takes of a velocity and of a change.
double first(double z) { return z < 1e-6 ? 1.0 - 0.5 * z : -std::expm1(-z) / z; }
double second(double z) { return z < 1e-4 ? 0.5 - z / 6.0 : (std::expm1(-z) + z) / (z * z); }

}  // namespace

void Swim::begin_anew(const glm::dvec3& velocity_mps) {
  velocity_mps_ = is_finite(velocity_mps) ? velocity_mps : glm::dvec3(0.0);
  moved_m_ = glm::dvec3(0.0);
}

void Swim::pull(const SwimWish& wish, double dt_s) {
  const double ahead_mps = glm::dot(velocity_mps_, wish.ahead), speed_mps = glm::length(velocity_mps_);
  const glm::dvec3 across_mps = velocity_mps_ - ahead_mps * wish.ahead;
  // Accelerations, and how they fall with the speed: never the other way, so that each step settles.
  double push = 0.0, falls = 0.0;
  for (const auto& hand : wish.hands) {
    if (!hand || !is_finite(hand->velocity_mps) || glm::length(hand->velocity_mps) > fastest_hand_mps) continue;
    const double wet = hand->under_water > 0.0 ? std::min(hand->under_water, 1.0) : 0.0,
                 back_mps = -glm::dot(hand->velocity_mps, wish.ahead);
    const double through_mps = back_mps > 0.0 ? std::max(0.0, back_mps - ahead_mps) : 0.0;
    push += hand_kg_m / mass_kg * wet * through_mps * through_mps;
    falls += 2.0 * hand_kg_m / mass_kg * wet * through_mps;
  }
  const double drag = drag_kg_m / mass_kg * speed_mps;
  // Of a velocity and its acceleration: what is moved, and the velocity then.
  const auto go = [&](auto mps, auto acceleration, double rate) {
    const double z = rate * dt_s;
    return std::pair(mps * dt_s + acceleration * (dt_s * dt_s * second(z)), mps + acceleration * (dt_s * first(z)));
  };
  const auto [moved_ahead, now_ahead] = go(ahead_mps, push - drag * ahead_mps, falls + 2.0 * drag);
  const auto [moved_across, now_across] = go(across_mps, -drag * across_mps, 2.0 * drag);
  velocity_mps_ = now_ahead * wish.ahead + now_across;
  moved_m_ += moved_ahead * wish.ahead + moved_across;
}

void Swim::step(const SwimWish& wish, double dt_s) {
  moved_m_ = glm::dvec3(0.0);
  if (!(dt_s > 0.0) || !is_finite(wish.ahead)) return;
  dt_s = std::min(dt_s, longest_step_s);
  if (!wish.tracked) {  // dv/dt = (wanted - v) response, solved exactly
    const glm::dvec3 wanted = own_speed_mps * wish.ahead, lag = velocity_mps_ - wanted;
    const double gone = -std::expm1(-response_per_s * dt_s);
    moved_m_ = wanted * dt_s + lag * (gone / response_per_s);
    velocity_mps_ = wanted + lag * (1.0 - gone);
    return;
  }
  const int steps = std::max(1, int(std::ceil(dt_s / short_step_s)));
  for (int n = 0; n < steps; ++n) pull(wish, dt_s / steps);
}

}  // namespace seascape
