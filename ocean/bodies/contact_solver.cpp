#include "ocean/bodies/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seascape {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

// Two directions across a normal, the same for the same normal.
std::array<glm::dvec3, 2> across(const glm::dvec3& n) {
  const glm::dvec3 other = std::abs(n.y) < 0.7 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 first = glm::normalize(glm::cross(other, n));
  return {first, glm::cross(n, first)};
}

}  // namespace

std::size_t ContactSolver::slot(std::span<const ContactBody> bodies, std::size_t body) {
  if (slots_[body] == none) {
    slots_[body] = moving_.size();
    const ContactBody& b = bodies[body];
    const glm::dmat3 to_world = glm::mat3_cast(b.motion->orientation);
    const Matrix6 mass = rigid_mass(*b.mass, to_world) + turned(b.mass->added, to_world) * b.share;
    moving_.push_back({body, Cholesky6(mass), mass, b.motion->velocity, b.motion->velocity, {}, 1.0 / b.mass->mass_kg});
  }
  return slots_[body];
}

ContactSolver::Row ContactSolver::row(std::size_t a, const glm::dvec3& at_a, std::optional<std::size_t> b,
                                      const glm::dvec3& at_b, const glm::dvec3& direction,
                                      std::span<const ContactBody> bodies) const {
  Row out;
  const auto side = [&](std::size_t body, const glm::dvec3& at, double sign, Vector6& acts, Vector6& takes) {
    const glm::dvec3 d = sign * direction;
    acts = {d, glm::cross(at - bodies[body].motion->centre_m, d)};
    takes = moving_[slots_[body]].inverse.solve(acts);
    out.mobility += dot(acts, takes);
  };
  side(a, at_a, 1.0, out.a, out.takes_a);
  if (b) side(*b, at_b, -1.0, out.b, out.takes_b);
  return out;
}

// How fast a goes along the row's direction from b, m/s.
double ContactSolver::parting(const Row& row, std::size_t a, std::optional<std::size_t> b) const {
  double speed = dot(row.a, moving_[slots_[a]].velocity);
  if (b) speed += dot(row.b, moving_[slots_[*b]].velocity);
  return speed;
}

void ContactSolver::apply(const Row& row, std::size_t a, std::optional<std::size_t> b, double impulse) {
  Moving& first = moving_[slots_[a]];
  first.velocity = first.velocity + row.takes_a * impulse;
  if (!b) return;
  Moving& second = moving_[slots_[*b]];
  second.velocity = second.velocity + row.takes_b * impulse;
}

// Friction first, as far as what presses allows, then what presses.
void ContactSolver::push(Touch& touch, TouchRows& rows, double bounce, bool rubs) {
  if (rubs && touch.friction > 0.0) {
    std::array<double, 2> now{};
    for (std::size_t i = 0; i < 2; ++i)
      now[i] = rows.rubs[i] - parting(rows.along[i], touch.a, touch.b) / rows.along[i].mobility;
    const double most = touch.friction * touch.impulse_ns, size = std::hypot(now[0], now[1]);
    for (std::size_t i = 0; i < 2; ++i) {
      if (size > most) now[i] *= most / size;
      apply(rows.along[i], touch.a, touch.b, now[i] - rows.rubs[i]);
      rows.rubs[i] = now[i];
    }
  }
  const double wanted = rows.wanted_mps > 0.0 ? rows.wanted_mps * bounce : rows.wanted_mps;
  const double parts = parting(rows.normal, touch.a, touch.b);
  const double now = std::max(touch.impulse_ns + (wanted - parts) / rows.normal.mobility, 0.0);
  apply(rows.normal, touch.a, touch.b, now - touch.impulse_ns);
  changed_mps_ = std::max(changed_mps_, std::abs(now - touch.impulse_ns) * rows.normal.mobility);
  touch.impulse_ns = now;
}

// There and back: what lies under a stack hears of it sooner.
void ContactSolver::sweep(std::span<Touch> touches, std::span<Pull> pulls, double bounce, bool rubs, bool backwards) {
  changed_mps_ = 0.0;
  for (std::size_t n = 0; n < pulls.size(); ++n) {
    const PullRow& p = pull_rows_[n];
    const double speed = parting(p.row, pulls[n].body, pulls[n].other);
    const double change = (p.wanted_mps - speed - p.softness * pulls[n].impulse_ns) / (p.row.mobility + p.softness);
    const double now = std::clamp(pulls[n].impulse_ns + change, 0.0, p.most_ns);
    apply(p.row, pulls[n].body, pulls[n].other, now - pulls[n].impulse_ns);
    changed_mps_ = std::max(changed_mps_, std::abs(now - pulls[n].impulse_ns) * p.row.mobility);
    pulls[n].impulse_ns = now;
  }
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const std::size_t n = backwards ? touches.size() - 1 - i : i;
    push(touches[n], rows_[n], bounce, rubs);
  }
}

// False where there is more energy than before. What lines store is of their stretch, and no part of it.
bool ContactSolver::run(const SolverSettings& settings, std::span<Touch> touches, std::span<Pull> pulls, double bounce,
                        bool rubs) {
  for (Touch& touch : touches) touch.impulse_ns = 0.0;
  for (Pull& pull : pulls) pull.impulse_ns = 0.0;
  for (TouchRows& rows : rows_) rows.rubs = {};
  for (Moving& m : moving_) m.velocity = m.before;
  constexpr double still_mps = 1e-9;
  for (int n = 0; n < settings.sweeps; ++n) {
    sweep(touches, pulls, bounce, rubs, n % 2 != 0);
    if (changed_mps_ < still_mps) break;
  }
  double before = 0.0, now = 0.0, pulled = 0.0;
  for (const Moving& m : moving_) {
    before += dot(m.before, m.mass * m.before), now += dot(m.velocity, m.mass * m.velocity);
  }
  for (std::size_t n = 0; n < pulls.size(); ++n) {  // the work of each pull at its mean speed
    const Row& row = pull_rows_[n].row;
    const Moving& m = moving_[slots_[pulls[n].body]];
    double way = dot(row.a, m.before + m.velocity);
    if (pulls[n].other) {
      const Moving& other = moving_[slots_[*pulls[n].other]];
      way += dot(row.b, other.before + other.velocity);
    }
    pulled += pulls[n].impulse_ns * way;
  }
  return now <= before + std::max(pulled, 0.0) + 1e-12 * before;
}

void ContactSolver::part(const SolverSettings& settings, std::span<const Touch> touches) {
  for (const Touch& touch : touches) {
    Moving& a = moving_[slots_[touch.a]];
    Moving* b = touch.b ? &moving_[slots_[*touch.b]] : nullptr;
    const glm::dvec3 shift = a.shift - (b ? b->shift : glm::dvec3(0.0));
    const double rest = -touch.gap_m - settings.overlap_m - glm::dot(touch.normal, shift);
    if (!(rest > 0.0)) continue;
    const double by = settings.parts_a_step * rest / (a.per_kg + (b ? b->per_kg : 0.0));
    a.shift += by * a.per_kg * touch.normal;
    if (b) b->shift -= by * b->per_kg * touch.normal;
  }
}

void ContactSolver::solve(const SolverSettings& settings, double dt, std::span<const ContactBody> bodies,
                          std::span<Touch> touches, std::span<Pull> pulls) {
  if (touches.empty() && pulls.empty()) return;
  slots_.assign(bodies.size(), none);
  moving_.clear(), rows_.clear(), pull_rows_.clear();
  for (const Touch& touch : touches) {
    slot(bodies, touch.a);
    if (touch.b) slot(bodies, *touch.b);
  }
  for (const Pull& pull : pulls) {
    slot(bodies, pull.body);
    if (pull.other) slot(bodies, *pull.other);
  }

  // Before impulses are reckoned, so that their moments are about where the bodies stay.
  part(settings, touches);
  for (const Moving& m : moving_) bodies[m.body].motion->centre_m += m.shift;
  double bounce = 0.0;
  for (const Touch& touch : touches) {
    TouchRows& rows = rows_.emplace_back();
    rows.normal = row(touch.a, touch.at_m, touch.b, touch.at_m, touch.normal, bodies);
    const std::array<glm::dvec3, 2> tangents = across(touch.normal);
    for (std::size_t i = 0; i < 2; ++i)
      rows.along[i] = row(touch.a, touch.at_m, touch.b, touch.at_m, tangents[i], bodies);
    const double speed = parting(rows.normal, touch.a, touch.b);
    const double most = -std::max(touch.gap_m, 0.0) / dt;  // as fast as it may come nearer
    const bool bounces = speed < -settings.bounce_mps && speed < most && touch.restitution > 0.0;
    rows.wanted_mps = bounces ? -touch.restitution * speed : most;
    if (bounces) bounce = 1.0;
  }
  // A spring and a damper that are taken at the step's end are a soft constraint (Catto 2011): however stiff a line is,
  // it never swings.
  for (const Pull& pull : pulls) {
    PullRow& p = pull_rows_.emplace_back();
    p.row = row(pull.body, pull.at_m, pull.other, pull.other_at_m, pull.towards, bodies);
    const double stiff = pull.damping_ns_m + dt * pull.stiffness_n_m;
    p.softness = 1.0 / (dt * stiff);
    p.wanted_mps = pull.stretch_m * pull.stiffness_n_m / stiff;
    p.most_ns = pull.most_n * dt;
  }
  if (!run(settings, touches, pulls, bounce, true) && !(bounce > 0.0 && run(settings, touches, pulls, 0.0, true)))
    run(settings, touches, pulls, 0.0, false);
  for (const Moving& m : moving_) bodies[m.body].motion->velocity = m.velocity;
}

}  // namespace seascape
