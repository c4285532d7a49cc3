// A smooth curve through points on the plane, and numbers that go smoothly from one point to the next without passing
// beyond either.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace seascape {

// The Catmull-Rom curve for any knots, as piecewise cubics (Barry and Goldman 1988, SIGGRAPH 22(4), in Hermite's form):
// through every point, and with a tangent that goes on smoothly. Span i goes from point i to the next; u is 0 to 1 on
// it. Open ends go on as the parabola through the last three points does.
class Curve {
 public:
  // `knots`: one a point, each above the one before; a closed curve has one more, that of the first point again. At
  // least 2 points, and 3 of a closed curve.
  Curve(std::vector<glm::dvec2> points, std::vector<double> knots, bool closed);

  std::size_t spans() const { return knots_.size() - 1; }
  double knot(std::size_t i) const { return knots_[i]; }
  glm::dvec2 place(std::size_t span, double u) const;
  glm::dvec2 derivative(std::size_t span, double u) const;  // by u
  glm::dvec2 second(std::size_t span, double u) const;
  // Chords into which a span has to be cut so that none is farther from the curve than `share` of the span's length: 1
  // to 64.
  int chords(std::size_t span, double share) const;
  glm::dvec2 point(std::size_t i) const { return points_[i % points_.size()]; }

 private:
  std::vector<glm::dvec2> points_, tangents_;  // tangents by the knots' unit
  std::vector<double> knots_;
};

// Knots by the square root of the distance, which leaves no loops or cusps between points (Yuksel, Schaefer and Keyser
// 2011, Parameterization and applications of Catmull-Rom curves, CAD 43, section 3). No two points in succession may be
// at one place.
std::vector<double> centripetal_knots(std::span<const glm::dvec2> points, bool closed);

// Slopes at the knots with which Hermite's cubics through the values are monotone wherever the values are (Fritsch and
// Butland 1984, SIAM J. Sci. Stat. Comput. 5(2), eq. 5: the harmonic mean, weighted by the spans): a river never flows
// uphill between two points.
std::vector<double> monotone_slopes(std::span<const double> values, std::span<const double> knots, bool closed);

// Hermite's cubic from a to b with these slopes by u.
double hermite(double a, double b, double slope_a, double slope_b, double u);

}  // namespace seascape
