#include "ocean/inputs/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace seascape {

namespace {

// Slope in the middle of the parabola through three values.
template <class T>
T middle_slope(const T& before, const T& here, const T& after, double to_here, double to_after) {
  return (here - before) / to_here - (after - before) / (to_here + to_after) + (after - here) / to_after;
}
// The same parabola's at `here`, its first value.
template <class T>
T first_slope(const T& here, const T& next, const T& after, double to_next, double to_after) {
  return (next - here) / to_next + (after - here) / (to_next + to_after) - (after - next) / to_after;
}

}  // namespace

Curve::Curve(std::vector<glm::dvec2> points, std::vector<double> knots, bool closed)
    : points_(std::move(points)), knots_(std::move(knots)) {
  const std::size_t n = points_.size();
  assert(n >= (closed ? 3u : 2u) && knots_.size() == n + (closed ? 1 : 0));
  tangents_.resize(n);
  const auto step = [&](std::size_t i) { return knots_[i + 1] - knots_[i]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (closed) {
      tangents_[i] =
          middle_slope(points_[(i + n - 1) % n], points_[i], points_[(i + 1) % n], step((i + n - 1) % n), step(i));
    } else if (n == 2) {
      tangents_[i] = (points_[1] - points_[0]) / step(0);
    } else if (i == 0) {
      tangents_[i] = first_slope(points_[0], points_[1], points_[2], step(0), step(1));
    } else if (i == n - 1) {
      tangents_[i] = -first_slope(points_[n - 1], points_[n - 2], points_[n - 3], step(n - 2), step(n - 3));
    } else {
      tangents_[i] = middle_slope(points_[i - 1], points_[i], points_[i + 1], step(i - 1), step(i));
    }
  }
}

glm::dvec2 Curve::place(std::size_t span, double u) const {
  const std::size_t next = (span + 1) % points_.size();
  const double h = knots_[span + 1] - knots_[span], v = 1.0 - u;
  const glm::dvec2 step = points_[next] - points_[span];
  return points_[span] + step * (u * u * (3.0 - 2.0 * u)) + tangents_[span] * (h * u * v * v) -
         tangents_[next] * (h * u * u * v);
}

glm::dvec2 Curve::derivative(std::size_t span, double u) const {
  const std::size_t next = (span + 1) % points_.size();
  const double h = knots_[span + 1] - knots_[span], v = 1.0 - u;
  return (points_[next] - points_[span]) * (6.0 * u * v) + tangents_[span] * (h * v * (1.0 - 3.0 * u)) +
         tangents_[next] * (h * u * (3.0 * u - 2.0));
}

glm::dvec2 Curve::second(std::size_t span, double u) const {
  const std::size_t next = (span + 1) % points_.size();
  const double h = knots_[span + 1] - knots_[span];
  return (points_[next] - points_[span]) * (6.0 - 12.0 * u) + tangents_[span] * (h * (6.0 * u - 4.0)) +
         tangents_[next] * (h * (6.0 * u - 2.0));
}

int Curve::chords(std::size_t span, double share) const {
  // A chord over 1/n of u is off by |P''| / (8 n^2) at most, and P'' is greatest at an end.
  const double bend = std::max(glm::length(second(span, 0.0)), glm::length(second(span, 1.0)));
  const double length = std::max(glm::distance(place(span, 0.0), place(span, 1.0)), bend / 16.0);
  if (!(length > 0.0)) return 1;
  return int(std::clamp(std::ceil(std::sqrt(bend / (8.0 * share * length))), 1.0, 64.0));
}

std::vector<double> centripetal_knots(std::span<const glm::dvec2> points, bool closed) {
  std::vector<double> knots{0.0};
  for (std::size_t i = 1; i < points.size() + (closed ? 1 : 0); ++i)
    knots.push_back(knots.back() + std::sqrt(glm::distance(points[i - 1], points[i % points.size()])));
  return knots;
}

std::vector<double> monotone_slopes(std::span<const double> values, std::span<const double> knots, bool closed) {
  const std::size_t n = values.size(), spans = knots.size() - 1;
  const auto secant = [&](std::size_t i) { return (values[(i + 1) % n] - values[i]) / (knots[i + 1] - knots[i]); };
  std::vector<double> slopes(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!closed && (i == 0 || i == n - 1)) {
      slopes[i] = secant(i == 0 ? 0 : spans - 1);
      continue;
    }
    const std::size_t last = (i + spans - 1) % spans;
    const double a = secant(last), b = secant(i), h = knots[last + 1] - knots[last], k = knots[i + 1] - knots[i];
    if (a * b > 0.0) slopes[i] = 3.0 * (h + k) / ((2.0 * k + h) / a + (k + 2.0 * h) / b);
  }
  return slopes;
}

double hermite(double a, double b, double slope_a, double slope_b, double u) {
  const double v = 1.0 - u;
  return a + (b - a) * (u * u * (3.0 - 2.0 * u)) + slope_a * (u * v * v) - slope_b * (u * u * v);
}

}  // namespace seascape
