// Wave particles by direct sums in double: Yuksel, House and Keyser (2007). Nothing here includes or repeats a line of
// the code it judges.
#pragma once
#include <cmath>
#include <functional>
#include <vector>

namespace truth {

inline constexpr double pi_of_bumps = 3.14159265358979323846;

// A bump of height a and radius r at (x, z) of a plane.
struct Bump {
  double x = 0.0, z = 0.0, a = 1.0;
};

inline double bump(double u) { return u < 1.0 ? 0.5 * (1.0 + std::cos(pi_of_bumps * u)) : 0.0; }

// The nearest of a distance and its repetitions.
inline double nearest(double d, double side) { return side > 0.0 ? d - side * std::floor(d / side + 0.5) : d; }

// Height at (x, z), every bump repeated each `side` along both axes (0: not at all).
inline double bumps(const std::vector<Bump>& list, double r, double side, double x, double z) {
  double sum = 0.0;
  for (const Bump& b : list) {
    const double dx = nearest(x - b.x, side), dz = nearest(z - b.z, side);
    if (std::abs(dx) < r && std::abs(dz) < r) sum += b.a * bump(std::hypot(dx, dz) / r);
  }
  return sum;
}

// The slope along x.
inline double bumps_dx(const std::vector<Bump>& list, double r, double side, double x, double z) {
  double sum = 0.0;
  for (const Bump& b : list) {
    const double dx = nearest(x - b.x, side), dz = nearest(z - b.z, side);
    const double d = std::hypot(dx, dz);
    if (d > 0.0 && d < r) sum -= b.a * 0.5 * pi_of_bumps / r * std::sin(pi_of_bumps * d / r) * dx / d;
  }
  return sum;
}

// How much a front along z, of bumps `spacing` apart, varies along itself `off` its crest: highest less lowest over the
// mean.
inline double ripple(double r, double spacing, double off) {
  std::vector<Bump> list;
  for (int i = -int(r / spacing) - 2; i <= int(r / spacing) + 3; ++i) list.push_back({0.0, i * spacing});
  double least = 1e9, most = 0.0, mean = 0.0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const double h = bumps(list, r, 0.0, off, spacing * i / steps);
    least = std::min(least, h);
    most = std::max(most, h);
    mean += h / steps;
  }
  return (most - least) / mean;
}

}  // namespace truth
