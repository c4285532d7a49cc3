#include "ocean/bodies/rigid_body.h"

#include <algorithm>
#include <cmath>

namespace seascape {
namespace {

constexpr double most_turn = 0.5;  // rad a step

glm::dmat3 block(const Matrix6& m, std::size_t row, std::size_t column) {
  glm::dmat3 b;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) b[int(j)][int(i)] = m.rows[row + i][column + j];
  return b;
}

void put(Matrix6& m, std::size_t row, std::size_t column, const glm::dmat3& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m.rows[row + i][column + j] = b[int(j)][int(i)];
}

glm::dquat turn_by(const glm::dvec3& angle) {
  const double size = glm::length(angle);
  const double half = 0.5 * size, part = size > 1e-8 ? std::sin(half) / size : 0.5;
  return {std::cos(half), part * angle.x, part * angle.y, part * angle.z};
}

// What the body and the added share of water are, in the body's own axes.
Matrix6 own_mass(const BodyMass& mass, double share) {
  Matrix6 m = mass.added * share;
  for (std::size_t i = 0; i < 3; ++i) m.rows[i][i] += mass.mass_kg;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m.rows[3 + i][3 + j] += mass.inertia_kg_m2[int(j)][int(i)];
  return m;
}

}  // namespace

Matrix6 turned(const Matrix6& matrix, const glm::dmat3& r) {
  Matrix6 out;
  for (const std::size_t i : {0u, 3u})
    for (const std::size_t j : {0u, 3u}) put(out, i, j, r * block(matrix, i, j) * glm::transpose(r));
  return out;
}

Matrix6 rigid_mass(const BodyMass& mass, const glm::dmat3& to_world) {
  return turned(own_mass({mass.mass_kg, mass.inertia_kg_m2, {}}, 0.0), to_world);
}

void drift(BodyMotion& motion, const BodyMass& mass, double share, const glm::dvec3& water, double dt,
           const ShedMass& shed) {
  if (const double turn = glm::length(motion.velocity.angular) * dt; turn > most_turn)
    motion.velocity.angular *= most_turn / turn;
  const glm::dmat3 to_world = glm::mat3_cast(motion.orientation);
  const Matrix6 m = own_mass(mass, share);
  const Cholesky6 inverse(m);
  const Vector6 before{glm::transpose(to_world) * (motion.velocity.linear - water),
                       glm::transpose(to_world) * motion.velocity.angular};
  const Vector6 momentum = m * before;
  Vector6 middle = before, after = momentum;
  double last = 1e300;
  const double ended = 1e-30 * dot(momentum, momentum);  // to rounding
  for (int i = 0; i < 30; ++i) {
    const Vector6 p = (momentum + after) * 0.5;
    middle = inverse.solve(p);
    const Vector6 kept = shed.any ? p - shed.added * middle : p;
    Vector6 turns{glm::cross(kept.linear, middle.angular),
                  glm::cross(kept.angular, middle.angular) + glm::cross(kept.linear, middle.linear)};
    if (shed.any) turns = turns + shed.passing * middle * middle.linear.z;
    const Vector6 next = momentum + turns * dt;
    const Vector6 change = next - after;
    after = next;
    const double size = dot(change, change);
    if (size >= last || size <= ended) break;
    last = size;
  }
  Vector6 v = inverse.solve(after);
  // Where the iteration did not end, at most the energy that there was.
  const double had = dot(momentum, before), has = dot(after, v);
  if (!(has <= had * (1.0 + 1e-9))) v = has > 0.0 && std::isfinite(has) ? v * std::sqrt(had / has) : before;
  motion.centre_m += (to_world * middle.linear + water) * dt;
  motion.orientation = glm::normalize(motion.orientation * turn_by(middle.angular * dt));
  const glm::dmat3 now = glm::mat3_cast(motion.orientation);
  motion.velocity = {now * v.linear + water, now * v.angular};
}

void kick(BodyMotion& motion, const BodyMass& mass, double share, const Vector6& force, const Matrix6& resists,
          double dt) {
  const Matrix6 m = turned(own_mass(mass, share), glm::mat3_cast(motion.orientation));
  motion.velocity = Cholesky6(m + resists * dt).solve(m * motion.velocity + force * dt);
}

void take_along(BodyMotion& motion, const BodyMass& mass, const Matrix6& grown, const glm::dvec3& water) {
  const glm::dmat3 to_world = glm::mat3_cast(motion.orientation);
  const Vector6 slip = motion.velocity - Vector6{water, {}};
  motion.velocity =
      motion.velocity - Cholesky6(turned(own_mass(mass, 1.0), to_world)).solve(turned(grown, to_world) * slip);
}

void slam(BodyMotion& motion, const BodyMass& mass, double before, double now, const glm::dvec3& water) {
  if (now <= before || motion.velocity.linear.y >= water.y) return;
  const glm::dmat3 to_world = glm::mat3_cast(motion.orientation);
  Matrix6 come = turned(mass.added, to_world) * (now - before);
  for (const std::size_t still : {0u, 2u, 4u})  // along the water, and about the upright axis
    for (std::size_t j = 0; j < 6; ++j) come.rows[still][j] = come.rows[j][still] = 0.0;
  Matrix6 m = turned(own_mass(mass, before), to_world);
  const Vector6 slip = motion.velocity - Vector6{water, {}};
  motion.velocity = motion.velocity - Cholesky6(m + come).solve(come * slip);
}

double kinetic_energy(const BodyMotion& motion, const BodyMass& mass, double share) {
  const Matrix6 m = turned(own_mass(mass, share), glm::mat3_cast(motion.orientation));
  return 0.5 * dot(motion.velocity, m * motion.velocity);
}

}  // namespace seascape
