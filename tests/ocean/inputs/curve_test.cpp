// Curves against Barry and Goldman's pyramid, and numbers along them that never pass beyond a point's.
#include "ocean/inputs/curve.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/input_truth.h"

namespace seascape {
namespace {

using test::Flat;

std::vector<glm::dvec2> places(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(-50.0, 50.0);
  std::vector<glm::dvec2> result(count);
  for (glm::dvec2& p : result) p.x = at(random), p.y = at(random);
  return result;
}
Flat flat(glm::dvec2 p) { return {p.x, p.y}; }

// Control: knots by the distance itself (chordal) are off by metres here.
TEST(Curve, IsTheCentripetalCatmullRomCurve) {
  for (const bool closed : {false, true}) {
    const std::vector<glm::dvec2> p = places(12, 3);
    const Curve curve(p, centripetal_knots(p, closed), closed);
    ASSERT_EQ(curve.spans(), closed ? 12u : 11u);
    for (std::size_t i = 0; i < curve.spans(); ++i) {
      if (!closed && (i == 0 || i + 2 == p.size())) continue;
      const auto at = [&](std::size_t k) { return flat(p[k % p.size()]); };
      for (double u = 0.0; u <= 1.0; u += 0.0625) {
        const Flat truth = test::pyramid(at(i + p.size() - 1), at(i), at(i + 1), at(i + 2), u);
        EXPECT_NEAR(curve.place(i, u).x, truth.x, 1e-10);
        EXPECT_NEAR(curve.place(i, u).y, truth.z, 1e-10);
      }
    }
  }
}

// Control: a derivative that takes the span's first tangent at its end too has a corner at every point.
TEST(Curve, GoesThroughItsPointsWithoutACorner) {
  for (const bool closed : {false, true}) {
    const std::vector<glm::dvec2> p = places(40, 5);
    const Curve curve(p, centripetal_knots(p, closed), closed);
    for (std::size_t i = 0; i < curve.spans(); ++i) {
      EXPECT_NEAR(glm::distance(curve.place(i, 0.0), p[i]), 0.0, 1e-12);
      EXPECT_NEAR(glm::distance(curve.place(i, 1.0), p[(i + 1) % p.size()]), 0.0, 1e-12);
      if (i + 1 == curve.spans() && !closed) continue;
      const std::size_t next = (i + 1) % curve.spans();
      const glm::dvec2 before = glm::normalize(curve.derivative(i, 1.0)),
                       after = glm::normalize(curve.derivative(next, 0.0));
      EXPECT_NEAR(glm::distance(before, after), 0.0, 1e-9) << i;
    }
  }
}

TEST(Curve, ItsDerivativesAreThose) {
  const std::vector<glm::dvec2> p = places(6, 9);
  const Curve curve(p, centripetal_knots(p, false), false);
  for (std::size_t i = 0; i < curve.spans(); ++i)
    for (double u = 0.1; u < 1.0; u += 0.2) {
      const glm::dvec2 slope = (curve.place(i, u + 1e-5) - curve.place(i, u - 1e-5)) / 2e-5;
      const glm::dvec2 bend = (curve.derivative(i, u + 1e-5) - curve.derivative(i, u - 1e-5)) / 2e-5;
      EXPECT_LT(glm::distance(slope, curve.derivative(i, u)), 1e-5);
      EXPECT_LT(glm::distance(bend, curve.second(i, u)), 1e-4);
    }
}

// Control: half as many chords are off by 0.013 of the length for 0.004.
TEST(Curve, ChordsAreAsNearAsAskedFor) {
  const std::vector<glm::dvec2> p = places(40, 7);
  const Curve curve(p, centripetal_knots(p, true), true);
  double worst = 0.0;
  for (std::size_t i = 0; i < curve.spans(); ++i) {
    const int n = curve.chords(i, 0.004);
    if (n == 64) continue;  // the most there are
    double length = 0.0;
    for (double u = 0.0; u < 1.0; u += 1.0 / 256)
      length += glm::distance(curve.place(i, u), curve.place(i, u + 1.0 / 256));
    for (int k = 0; k < n; ++k)
      for (double s = 0.0; s <= 1.0; s += 0.125) {
        const glm::dvec2 on_chord = glm::mix(curve.place(i, double(k) / n), curve.place(i, double(k + 1) / n), s);
        worst = std::max(worst, glm::distance(on_chord, curve.place(i, (k + s) / n)) / length);
      }
  }
  EXPECT_LT(worst, 0.004);
  EXPECT_GT(worst, 0.0005) << "chords are not cut for nothing";
}

// Control: the plain mean of the two secants for a slope climbs where the values fall or stay.
TEST(Curve, NumbersNeverPassBeyondTheirPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(0.1, 9.0), fall(0.0, 30.0);
  std::vector<double> knots{0.0}, values{100.0};
  for (int i = 0; i < 60; ++i)
    knots.push_back(knots.back() + step(random)), values.push_back(values.back() - (i % 7 == 0 ? 0.0 : fall(random)));
  const std::vector<double> slopes = monotone_slopes(values, knots, false);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double h = knots[i + 1] - knots[i];
    double before = values[i];
    for (double u = 0.0; u <= 1.0; u += 0.01) {
      const double here = hermite(values[i], values[i + 1], slopes[i] * h, slopes[i + 1] * h, u);
      EXPECT_LE(here, before + 1e-9) << i << " " << u;
      before = here;
    }
    EXPECT_NEAR(hermite(values[i], values[i + 1], slopes[i] * h, slopes[i + 1] * h, 1.0), values[i + 1], 1e-12);
  }
}

}  // namespace
}  // namespace seascape
