#include "ocean/bodies/boat.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/sea/state_hash.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double engine_s = 0.8;       // in which its turns follow the throttle, but for 1/e
constexpr double helm_per_s = 1.2;     // of its range
constexpr double strokes_per_s = 0.5;  // of oars
// A stroke's ends ahead and astern of square, and what an arm bears on the blade: 60 N a side on average, with half of
// the time under water, are about 100 W at 2.5 knots (facts of rowing boats: 100 W, 2.5 to 3 knots).
constexpr double blade_breadth_m = 0.14;
constexpr double catch_rad = 0.75, release_rad = -0.6, most_oar_n = 110.0;

// How sails are seen to follow the wind, which drives them at once: a boom swings over in a second, and cloth fills or
// spills its wind in a quarter. From so far off its place a boom swings slack.
constexpr double boom_rad_s = 2.0, fills_per_s = 4.0, swings_slack_rad = 0.4;

glm::dvec3 velocity_of(const BodyState& state, const glm::dvec3& world_m) {
  const Vector6& v = state.motion.velocity;
  return v.linear + glm::cross(v.angular, world_m - state.motion.centre_m);
}

double within(double value, double least) { return std::isfinite(value) ? std::clamp(value, least, 1.0) : 0.0; }

}  // namespace

// Her body in a step, and what it asks of the water.
struct Boat::Hull {
  Bodies& bodies;
  std::size_t n;
  const BodyWater& water;
  const HullMedia& media;
  double end_s;
  const BodyState& state;
  glm::dmat3 to_world;
  double jet_mps = 0.0;  // what the propeller adds to the water behind it
  glm::dvec3 jet_from_m{0.0};

  glm::dvec3 world(const glm::dvec3& at_m) const { return state.at_m + to_world * at_m; }
  glm::dvec3 velocity(const glm::dvec3& world_m) const { return velocity_of(state, world_m); }
  void push(const glm::dvec3& force_n, const glm::dvec3& at_m) {
    const glm::dvec3 force = to_world * force_n;
    bodies.resist(n, {force, glm::cross(world(at_m) - state.motion.centre_m, force)});
  }
};

void Boat::ask(const BoatControls& controls) {
  asked_ = {within(controls.throttle, -1.0), within(controls.helm, -1.0), within(controls.sheet, 0.0),
            within(controls.oar_left, -1.0), within(controls.oar_right, -1.0)};
}

void Boat::step(Bodies& bodies, std::size_t n, const BodyWater& water, const HullMedia& media, double end_s,
                double dt_s) {
  const BodyState& state = bodies.result()[n];
  blade_count_ = 0;
  parts_.thrust_n = 0.0;
  if (state.lost) return;
  Hull hull{bodies, n, water, media, end_s, state, glm::mat3_cast(state.motion.orientation)};
  if (asked_.throttle != 0.0 || asked_.oar_left != 0.0 || asked_.oar_right != 0.0) bodies.wake(n);
  if (!spec_.sails.empty() && media.wind_mps != glm::dvec3(0.0)) bodies.wake(n);
  if (state.asleep) return;
  const double most = helm_per_s * dt_s;
  parts_.helm += std::clamp(asked_.helm - parts_.helm, -most, most);
  if (spec_.engine) drive(hull, dt_s);
  if (spec_.rudder) steer(hull);
  if (!spec_.sails.empty()) sail(hull, dt_s);
  for (const BoatOar& oar : spec_.oars) row(hull, oar, dt_s);
}

Boat::Flow Boat::flow_at(const Hull& hull, const glm::dvec3& at, double half_m) const {
  const glm::dvec3 world = hull.world(at);
  const glm::dvec2 place(world.x, world.z);
  WaterHere here;
  hull.water.ask_as(hull.n, hull.end_s, 2.0 * half_m, {&place, 1}, {&here, 1});
  Flow flow;
  flow.wet = here.dry ? 0.0 : std::clamp(0.5 + 0.5 * (here.height_m - world.y) / half_m, 0.0, 1.0);
  flow.water = glm::transpose(hull.to_world) * (here.velocity_mps - hull.velocity(world));
  return flow;
}

// The water comes to the propeller as to the boat: no wake fraction and no thrust deduction, which about cancel.
void Boat::drive(Hull& hull, double dt) {
  const BoatEngine& engine = *spec_.engine;
  const double diameter = engine.propeller.diameter_m;
  const Flow flow = flow_at(hull, engine.at_m, 0.5 * diameter);
  const double turned = parts_.helm * engine.most_turn_rad;
  const glm::dvec3 aft(std::sin(turned), 0.0, std::cos(turned));
  const double past = glm::dot(flow.water, aft);
  const double wants = asked_.throttle * engine.most_turns_per_s;
  parts_.turns_per_s += (wants - parts_.turns_per_s) * (1.0 - std::exp(-dt / engine_s));
  if (std::abs(parts_.turns_per_s) < 1e-6 && wants == 0.0) parts_.turns_per_s = 0.0;
  PropellerForce force = propeller(engine.propeller, past, parts_.turns_per_s);
  // Power goes with the cube of the turns: an engine that cannot give it turns slower.
  const double power = 2.0 * pi * force.torque_nm * parts_.turns_per_s * flow.wet;
  if (power > engine.most_power_w) {
    parts_.turns_per_s *= std::cbrt(engine.most_power_w / power);
    force = propeller(engine.propeller, past, parts_.turns_per_s);
  }
  parts_.propeller_rad = std::remainder(parts_.propeller_rad + 2.0 * pi * parts_.turns_per_s * dt, 2.0 * pi);
  const double thrust = force.thrust_n * flow.wet;
  hull.push(-thrust * aft, engine.at_m);
  parts_.thrust_n = thrust;
  // Far behind its disc the water runs faster by (V + w)^2 = V^2 + 2 T / (rho A) (Rankine 1865, Froude 1889).
  const double disc = 0.25 * pi * diameter * diameter, v = std::max(past, 0.0);
  if (thrust > 0.0) hull.jet_mps = std::sqrt(v * v + 2.0 * thrust / (hull.media.density_kg_m3 * disc)) - v;
  hull.jet_from_m = engine.at_m;
}

void Boat::steer(Hull& hull) {
  const BoatRudder& rudder = *spec_.rudder;
  const Flow flow = flow_at(hull, rudder.at_m, 0.5 * std::sqrt(rudder.area_m2 * rudder.aspect));
  const double angle = parts_.helm * rudder.most_rad;
  const glm::dvec3 aft(std::sin(angle), 0.0, std::cos(angle)), across(std::cos(angle), 0.0, -std::sin(angle));
  const auto force_in = [&](const glm::dvec3& water) {
    const double met = std::atan2(glm::dot(water, across), glm::dot(water, aft));
    return rudder_force(rudder.area_m2, rudder.aspect, met, std::hypot(water.x, water.z), hull.media.density_kg_m3);
  };
  // As much of the blade's height as the jet has stands in it.
  const double behind = rudder.at_m.z - hull.jet_from_m.z, span = std::sqrt(rudder.area_m2 * rudder.aspect);
  double in_jet = 0.0;
  if (hull.jet_mps > 0.0 && behind > 0.0 && behind < 4.0 * span)
    in_jet = std::min(1.0, spec_.engine->propeller.diameter_m / span);
  const double force =
      (1.0 - in_jet) * force_in(flow.water) + in_jet * force_in(flow.water + glm::dvec3(0.0, 0.0, hull.jet_mps));
  hull.push(flow.wet * force * across, rudder.at_m);
}

// Wind as it is in her own plane, so that a sail that heels has less of it.
SailForce Boat::wind_in(const BoatSail& one, const BodyState& state, const HullMedia& media) const {
  const glm::dmat3 to_world = glm::mat3_cast(state.motion.orientation);
  const glm::dvec3 world = state.at_m + to_world * one.centre_m;
  // Over the sea wind grows with height to the power of 0.11 (Hsu, Meindl and Gilhousen 1994), from 10 m.
  const double taller = std::pow(std::max(world.y, 1.0) / 10.0, 0.11);
  const glm::dvec3 wind = glm::transpose(to_world) * (taller * media.wind_mps - velocity_of(state, world));
  return seascape::sail(one.sail, std::atan2(-wind.x, wind.z), std::hypot(wind.x, wind.z), asked_.sheet);
}

void Boat::trim(const BodyState& state, const HullMedia& media) {
  for (std::size_t i = 0; i < std::min(spec_.sails.size(), parts_.boom_rad.size()); ++i) {
    const SailForce force = wind_in(spec_.sails[i], state, media);
    parts_.boom_rad[i] = force.boom_rad, parts_.luffing[i] = force.luffing;
  }
}

void Boat::sail(Hull& hull, double dt) {
  for (std::size_t i = 0; i < spec_.sails.size(); ++i) {
    const BoatSail& one = spec_.sails[i];
    const SailForce force = wind_in(one, hull.state, hull.media);
    if (i < parts_.boom_rad.size()) {
      const auto follow = [](double& value, double to, double most) { value += std::clamp(to - value, -most, most); };
      // A sail that swings over has no wind in it.
      const double swings = std::min(std::abs(force.boom_rad - parts_.boom_rad[i]) / swings_slack_rad, 1.0);
      follow(parts_.luffing[i], std::max(force.luffing, swings), fills_per_s * dt);
      follow(parts_.boom_rad[i], force.boom_rad, boom_rad_s * dt);
    }
    if (hull.world(one.centre_m).y < 0.0) continue;  // in the water
    hull.push({force.force_n.y, 0.0, -force.force_n.x}, one.centre_m);
  }
}

// A blade is dipped for one half of a stroke, drawn astern, and comes back over the water in the other. The rower's
// strength bounds what it does.
void Boat::row(Hull& hull, const BoatOar& oar, double dt) {
  const std::size_t side = oar.to_port ? 0 : 1;
  const double pull = oar.to_port ? asked_.oar_left : asked_.oar_right;
  double& phase = parts_.oar_phase[side];
  const double before = parts_.oar_ahead[side];
  const auto ahead_at = [](double turn) {
    return 0.5 * (catch_rad + release_rad) + 0.5 * (catch_rad - release_rad) * std::cos(2.0 * pi * turn);
  };
  if (std::abs(pull) < 0.02) {  // held out of the water, square
    phase = 0.0;
    parts_.oar_in_water[side] = false;
    parts_.oar_ahead[side] = before - std::clamp(before, -2.0 * dt, 2.0 * dt);
    return;
  }
  const double rate = strokes_per_s * (0.5 + 0.5 * std::abs(pull));
  phase = phase + rate * dt;
  phase -= std::floor(phase);
  const double now = pull > 0.0 ? ahead_at(phase) : ahead_at(0.5 - phase);
  parts_.oar_ahead[side] = now;
  parts_.oar_in_water[side] = phase < 0.5;
  if (phase >= 0.5) return;
  const double out = oar.to_port ? -1.0 : 1.0;
  const glm::dvec3 arm(out * std::cos(now) * oar.length_m, -oar.pivot_m.y - 0.08, -std::sin(now) * oar.length_m);
  const glm::dvec3 blade = oar.pivot_m + arm;
  const glm::dvec3 normal(out * std::sin(now), 0.0, std::cos(now));  // astern
  const Flow flow = flow_at(hull, blade, 0.1);
  const double turns = (pull > 0.0 ? -1.0 : 1.0) * pi * (catch_rad - release_rad) * std::sin(2.0 * pi * phase) * rate;
  const glm::dvec3 swept = -turns * oar.length_m * normal;  // of the blade, from her
  const glm::dvec3 slip = swept - flow.water;
  glm::dvec3 force = flow.wet * oar_force(oar.area_m2, normal, slip, hull.media.density_kg_m3);
  const double size = glm::length(force), bears = most_oar_n * std::abs(pull);
  if (size > bears) force *= bears / size;
  hull.push(force, blade);
  if (flow.wet > 0.0 && blade_count_ < int(blades_.size())) {
    const glm::dvec3 place = hull.world(blade);
    blades_[std::size_t(blade_count_++)] = {
        place,       hull.to_world * normal, hull.to_world * slip, hull.velocity(place) + hull.to_world * swept,
        oar.area_m2, blade_breadth_m};
  }
}

std::uint64_t Boat::mixed_into(std::uint64_t hash) const {
  for (const double value :
       {asked_.throttle, asked_.helm, asked_.sheet, asked_.oar_left, asked_.oar_right, parts_.turns_per_s, parts_.helm,
        parts_.oar_phase[0], parts_.oar_phase[1], parts_.oar_ahead[0], parts_.oar_ahead[1], parts_.boom_rad[0],
        parts_.boom_rad[1], parts_.luffing[0], parts_.luffing[1]})
    hash = mixed(hash, value);
  return hash;
}

}  // namespace seascape
