#include "ocean/bodies/body_events.h"

#include <algorithm>

namespace seascape {

std::string_view name_of(BodyEventKind kind) {
  constexpr std::string_view names[] = {"in", "out", "slam", "ground", "hit", "capsize", "swamped", "parted", "drags"};
  return names[std::size_t(kind)];
}

// It goes on while the value stays over its second limit, and for the quiet time after that.
bool BodyEvents::begins(Pulse& pulse, double time_s, double value, double limit, double over) const {
  if (value > over) {
    const bool first = !pulse.on && value >= limit;
    pulse.on = pulse.on || first;
    if (pulse.on) pulse.last_s = time_s;
    return first;
  }
  if (pulse.on && time_s - pulse.last_s >= settings_.quiet_s) pulse.on = false;
  return false;
}

BodyEvents::Followed BodyEvents::begin(const Bodies& bodies, std::size_t n) const {
  const BodyState& state = bodies.result()[n];
  const BodySpec& spec = bodies.spec(n);
  Followed out;
  out.displaces_m3 =
      std::min(spec.mass.mass_kg / bodies.settings().media.density_kg_m3, volume_of(*spec.hull).volume_m3);
  out.wet = state.submerged_m3 > settings_.in_share * out.displaces_m3;
  out.capsized = (state.motion.orientation * glm::dvec3(0.0, 1.0, 0.0)).y < settings_.capsize_up;
  out.swamped = state.filled_m3 > 0.0 && state.filled_m3 >= settings_.swamped_share * bodies.inside_m3(n);
  out.falls_mps = -state.motion.velocity.linear.y;
  return out;
}

void BodyEvents::follow(double time_s, const Bodies& bodies, std::vector<BodyEvent>& events) {
  const std::size_t count = bodies.result().size();
  const bool anew = followed_.size() != count || time_s < time_s_;
  time_s_ = time_s;
  if (anew) {
    followed_.clear();
    for (std::size_t n = 0; n < count; ++n) followed_.push_back(begin(bodies, n));
    return;
  }
  for (std::size_t n = 0; n < count; ++n) {
    Followed& f = followed_[n];
    const BodyState& state = bodies.result()[n];
    if (state.asleep) {  // as it was, for as long as it sleeps
      for (Pulse* pulse : {&f.slam, &f.hit, &f.ground}) pulse->last_s = time_s;
      continue;
    }
    const auto tell = [&](BodyEventKind kind, double strength) { events.push_back({time_s, n, kind, strength}); };
    // `on` goes on at the first limit and off at the second; true where it goes on.
    const auto latches = [](bool& on, bool first, bool second) {
      const bool begins = !on && first;
      on = on ? !second : first;
      return begins;
    };
    const double share = state.submerged_m3 / f.displaces_m3;
    const bool was_wet = f.wet;
    if (latches(f.wet, share > settings_.in_share, share < settings_.out_share))
      tell(BodyEventKind::in, std::max(f.falls_mps, 0.0));
    if (was_wet && !f.wet) tell(BodyEventKind::out, 0.0);
    const double kg = bodies.spec(n).mass.mass_kg;
    if (begins(f.slam, time_s, state.slam_mps, settings_.slam_mps, settings_.slam_over_mps))
      tell(BodyEventKind::slam, state.slam_mps);
    const double ground = state.contact.ground_ns / kg, hit = state.contact.hit_ns / kg;
    if (begins(f.ground, time_s, ground, settings_.ground_mps, settings_.ground_over_mps))
      tell(BodyEventKind::ground, ground);
    if (begins(f.hit, time_s, hit, settings_.hit_mps, settings_.hit_over_mps)) tell(BodyEventKind::hit, hit);
    const double up = (state.motion.orientation * glm::dvec3(0.0, 1.0, 0.0)).y;
    if (latches(f.capsized, up<settings_.capsize_up, up> settings_.righted_up)) tell(BodyEventKind::capsize, 0.0);
    const double inside = bodies.inside_m3(n), full = inside > 0.0 ? state.filled_m3 / inside : 0.0;
    if (latches(f.swamped, full >= settings_.swamped_share, full <= settings_.bailed_share))
      tell(BodyEventKind::swamped, 0.0);
    f.falls_mps = -state.motion.velocity.linear.y;
  }
}

}  // namespace seascape
