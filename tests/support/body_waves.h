// Water of a formula for bodies, and hulls of a formula.
#pragma once
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "ocean/bodies/bodies.h"

namespace seascape::test {

constexpr double g = 9.81, rho = 1025.0;

// Still water, at another height or under way where these are set, or waves of Airy on deep water.
struct FormulaWater : BodyWater {
  struct Wave {
    double amplitude_m, length_m;
    glm::dvec2 towards{0.0, 1.0};
    double phase = 0.0;
  };
  double level_m = 0.0;
  glm::dvec2 current_mps{0.0};
  glm::dvec2 slope{0.0};  // of a plane that stands still
  bool dry = false;
  std::vector<Wave> waves;
  mutable int asked = 0;

  double height(double t, const glm::dvec2& at) const {
    double sum = level_m + glm::dot(slope, at);
    for (const Wave& w : waves) sum += w.amplitude_m * std::cos(phase(w, t, at));
    return sum;
  }
  static double phase(const Wave& w, double t, const glm::dvec2& at) {
    const double k = 2.0 * std::numbers::pi / w.length_m;
    return k * glm::dot(w.towards, at) - std::sqrt(g * k) * t + w.phase;
  }
  void ask(double t, double, std::span<const glm::dvec2> places, std::span<WaterHere> answers) const override {
    ++asked;
    for (std::size_t n = 0; n < places.size(); ++n) {
      WaterHere& a = answers[n];
      a = {};
      a.height_m = height(t, places[n]), a.still_m = level_m, a.current_mps = current_mps, a.dry = dry;
      a.velocity_mps = {current_mps.x, 0.0, current_mps.y};
      for (const Wave& w : waves) {
        const double k = 2.0 * std::numbers::pi / w.length_m, speed = w.amplitude_m * std::sqrt(g * k);
        const glm::dvec2 along = speed * std::cos(phase(w, t, places[n])) * w.towards;
        a.velocity_mps += glm::dvec3(along.x, speed * std::sin(phase(w, t, places[n])), along.y);
      }
    }
  }
  double wave_number() const override {
    double energy = 0.0, sum = 0.0;
    for (const Wave& w : waves) {
      energy += w.amplitude_m * w.amplitude_m;
      sum += w.amplitude_m * w.amplitude_m * 2.0 * std::numbers::pi / w.length_m;
    }
    return energy > 0.0 ? sum / energy : 0.0;
  }
  std::optional<CalmWater> calm(double, const glm::dvec2&, double) const override {
    if (!waves.empty() || slope != glm::dvec2(0.0)) return std::nullopt;
    return CalmWater{dry ? -1e3 : level_m, current_mps};
  }
};

// Wigley's hull (1942) along z, its waterline at y = 0, upright above it to a deck.
inline HullMesh wigley_hull(double length, double beam, double draught, double freeboard, int along, int down) {
  HullMesh soup;
  const auto point = [&](int i, int j, double side) {
    const double z = 2.0 * i / along - 1.0, y = j <= down ? 1.0 - double(j) / down : 0.0;
    const double half = 0.5 * beam * (1.0 - z * z) * (1.0 - y * y);
    return glm::dvec3(side * half, j <= down ? -y * draught : freeboard, 0.5 * length * z);
  };
  const auto quad = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const auto n = std::uint32_t(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), {a, b, c, d});
    soup.triangles.push_back({n, n + 1, n + 2});
    soup.triangles.push_back({n, n + 2, n + 3});
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j <= down; ++j) {
      quad(point(i, j, 1.0), point(i, j + 1, 1.0), point(i + 1, j + 1, 1.0), point(i + 1, j, 1.0));
      quad(point(i + 1, j, -1.0), point(i + 1, j + 1, -1.0), point(i, j + 1, -1.0), point(i, j, -1.0));
    }
    quad(point(i, down + 1, 1.0), point(i, down + 1, -1.0), point(i + 1, down + 1, -1.0), point(i + 1, down + 1, 1.0));
  }
  return welded(soup);
}

inline HullDrag no_drag() {
  HullDrag drag;
  drag.friction = false, drag.form = drag.suction = drag.wind = 0.0;
  return drag;
}

inline glm::dmat3 about(const glm::dvec3& axis, double angle) { return glm::mat3_cast(glm::angleAxis(angle, axis)); }

// The forces of pressure on a hull about its mass centre, without drag.
inline HullForces pressed(const HullMesh& mesh, const BodyPose& pose, const BodyWater& water, double half_m,
                          int samples = 16, double deepest_m = 2.0, const glm::dvec2& along = {0.0, 1.0}) {
  WaterPatch patch;
  patch.ask(water, 0.0, {{pose.centre_m.x, pose.centre_m.z}, along, glm::dvec2(half_m), deepest_m}, samples);
  HullClip clip(mesh);
  return clip.forces(pose, {}, patch, {}, no_drag(), 1.0);
}

inline HullMesh moved(HullMesh mesh, const glm::dvec3& by) {
  for (glm::dvec3& v : mesh.vertices) v += by;
  return mesh;
}

// A body of even density that starts at a height.
inline BodySpec even_body(const HullMesh& mesh, double density, double at_y = 0.0) {
  const HullVolume volume = volume_of(mesh);
  BodySpec spec;
  spec.name = "body";
  spec.hull = std::make_shared<HullMesh>(mesh);
  spec.mass = {density * volume.volume_m3, density * volume.inertia_m5, {}};
  spec.mass_centre_m = volume.centre_m;
  spec.drag = no_drag();
  spec.at_m = {0.0, at_y, 0.0};
  return spec;
}

}  // namespace seascape::test
