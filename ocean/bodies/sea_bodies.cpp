#include "ocean/bodies/sea_bodies.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "ocean/inputs/clip_body.h"
#include "ocean/sea/state_hash.h"

namespace seascape {

namespace {

constexpr std::size_t most_told = 4096;  // events that nobody has taken

ContactSettings contacts_of(const BodySurroundings& surroundings, SeaWater& water) {
  ContactSettings settings;
  settings.still = surroundings.still;
  if (surroundings.land)
    settings.land = [&water](std::span<const glm::dvec2> places, std::span<double> heights_m) {
      water.ground(places, heights_m);
    };
  return settings;
}

}  // namespace

SeaBodies::SeaBodies(const BodySettings& settings, std::vector<BodySpec> specs, std::vector<BoatSpec> boats,
                     std::vector<std::shared_ptr<const HullCourse>> courses, std::vector<BodyInsides> insides,
                     const BodySurroundings& surroundings)
    : moorings_(surroundings.moorings, surroundings.fittings, surroundings.points, surroundings.still),
      bodies_(settings, std::move(specs), contacts_of(surroundings, water_)),
      media_(settings.media),
      courses_(std::move(courses)),
      insides_(std::move(insides)) {
  assert(boats.size() == insides_.size() && courses_.size() == insides_.size() &&
         bodies_.result().size() == insides_.size());
  for (BoatSpec& boat : boats) boats_.emplace_back(std::move(boat));
}

void SeaBodies::take(const HullMedia& media) {
  media_ = media;
  bodies_.take(media);
}

void SeaBodies::step(SeaStep& step) {
  water_.see(step.felt());
  moorings_.make_scene_lines(bodies_, water_, media_);
  for (std::size_t n = 0; n < courses_.size(); ++n)
    if (courses_[n] != nullptr) keep_course(n, step.time_s);
  for (Steered& one : steered_)
    if (one.steers) boats_[one.body].ask(one.helmsman.step(boats_[one.body].spec(), bodies_.result()[one.body]));
  for (std::size_t n = 0; n < boats_.size(); ++n) boats_[n].step(bodies_, n, water_, media_, step.time_s, step.dt_s);
  bodies_.step(step.time_s, step.dt_s, water_);
  hold_towed(step.dt_s);
  events_.follow(step.time_s, bodies_, told_);
  moorings_.follow(step.time_s, step.dt_s, bodies_, water_, told_);
  if (told_.size() > most_told) told_.erase(told_.begin(), told_.end() - most_told);
  stepped_s_ = step.time_s;
  step_s_ = step.dt_s;
  for (Wake& wake : wakes_) make_waves(step, wake);
  for (std::size_t n = 0; n < insides_.size(); ++n)
    for (const int hull : insides_[n].hulls) step.clip(clip_of(n, hull));
}

void SeaBodies::ask(std::size_t n, const BoatControls& controls) {
  boats_[n].ask(controls);
  for (Steered& one : steered_)
    if (one.body == n) one.steers = false;
}

void SeaBodies::keep_course(std::size_t n, double end_s) {
  const BodyState& state = bodies_.result()[n];
  if (state.asleep || state.lost || state.submerged_m3 <= 0.0) return;
  const glm::dvec2 place(state.motion.centre_m.x, state.motion.centre_m.z);
  WaterHere here;
  water_.ask_as(n, end_s, courses_[n]->length_m(), {&place, 1}, {&here, 1});
  Vector6 through = state.motion.velocity;
  through.linear -= glm::dvec3(here.velocity_mps.x, 0.0, here.velocity_mps.z);
  const BodyPose pose{state.motion.centre_m, glm::mat3_cast(state.motion.orientation)};
  const double at_rest_m3 = bodies_.spec(n).mass.mass_kg / media_.density_kg_m3;
  bodies_.resist(n, courses_[n]->forces(pose, through, state.submerged_m3 / at_rest_m3, bodies_.shed_sideways_kg_m(n)));
}

void SeaBodies::makes_waves(std::size_t n, std::shared_ptr<const HullWake> hull, double least_length_m) {
  double front = 0.0, back = 0.0;
  for (const glm::dvec3& v : bodies_.spec(n).hull->vertices) front = std::min(front, v.z), back = std::max(back, v.z);
  const double turn = double(wakes_.size() % 10) / 10.0;  // hulls give foam one after the other
  cut_.resize(std::max(cut_.size(), std::size_t(hull->sections())));
  wakes_.push_back({n, std::move(hull), least_length_m, back - front, WakeFoam(turn)});
}

void SeaBodies::make_waves(SeaStep& step, Wake& wake) {
  const std::size_t n = wake.body;
  const BodyState& state = bodies_.result()[n];
  if (state.asleep || state.lost) return;
  HullMotion motion{{state.motion.centre_m, glm::mat3_cast(state.motion.orientation)}, state.motion.velocity, {}};
  const auto ask = [&](const glm::dvec2& place, double footprint_m) {
    WaterHere here;
    water_.ask_as(n, step.time_s, footprint_m, {&place, 1}, {&here, 1});
    return here;
  };
  const WaterHere around = ask({state.motion.centre_m.x, state.motion.centre_m.z}, wake.length_m);
  motion.water_mps = around.velocity_mps;
  const std::span<HullSection> cut(cut_.data(), std::size_t(wake.hull->sections()));
  const double part_m = wake.length_m / wake.hull->sections();
  wake.hull->cut(
      motion, [&](const glm::dvec2& place) { return ask(place, part_m).height_m; }, cut);
  sources_.clear();
  wake.hull->add_sources(motion, cut, wake.least_length_m, sources_);
  for (const Blade& blade : boats_[n].blades())
    add_blade_sources(blade, around.height_m, wake.least_length_m, sources_);
  const glm::dvec3& v = state.motion.velocity.linear;
  step.wake({n + 1, {state.motion.centre_m.x, state.motion.centre_m.z}, {v.x, v.z}, wake.length_m}, sources_);

  std::optional<PropellerWash> wash;
  if (const auto& engine = boats_[n].spec().engine)
    wash = PropellerWash{state.at_m + motion.pose.to_world * engine->at_m, engine->propeller.diameter_m,
                         boats_[n].parts().thrust_n};
  made_.clear();
  wake.foam.step(step.dt_s, motion, cut, part_m, wash, media_.gravity_mps2, media_.density_kg_m3, made_);
  for (const FoamDisc& disc : made_.foam) step.foam(disc);
  for (const SprayThrow& thrown : made_.spray) step.spray(thrown);
}

void SeaBodies::hold_towed(double dt_s) {
  for (Towed& towed : towed_) {
    const glm::dvec3& v = towed.as.velocity.linear;
    towed.as.centre_m += glm::dvec3(v.x, 0.0, v.z) * dt_s;
    BodyMotion now = bodies_.result()[towed.body].motion;
    now.centre_m = {towed.as.centre_m.x, now.centre_m.y, towed.as.centre_m.z};
    now.velocity.linear = {v.x, now.velocity.linear.y, v.z};
    now.velocity.angular.y = 0.0;
    const glm::dquat turned_off = heading(now.orientation), course = heading(towed.as.orientation);
    now.orientation = course * glm::conjugate(turned_off) * now.orientation;
    bodies_.place(towed.body, now);
  }
}

void SeaBodies::hold() {
  step_s_ = 0.0;
  ++holds_;
  for (Wake& wake : wakes_) wake.foam.forget();
}

// Upright, dry and at rest, her engine stopped; what is asked of her stays.
void SeaBodies::put_back(std::size_t n) {
  const BodySpec& spec = bodies_.spec(n);
  BodyMotion motion;
  motion.orientation = heading(glm::normalize(spec.orientation));
  motion.centre_m = spec.at_m + motion.orientation * spec.mass_centre_m;
  bodies_.place(n, motion);
  bodies_.fill(n, 0.0);
  const BoatControls asked = boats_[n].asked();
  boats_[n] = Boat(boats_[n].spec());
  boats_[n].ask(asked);
  trim(n);
  for (Towed& towed : towed_)
    if (towed.body == n) towed.as = motion;
  for (Wake& wake : wakes_)
    if (wake.body == n) wake.foam.forget();
  for (Steered& one : steered_)
    if (one.body == n) one.helmsman.begin_anew(), one.steers = true;
  moorings_.begin_anew(n, bodies_);
}

SeaBodies::HungLine SeaBodies::line_at(std::size_t n, double time_s) const {
  const Moorings::Line& line = moorings_.lines()[n];
  const auto on = [&](std::size_t body, const glm::dvec3& hull_m) {
    const Pose pose = pose_at(body, time_s);
    return pose.position_m + pose.orientation * hull_m;
  };
  const MooringLine& is = line.is;
  return {on(is.body, is.from_m), is.other ? on(*is.other, is.to_m) : is.to_m, is.length_m, line.diameter_m,
          is.weight_n_m > 0.0 ? std::optional(Chain{is.weight_n_m, is.length_m, is.stiffness_n_m * is.length_m})
                              : std::nullopt};
}

ClipBody SeaBodies::clip_of(std::size_t n, int hull) const {
  const BodyState& state = bodies_.result()[n];
  ClipBody clip;
  clip.hull = hull;
  clip.scale = insides_[n].scale;
  clip.at_m = state.at_m;
  clip.orientation = state.motion.orientation;
  clip.velocity_mps = velocity_mps(n);
  clip.spin_rad_s = state.motion.velocity.angular;
  return clip;
}

glm::dvec3 SeaBodies::velocity_mps(std::size_t n) const {
  const BodyState& state = bodies_.result()[n];
  const Vector6& v = state.motion.velocity;
  return v.linear + glm::cross(v.angular, state.at_m - state.motion.centre_m);
}

// As frames carry on the bodies that clip the water, so that a hull and what it keeps dry are one.
Pose SeaBodies::pose_at(std::size_t n, double time_s) const {
  const BodyState& state = bodies_.result()[n];
  ClipBody body = clip_of(n, ClipBody::no_hull);
  const double since_s = std::clamp(time_s - stepped_s_, 0.0, step_s_);
  if (since_s <= 0.0 || state.asleep || state.lost) return {state.at_m, state.motion.orientation};
  body = carried(body, since_s);
  return {body.at_m, body.orientation};
}

std::uint64_t SeaBodies::hash() const {
  std::uint64_t hash = bodies_.hash();
  for (const Boat& boat : boats_) hash = boat.mixed_into(hash);
  for (const Wake& wake : wakes_) hash = mixed(hash, wake.foam.hash());
  for (const Steered& one : steered_) hash = mixed(one.helmsman.mixed_into(hash), std::uint64_t(one.steers));
  return moorings_.mixed_into(hash);
}

}  // namespace seascape
