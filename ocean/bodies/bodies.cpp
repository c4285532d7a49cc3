#include "ocean/bodies/bodies.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "ocean/sea/state_hash.h"

namespace seascape {
namespace {

constexpr double most_phase = 0.4;  // rad of the quickest oscillation a substep

bool finite(const BodyMotion& m) {
  double sum = m.orientation.w + m.orientation.x + m.orientation.y + m.orientation.z;
  for (int i = 0; i < 3; ++i) sum += m.centre_m[i];
  for (int i = 0; i < 6; ++i) sum += m.velocity[i];
  return std::isfinite(sum);
}

// How quickly something of this mass can swing on a stiffness that comes with the square root of the added mass's
// share: as a body comes into the water both grow.
double quickest(double stiffness, double own, double added) {
  double most = 0.0;
  for (int i = 1; i <= 32; ++i) {
    const double s = i / 32.0;
    most = std::max(most, stiffness * s / (own + added * s * s));
  }
  return std::sqrt(most);
}

// The water as one body feels it.
class WaterOf final : public BodyWater {
 public:
  WaterOf(const BodyWater& all, std::size_t body) : all_(all), body_(body) {}
  void ask(double time_s, double footprint_m, std::span<const glm::dvec2> places,
           std::span<WaterHere> answers) const override {
    all_.ask_as(body_, time_s, footprint_m, places, answers);
  }
  double wave_number() const override { return all_.wave_number(); }
  std::optional<CalmWater> calm(double time_s, const glm::dvec2& place, double distance_m) const override {
    return all_.calm_as(body_, time_s, place, distance_m);
  }

 private:
  const BodyWater& all_;
  std::size_t body_;
};

// A body's axes turned by the least angle to where its upright one, or that one's opposite, is the world's.
glm::dmat3 levelled(const glm::dmat3& to_world) {
  const glm::dvec3 up = to_world[1].y < 0.0 ? -to_world[1] : to_world[1], axis(-up.z, 0.0, up.x);  // up x y
  const glm::dmat3 cross(0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0);
  return (glm::dmat3(1.0) + cross + cross * cross * (1.0 / (1.0 + up.y))) * to_world;
}

bool symmetric_and_not_negative(const Matrix6& m, const Matrix6& scale) {
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      if (!(std::abs(m.rows[i][j] - m.rows[j][i]) <= 1e-9 * (std::abs(m.rows[i][j]) + std::abs(m.rows[j][i]))))
        return false;
  return Cholesky6(m + scale * 1e-9).positive;
}

void check(const BodySpec& spec) {
  const char* where = spec.name.c_str();
  if (!spec.hull) throw Error(where, "the body has no hull", "give it a mesh");
  validate(*spec.hull, where);
  if (!(spec.mass.mass_kg > 0.0 && spec.mass.mass_kg < 1e12))
    throw Error(where, "mass_kg is no number above 0 and below 1e12", "give the mass in kg");
  const Matrix6 rigid = rigid_mass(spec.mass, glm::dmat3(1.0));
  if (!Cholesky6(rigid).positive) throw Error(where, "the inertia is not positive", "give moments about the centre");
  if (!symmetric_and_not_negative(spec.mass.added, rigid) || !symmetric_and_not_negative(spec.damping, rigid))
    throw Error(where, "added mass or damping is not symmetric and positive", "give a matrix equal to its transpose");
}

}  // namespace

Bodies::Bodies(const BodySettings& settings, std::vector<BodySpec> specs,
               const std::optional<ContactSettings>& contacts)
    : settings_(settings), bodies_(specs.size()), states_(specs.size()) {
  const double weight = settings.media.density_kg_m3 * settings.media.gravity_mps2;
  for (std::size_t n = 0; n < specs.size(); ++n) {
    check(specs[n]);
    Body& body = bodies_[n];
    body.spec = std::move(specs[n]);
    if (body.spec.planes && body.spec.level == BodyLevel::hull)
      for (const std::size_t i : {0u, 1u, 3u, 4u})  // its stations have them
        for (std::size_t j = 0; j < 6; ++j) body.spec.mass.added.rows[i][j] = body.spec.mass.added.rows[j][i] = 0.0;
    const BodySpec& spec = body.spec;
    HullMesh about_centre = *spec.hull;
    double area = 0.0, front = 1e300, back = -1e300;
    for (glm::dvec3& v : about_centre.vertices) {
      v -= spec.mass_centre_m;
      body.radius_m = std::max(body.radius_m, glm::length(v));
      front = std::min(front, v.z), back = std::max(back, v.z);
    }
    for (const auto& t : about_centre.triangles) {
      const auto& v = about_centre.vertices;
      area += 0.25 * glm::length(glm::cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]));  // half: no view has more
    }
    body.length_m = back - front;
    const double turn = area * body.radius_m * body.radius_m / 3.0;
    body.stiffness = Matrix6::diagonal({0.0, weight * area, 0.0, weight * turn, 0.0, weight * turn});
    const Matrix6 rigid = rigid_mass(spec.mass, glm::dmat3(1.0));
    for (std::size_t i = 0; i < 6; ++i) {
      const double stiff = weight * (i < 3 ? area : turn);
      body.quickest_rad_s =
          std::max(body.quickest_rad_s, quickest(stiff, rigid.rows[i][i], spec.mass.added.rows[i][i]));
    }
    body.inside = Inside(spec.inside, spec.mass_centre_m, spec.name.c_str());
    const FloatingUpright upright = float_upright(about_centre, spec.mass.mass_kg, settings.media);
    if (spec.planes && spec.level == BodyLevel::hull) {
      body.bottom = PlaningBottom(about_centre);
      body.sideways = body.bottom.sideways(upright.waterline_m, settings.media.density_kg_m3);
      for (const std::size_t i : {1u, 3u})
        for (std::size_t j = 0; j < 6; ++j) body.spec.damping.rows[i][j] = body.spec.damping.rows[j][i] = 0.0;
      body.spec.damping = body.spec.damping + body.bottom.radiates(upright.waterline_m, weight * upright.waterplane_m2,
                                                                   spec.mass.mass_kg, settings.media);
    }
    body.columns = columns_of(about_centre, upright);
    body.clip = HullClip(std::move(about_centre));
    body.wets_m2 = spec.level == BodyLevel::probes ? 4.0 * body.columns.area_m2 : upright.facing_down_m2;
    BodyState& state = states_[n];
    state.motion.orientation = glm::normalize(spec.orientation);
    state.motion.velocity = {spec.velocity_mps, spec.spin_rad_s};
    state.motion.centre_m = spec.at_m + state.motion.orientation * spec.mass_centre_m;
    state.at_m = spec.at_m;
    state.added_share = 1.0;  // what starts in the water does not slam into it
    weigh(body, glm::mat3_cast(state.motion.orientation), 1.0);
  }
  if (!contacts) return;
  std::vector<HullMesh> hulls;
  std::vector<glm::dvec3> centres;
  for (const Body& body : bodies_) hulls.push_back(body.clip.mesh()), centres.push_back(body.spec.mass_centre_m);
  contacts_.emplace(*contacts, hulls, centres);
}

void Bodies::advance(double time_s, const BodyWater& water) {
  if (!std::isfinite(time_s) || std::abs(time_s) * settings_.rate_hz > 1e15) return;
  const std::int64_t last = std::int64_t(std::floor(time_s * settings_.rate_hz + 1e-6));
  const bool jumps = !begun_ || last < step_ || double(last - step_) > settings_.longest_s * settings_.rate_hz;
  if (jumps) step_ = last;
  begun_ = true;
  while (step_ < last) {
    ++step_;
    step(double(step_) / settings_.rate_hz, 1.0 / settings_.rate_hz, water);
  }
}

void Bodies::step(double end_s, double dt_s, const BodyWater& water) {
  if (!(dt_s > 0.0 && std::isfinite(dt_s))) return;
  tbb::parallel_for(std::size_t(0), bodies_.size(),
                    [&](std::size_t n) { step_body(bodies_[n], states_[n], end_s, dt_s, WaterOf(water, n)); });
  if (contacts_) touch(dt_s);
}

// One thread, bodies in their order: so that bits depend on neither.
void Bodies::touch(double dt_s) {
  colliders_.clear(), untouched_.clear();
  impulses_.resize(bodies_.size());
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    const bool laden = bodies_[n].has_own_mass();
    colliders_.push_back(
        {{&states_[n].motion, laden ? &bodies_[n].laden : &bodies_[n].spec.mass, laden ? 1.0 : states_[n].added_share},
         states_[n].asleep || states_[n].lost});
    untouched_.push_back(states_[n].motion);
  }
  contacts_->step(dt_s, colliders_, impulses_);
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    BodyState& state = states_[n];
    state.contact = impulses_[n];
    state.asleep = state.asleep && colliders_[n].asleep;
    if (!finite(state.motion)) state.motion = untouched_[n], state.motion.velocity = {}, state.lost = true;
    state.at_m = state.motion.centre_m - state.motion.orientation * bodies_[n].spec.mass_centre_m;
  }
}

// What sleeps is not stepped; it costs one question.
bool Bodies::sleeps(Body& body, BodyState& state, double end_s, double dt_s, const BodyWater& water) const {
  const bool slow = glm::length(state.motion.velocity.linear) < settings_.sleep_mps &&
                    glm::length(state.motion.velocity.angular) < settings_.sleep_rad_s;
  if (!state.asleep && !slow) {
    body.quiet_s = 0.0;
    return false;
  }
  const glm::dvec2 place(state.motion.centre_m.x, state.motion.centre_m.z);
  const std::optional<CalmWater> calm = water.calm(end_s, place, 3.0 * body.radius_m);
  const bool same = calm && *calm == body.slept_in;
  if (calm) body.slept_in = *calm;
  const bool bails = state.filled_m3 > 0.0 && body.spec.inside.bail_kg_s > 0.0;
  body.quiet_s = same && !bails ? body.quiet_s + dt_s : 0.0;
  state.asleep = same && !bails && (state.asleep || body.quiet_s >= settings_.sleep_after_s);
  if (state.asleep) state.motion.velocity = {};
  return state.asleep;
}

void Bodies::ask_water(Body& body, const BodyState& state, double end_s, double dt_s, const BodyWater& water) const {
  const glm::dmat3 axes = glm::mat3_cast(state.motion.orientation);
  glm::dvec2 along(axes[2].x, axes[2].z);
  if (glm::length(along) < 0.1) along = {axes[0].x, axes[0].z};
  along = glm::normalize(along);
  const glm::dvec2 across(-along.y, along.x);
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& v : body.clip.mesh().vertices) {
    const glm::dvec3 at = axes * v;
    const glm::dvec2 flat(at.x, at.z);
    const glm::dvec3 here(glm::dot(flat, along), at.y, glm::dot(flat, across));
    low = glm::min(low, here), high = glm::max(high, here);
  }
  const glm::dvec3& v = state.motion.velocity.linear;
  const glm::dvec2 way = glm::dvec2(v.x, v.z) * dt_s;
  const double tall = high.y - low.y, margin = std::max(0.5 * tall, 0.15 * (high.x - low.x)) + 0.5 * glm::length(way);
  PatchBox box;
  box.along = along;
  box.centre_m = glm::dvec2(state.motion.centre_m.x, state.motion.centre_m.z) + 0.5 * way +
                 along * (0.5 * (low.x + high.x)) + across * (0.5 * (low.z + high.z));
  box.half_m = 0.5 * glm::dvec2(high.x - low.x, high.z - low.z) + margin;
  box.deepest_m = std::max({tall, -(state.motion.centre_m.y + low.y), 1e-6});
  const bool fine = body.spec.level == BodyLevel::hull;
  body.water.ask(water, end_s, box, fine ? settings_.water_samples : settings_.probe_samples);
}

void Bodies::step_body(Body& body, BodyState& state, double end_s, double dt_s, const BodyWater& water) const {
  state.slam_mps = 0.0;
  if (state.lost || sleeps(body, state, end_s, dt_s, water)) return;
  const BodyState before = state;
  ask_water(body, state, end_s, dt_s, water);
  if (body.spec.level == BodyLevel::follow) {
    BodyMotion& m = state.motion;
    const glm::dvec2 place(m.centre_m.x, m.centre_m.z), current = body.water.current_mps();
    const glm::dvec3 up = body.water.plane_normal(), ahead = m.orientation * glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, ahead));
    m.orientation = glm::normalize(glm::quat_cast(glm::dmat3(right, up, glm::cross(right, up))));
    m.velocity = {{current.x, body.water.velocity(place).y, current.y}, {}};
    m.centre_m += glm::dvec3(current.x, 0.0, current.y) * dt_s;
    m.centre_m.y = body.water.plane(place) - body.columns.foot_m - body.columns.draught_m;
    state.submerged_m3 = 4.0 * body.columns.area_m2 * body.columns.draught_m;
  } else {
    const double needed = std::max(body.quickest_rad_s, glm::length(state.motion.velocity.angular)) * dt_s / most_phase;
    const int count = int(std::clamp(std::ceil(needed), 1.0, double(settings_.most_substeps)));
    load(body, state);
    for (int i = 0; i < count; ++i) substep(body, state, dt_s / count);
    if (body.inside.open()) let_in(body, state, dt_s);
  }
  body.pushed = {};
  if (!finite(state.motion)) {
    state = before;
    state.motion.velocity = {};
    state.lost = true;
  }
  state.at_m = state.motion.centre_m - state.motion.orientation * body.spec.mass_centre_m;
}

// The water in a boat goes with her, as a mass where it lies now.
void Bodies::load(Body& body, const BodyState& state) const {
  body.pool_kg = state.filled_m3 * settings_.media.density_kg_m3;
  if (!body.has_own_mass()) return;
  const glm::dmat3 axes = glm::mat3_cast(state.motion.orientation);
  if (body.pool_kg > 0.0) body.pool = body.inside.pool(axes, state.filled_m3);
  weigh(body, axes, state.added_share);
}

void Bodies::weigh(Body& body, const glm::dmat3& axes, double share) {
  body.laden = body.spec.mass;
  // What the stations have of it sideways and in roll is theirs.
  const double side_ways = body.sideways.rows[0][0] * share, theirs = body.strips.rows[0][0];
  body.added = body.spec.mass.added * share + body.strips;
  if (side_ways > theirs) body.added = body.added + body.sideways * (share * (1.0 - theirs / side_ways));
  body.added.rows[5][5] -= std::min(body.strips.rows[5][5], body.spec.mass.added.rows[5][5] * share);
  body.laden.added = body.added;
  if (body.pool_kg > 0.0)
    body.laden.added = body.added + mass_at(glm::transpose(axes) * body.pool.centre_m, body.pool_kg);
}

// What comes in brings its own momentum; what leaves takes the boat's.
void Bodies::let_in(Body& body, BodyState& state, double dt) const {
  const BodyPose pose{state.motion.centre_m, glm::mat3_cast(state.motion.orientation)};
  if (state.filled_m3 > 0.0) body.pool = body.inside.pool(pose.to_world, state.filled_m3);
  const double density = settings_.media.density_kg_m3;
  const double flow = body.inside.flow_m3_s(pose, body.water, body.pool, state.filled_m3, settings_.media.gravity_mps2);
  const double before = state.filled_m3, now = std::clamp(before + dt * (flow - body.spec.inside.bail_kg_s / density),
                                                          0.0, body.inside.volume_m3());
  state.filled_m3 = now;
  if (!(now > before)) return;
  const glm::dvec2 place(pose.centre_m.x, pose.centre_m.z);
  const Inside::Pool pool = body.inside.pool(pose.to_world, now);
  const Matrix6 come = mass_at(pool.centre_m, (now - before) * density);
  const Matrix6 had = rigid_mass(body.spec.mass, pose.to_world) + turned(body.added, pose.to_world) +
                      mass_at(pool.centre_m, before * density);
  const Vector6 slip = state.motion.velocity - Vector6{body.water.velocity(place), {}};
  state.motion.velocity = state.motion.velocity - Cholesky6(had + come).solve(come * slip);
}

// Half a drift, the forces there, half a drift: symmetric, so that without drag energy stays.
void Bodies::substep(Body& body, BodyState& state, double dt) const {
  const BodySpec& spec = body.spec;
  BodyMotion& motion = state.motion;
  const glm::dvec2 flow = body.water.current_mps();
  const glm::dvec3 current(flow.x, 0.0, flow.y);
  const bool laden = body.has_own_mass();
  const BodyMass& mass = laden ? body.laden : spec.mass;
  drift(motion, mass, laden ? 1.0 : state.added_share, current, 0.5 * dt, body.shed);
  const BodyPose pose{motion.centre_m, glm::mat3_cast(motion.orientation)};
  const HullForces forces =
      spec.level == BodyLevel::hull
          ? body.clip.forces(pose, motion.velocity, body.water, settings_.media, spec.drag, body.length_m)
          : probe_forces(body.columns, pose, motion.velocity, body.water, settings_.media, spec.drag);
  state.submerged_m3 = forces.submerged_m3;

  // A plate's added mass goes with the square of its wetted width (von Karman 1929).
  const double wet = forces.facing_down_m2 / std::max(body.wets_m2, 1e-300), share = std::min(wet * wet, 1.0);
  const glm::dvec2 place(motion.centre_m.x, motion.centre_m.z);
  const glm::dvec3 water = body.water.velocity(place);
  const glm::dvec3 before = motion.velocity.linear;
  slam(motion, spec.mass, state.added_share, share, water);
  PlaningBottom::Lift lift;
  if (!body.bottom.empty()) {
    lift = body.bottom.lift(pose, motion.velocity, body.water, settings_.media, dt, body.stations);
    body.strips = lift.added;
    body.shed_sideways_kg_m = lift.sideways_kg_m;
    body.shed = {lift.added * lift.sheds, lift.passing, lift.sheds > 0.0};
  }
  // As far as the hull has come into the water since, its share of the mass has changed.
  if (laden) weigh(body, pose.to_world, share);
  if (lift.grown.rows[1][1] > 0.0) take_along(motion, mass, lift.grown, water);
  state.slam_mps += glm::length(motion.velocity.linear - before);
  state.added_share = share;

  const double g = settings_.media.gravity_mps2;
  Vector6 force = forces.pressure + forces.carried + body.pushed;
  force.linear.y -= spec.mass.mass_kg * g;
  if (body.pool_kg > 0.0) {
    const glm::dvec3 weight(0.0, -body.pool_kg * g, 0.0);
    force = force + Vector6{weight, glm::cross(body.pool.centre_m, weight)};
  }
  force = force + lift.carried;
  // Of a hull that planes a steady rise along its own trim makes no waves: up and down are the water's.
  const Matrix6 damping = turned(spec.damping, body.bottom.empty() ? pose.to_world : levelled(pose.to_world)) * share;
  Matrix6 resists = forces.resists + lift.resists + damping;
  force = force + damping * Vector6{water, {}};
  if (!body.water.flat() && forces.submerged_m3 > 0.0) {
    // The added mass of water that is itself under way (Newman 1977, section 4.15): what the pressure does to the
    // displaced water, it does to that too.
    const double displaced = forces.submerged_m3 * settings_.media.density_kg_m3;
    const double depth = 0.5 * forces.submerged_m3 / std::max(forces.facing_down_m2, 1e-9);
    glm::dvec3 rises = forces.pressure.linear / displaced;
    rises.y = body.water.rise(depth, g);
    rises = glm::clamp(rises, glm::dvec3(-g), glm::dvec3(g));
    force = force + turned(laden ? body.added : spec.mass.added * share, pose.to_world) * Vector6{rises, {}};
  }
  // Where substeps do not suffice, what restores is taken at the step's end too: its damping is of the time step.
  if (body.quickest_rad_s * dt > most_phase * 1.001 && forces.submerged_m3 > 0.0)
    resists = resists + body.stiffness * dt;
  kick(motion, mass, laden ? 1.0 : share, force, resists, dt);
  drift(motion, mass, laden ? 1.0 : share, current, 0.5 * dt, body.shed);
}

void Bodies::push(std::size_t n, const glm::dvec3& force, const glm::dvec3& at) {
  BodyState& state = states_[n];
  bodies_[n].pushed = bodies_[n].pushed + Vector6{force, glm::cross(at - state.motion.centre_m, force)};
  wake(n);
}

void Bodies::resist(std::size_t n, const Vector6& force) { bodies_[n].pushed = bodies_[n].pushed + force; }

void Bodies::wake(std::size_t n) { bodies_[n].quiet_s = 0.0, states_[n].asleep = false; }

void Bodies::hit(std::size_t n, const glm::dvec3& impulse, const glm::dvec3& at) {
  BodyState& state = states_[n];
  const Vector6 whole{impulse, glm::cross(at - state.motion.centre_m, impulse)};
  const Body& body = bodies_[n];
  const bool laden = body.has_own_mass();
  kick(state.motion, laden ? body.laden : body.spec.mass, laden ? 1.0 : state.added_share, whole, {}, 1.0);
  wake(n);
}

void Bodies::fill(std::size_t n, double water_m3) {
  if (!bodies_[n].inside.open() || !std::isfinite(water_m3)) return;
  states_[n].filled_m3 = std::clamp(water_m3, 0.0, bodies_[n].inside.volume_m3());
  bodies_[n].quiet_s = 0.0, states_[n].asleep = false;
}

void Bodies::moor(std::vector<MooringLine> lines) {
  if (!contacts_) return;
  for (const MooringLine& line : lines)
    for (const std::size_t held : {line.body, line.other.value_or(line.body)})
      if (held < states_.size()) bodies_[held].quiet_s = 0.0, states_[held].asleep = false;
  contacts_->set_lines(std::move(lines));
}

std::span<const double> Bodies::line_tensions_n() const {
  return contacts_ ? contacts_->tensions_n() : std::span<const double>();
}

void Bodies::place(std::size_t n, const BodyMotion& motion) {
  BodyState& state = states_[n];
  if (glm::length(motion.centre_m - state.motion.centre_m) > bodies_[n].length_m) bodies_[n].stations.known = false;
  state.motion = motion;
  state.motion.orientation = glm::normalize(motion.orientation);
  state.at_m = motion.centre_m - state.motion.orientation * bodies_[n].spec.mass_centre_m;
  bodies_[n].quiet_s = 0.0, state.asleep = state.lost = false;
}

std::uint64_t Bodies::hash() const {
  std::uint64_t hash = mixed(14695981039346656037ull, std::uint64_t(step_));
  for (const BodyState& state : states_) {
    hash = mixed(mixed(hash, state.motion.centre_m),
                 glm::dvec3(state.motion.orientation.x, state.motion.orientation.y, state.motion.orientation.z));
    hash = mixed(mixed(hash, state.motion.velocity.linear), state.motion.velocity.angular);
    hash = mixed(mixed(hash, state.added_share), std::uint64_t(state.asleep));
    if (state.filled_m3 > 0.0) hash = mixed(hash, state.filled_m3);
  }
  return hash;
}

}  // namespace seascape
