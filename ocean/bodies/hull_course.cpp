#include "ocean/bodies/hull_course.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int speeds = 120;             // of the table, 0 and up
constexpr double fastest_froude = 1.5;  // of its last
constexpr double dry_transom = 0.85;    // of a face's normal astern: over this it is a transom
constexpr int stations = 96, depths = 16;

// A piece of wetted skin: where it is (z ahead negative, y from the waterline), its area times its normal's part ahead,
// and what of it is seen from one side.
struct Piece {
  double z, y, source, side;
};

void cut(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double longest, std::vector<Piece>& pieces) {
  const double ab = glm::length(b - a), bc = glm::length(c - b), ca = glm::length(a - c);
  if (std::max({ab, bc, ca}) > longest) {
    // In half across its longest side.
    if (ab >= bc && ab >= ca) {
      const glm::dvec3 m = 0.5 * (a + b);
      cut(a, m, c, longest, pieces), cut(m, b, c, longest, pieces);
    } else if (bc >= ca) {
      const glm::dvec3 m = 0.5 * (b + c);
      cut(b, m, a, longest, pieces), cut(m, c, a, longest, pieces);
    } else {
      const glm::dvec3 m = 0.5 * (c + a);
      cut(c, m, b, longest, pieces), cut(m, a, b, longest, pieces);
    }
    return;
  }
  const glm::dvec3 middle = (a + b + c) / 3.0, normal2 = glm::cross(b - a, c - a);
  if (middle.y < 0.0) pieces.push_back({middle.z, middle.y, -0.5 * normal2.z, 0.25 * std::abs(normal2.x)});
}

// The sources of a hull on a grid of stations and depths, shared out between neighbours.
struct Sources {
  double front, along, deep;  // of the first station, from station to station, from depth to depth
  std::array<std::array<double, depths + 1>, stations + 1> at{};
};

Sources gathered(const std::vector<Piece>& pieces, double front, double back, double deepest) {
  Sources all{front, (back - front) / stations, deepest / depths, {}};
  for (const Piece& piece : pieces) {
    const double u = std::clamp((piece.z - front) / all.along, 0.0, stations - 1e-9);
    const double v = std::clamp(-piece.y / all.deep, 0.0, depths - 1e-9);
    const auto i = std::size_t(u), j = std::size_t(v);
    const double du = u - double(i), dv = v - double(j);
    all.at[i][j] += piece.source * (1.0 - du) * (1.0 - dv), all.at[i + 1][j] += piece.source * du * (1.0 - dv);
    all.at[i][j + 1] += piece.source * (1.0 - du) * dv, all.at[i + 1][j + 1] += piece.source * du * dv;
  }
  return all;
}

// R = (4 rho g^2 / (pi U^2)) integral of (I^2 + J^2) cosh^2 u du, lambda = cosh u, I + i J = the integral of dy/dx
// exp(lambda^2 k z + i lambda k x) over the centre plane, k = g / U^2, of which both sides of the hull are twice.
double michell(const Sources& sources, double speed, const HullMedia& media) {
  const double k = media.gravity_mps2 / (speed * speed);
  constexpr int steps = 128;
  // Shorter waves than these do not reach from a quarter of the draught.
  const double furthest = std::acosh(std::max(1.5, std::sqrt(24.0 / (k * sources.deep * depths))));
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double u = furthest * i / steps, lambda = std::cosh(u);
    std::array<double, depths + 1> fades;
    for (std::size_t j = 0; j <= depths; ++j) fades[j] = std::exp(-lambda * lambda * k * sources.deep * double(j));
    double re = 0.0, im = 0.0;
    for (std::size_t n = 0; n <= stations; ++n) {
      double section = 0.0;
      for (std::size_t j = 0; j <= depths; ++j) section += sources.at[n][j] * fades[j];
      const double phase = lambda * k * (sources.front + sources.along * double(n));
      re += section * std::cos(phase), im += section * std::sin(phase);
    }
    const double weight = i == 0 || i == steps ? 0.5 : 1.0;
    sum += weight * 0.25 * (re * re + im * im) * lambda * lambda;
  }
  return 4.0 * media.density_kg_m3 * media.gravity_mps2 * media.gravity_mps2 / (pi * speed * speed) * sum * furthest /
         steps;
}

}  // namespace

HullCourse::HullCourse(const HullMesh& mesh, double waterline, const HullMedia& media) {
  const glm::dvec3 down(0.0, -waterline, 0.0);
  glm::dvec3 least(1e300), most(-1e300);
  for (const auto& t : mesh.triangles)
    for (int side = 0; side < 3; ++side) {  // where its skin is in the water
      const glm::dvec3 a = mesh.vertices[t[std::size_t(side)]] + down;
      const glm::dvec3 b = mesh.vertices[t[std::size_t((side + 1) % 3)]] + down;
      const auto take = [&](const glm::dvec3& p) { least = glm::min(least, p), most = glm::max(most, p); };
      if (a.y <= 0.0) take(a);
      if ((a.y < 0.0) != (b.y < 0.0)) take(a + (b - a) * (a.y / (a.y - b.y)));
    }
  if (!(most.z > least.z)) return;
  length_m_ = most.z - least.z;
  std::vector<Piece> pieces;
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 a = mesh.vertices[t[0]] + down, b = mesh.vertices[t[1]] + down, c = mesh.vertices[t[2]] + down;
    const glm::dvec3 normal2 = glm::cross(b - a, c - a);
    if (std::min({a.y, b.y, c.y}) >= 0.0) continue;
    if (normal2.z > dry_transom * glm::length(normal2)) continue;
    cut(a, b, c, length_m_ / (0.5 * stations), pieces);
  }
  for (const Piece& piece : pieces) volume -= piece.source * piece.z;
  drag_n_.assign(speeds + 1, 0.0);
  step_mps_ = fastest_froude * std::sqrt(media.gravity_mps2 * length_m_) / speeds;
  const Sources sources = gathered(pieces, least.z, most.z, -least.y);
  constexpr int slowest = 8;  // Froude 0.1: below it there is next to nothing
  tbb::parallel_for(slowest, speeds + 1,
                    [&](int i) { drag_n_[std::size_t(i)] = michell(sources, i * step_mps_, media); });

  const double draught = -least.y, beam = most.x - least.x;
  const double block = std::clamp(std::abs(volume) / (length_m_ * beam * draught), 0.0, 1.0);
  lift_ = 0.5 * media.density_kg_m3 * pi * draught * draught * (1.0 + 0.4 * block * beam / draught);
  double area = 0.0;
  for (const Piece& piece : pieces) {
    area += piece.side;
    lever_m_ -= piece.side * piece.z, lever_squared_ += piece.side * piece.z * piece.z;
  }
  if (area > 0.0) lever_m_ /= area, lever_squared_ /= area;
}

double HullCourse::wave_drag_n(double speed) const {
  if (drag_n_.empty()) return 0.0;
  const double at = std::abs(speed) / step_mps_;
  if (!(at < double(speeds))) {
    // As 1 / U^2, where the waves are longer than the hull.
    const double beyond = double(speeds) / std::max(at, double(speeds));
    return drag_n_.back() * beyond * beyond;
  }
  const auto i = std::size_t(at);
  return drag_n_[i] + (at - double(i)) * (drag_n_[i + 1] - drag_n_[i]);
}

Vector6 HullCourse::forces(const BodyPose& pose, const Vector6& through, double wet, double bottom) const {
  const glm::dvec3 linear = glm::transpose(pose.to_world) * through.linear;
  const glm::dvec3 spin = glm::transpose(pose.to_world) * through.angular;
  // In the sense of ship theory: u ahead, v to starboard, r to starboard.
  const double u = -linear.z, v = linear.x, r = -spin.y, speed = std::abs(u);
  const double share = std::clamp(wet, 0.0, 2.0);
  const double ahead = -std::copysign(wave_drag_n(u), u) * share * share;
  const double lift = std::max(lift_ * share - bottom, 0.0);
  const double sway = -speed * lift * (v + lever_m_ * r);
  const double yaw = -speed * lift * (lever_m_ * v + lever_squared_ * r);
  Vector6 force;
  force.linear = pose.to_world * glm::dvec3(sway, 0.0, -ahead);
  force.angular = pose.to_world * glm::dvec3(0.0, -yaw, 0.0);
  return force;
}

}  // namespace seascape
