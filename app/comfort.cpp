#include "app/comfort.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "app/camera_path.h"

namespace seascape {

namespace {

// Heave is what is quicker than this: of waves of 10 s, the slowest that sicken, a fifth stays in the slow part.
constexpr double heave_period_s = 20.0;
constexpr double longest_step_s = 1e9;
constexpr double stick_pushed = 0.7, stick_let_go = 0.3;

double step_s(double dt_s) { return dt_s > 0.0 ? std::min(dt_s, longest_step_s) : 0.0; }  // 0 for what is no number

bool is_finite(const Pose& pose) {
  const glm::dvec3& p = pose.position_m;
  const glm::dquat& q = pose.orientation;
  return std::isfinite(p.x + p.y + p.z) && std::isfinite(q.x + q.y + q.z + q.w);
}

// How far the vignette closes in the end. Moving and turning at once is more than either.
double wanted_closed(const ComfortSettings& settings, const ComfortMotion& motion) {
  if (!settings.on || !settings.vignette) return 0.0;
  const glm::dvec3& v = motion.velocity_mps;
  const double mps = std::hypot(std::hypot(v.x, v.y), v.z);  // of three numbers it makes nothing of infinity
  const double amount = std::hypot(mps / settings.vignette_mps, motion.turn_deg_per_s / settings.vignette_deg_per_s);
  return std::isnan(amount) ? 0.0 : std::min(amount, 1.0);
}

}  // namespace

double SlowHeight::step(double height_m, double period_s, double dt_s) {
  if (!std::isfinite(height_m)) return slow_m_;
  const double dt = step_s(dt_s), change = height_m - height_m_;
  if (!known_ || period_s <= 0.0) {
    slow_m_ = height_m;
    slow_mps_ = 0.0;
  } else if (dt > 0.0) {
    // x'' + 2 w x' + w^2 x = w^2 u with u even between its two values. With z = w dt, E = exp(-z), and x and v before:
    // x -> u1 - change (2 (1 - E) / z - E) + (x - u0)(1 + z) E + v dt E
    // v -> change w (1 - E - z E) / z + (v (1 - z) - (x - u0) w z) E
    const double w = glm::two_pi<double>() / period_s, z = w * dt, decay = std::exp(-z);
    const double off = slow_m_ - height_m_;
    const double gone = -std::expm1(-z);
    slow_m_ = height_m - change * (2.0 * gone / z - decay) + (off * (1.0 + z) + slow_mps_ * dt) * decay;
    slow_mps_ = change * w * (gone - z * decay) / z + (slow_mps_ * (1.0 - z) - off * w * z) * decay;
  }
  known_ = true;
  height_m_ = height_m;
  return slow_m_;
}

void Comfort::step(const ComfortSettings& settings, const ComfortMotion& motion, double dt_s) {
  const double dt = step_s(dt_s), wanted = wanted_closed(settings, motion);
  // d closed / dt = (wanted - closed) / vignette_s. Switched off, it is open at once.
  if (!settings.on || !settings.vignette || settings.vignette_s <= 0.0)
    closed_ = wanted;
  else
    closed_ -= (wanted - closed_) * std::expm1(-dt / settings.vignette_s);

  // By the angle's reciprocal it comes in from behind the viewer, and ever slower.
  shown_.clear_deg = std::min(360.0, settings.vignette_deg / std::max(closed_, 1e-9));
  shown_.soft_deg = settings.vignette_soft_deg;

  if (!motion.carrier) {
    carrier_.reset();
    deck_ = {};
  } else if (is_finite(*motion.carrier)) {
    Pose deck = *motion.carrier;
    const double slow_m = deck_.step(deck.position_m.y, heave_period_s, dt);
    if (settings.on) {
      const double tilt = 1.0 - settings.horizon_lock;
      ViewAngles angles = angles_from_orientation(deck.orientation);
      angles.pitch_deg *= tilt;
      angles.roll_deg *= tilt * settings.roll;
      deck.orientation = orientation_from_angles(angles);
      deck.position_m.y -= (1.0 - settings.heave) * (deck.position_m.y - slow_m);
    }
    carrier_ = deck;
  }
  shown_.horizon_line = settings.on && (settings.horizon_line == HorizonLine::always ||
                                        (settings.horizon_line == HorizonLine::carried && carrier_));
}

double Comfort::ridden_m(const ComfortSettings& settings, double water_m, double dt_s) {
  const double calm_m = water_.step(water_m, settings.small_waves_s, dt_s);
  return settings.on ? calm_m : water_m;
}

double Comfort::turned_deg(const ComfortSettings& settings, double stick, double dt_s) {
  if (std::isnan(stick)) return 0.0;
  stick = std::clamp(stick, -1.0, 1.0);
  if (stick * pushed_ < stick_let_go) pushed_ = 0.0;
  if (!settings.on || settings.snap_turn_deg == 0) return stick * settings.turn_deg_per_s * step_s(dt_s);
  if (pushed_ != 0.0 || std::abs(stick) < stick_pushed) return 0.0;
  pushed_ = std::copysign(1.0, stick);
  return pushed_ * settings.snap_turn_deg;
}

}  // namespace seascape
