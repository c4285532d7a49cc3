// Where a place lies along curves: what a straight one and a circle say exactly, gradients, and that nothing ever jumps
// where there are waves.
#include "ocean/places/shore_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace seascape {
namespace {

constexpr double period = 40.0;

InputSpec spline(const std::vector<glm::dvec2>& points, double width, double feather, bool closed = false,
                 double value = 1.0) {
  InputSpec spec;
  spec.to = InputTarget::gerstner;
  spec.feather_m = feather;
  SplineInput shape;
  shape.closed = closed;
  for (const glm::dvec2 at : points) shape.points.push_back({at, width, glm::vec4(float(value), 0.0f, 0.0f, 0.0f)});
  spec.shape = shape;
  return spec;
}

std::vector<glm::dvec2> circle(double radius, int points, double direction = 1.0) {
  std::vector<glm::dvec2> result;
  for (int i = 0; i < points; ++i) {
    const double angle = direction * 2.0 * std::numbers::pi * i / points;
    result.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return result;
}

ShoreLines lines(const std::vector<InputSpec>& specs) { return {specs, period}; }

// A bay with a hook, a hairpin, and two that cross.
std::vector<InputSpec> tangle() {
  return {spline({{-80, 0}, {-40, -6}, {-20, -40}, {10, -44}, {22, -10}, {30, 30}, {70, 34}, {80, 0}}, 36.0, 8.0),
          spline({{-90, 60}, {0, 66}, {40, 76}, {0, 90}, {-90, 92}}, 30.0, 6.0, false, 0.7),
          spline({{-60, -70}, {0, 40}, {20, 120}}, 24.0, 10.0)};
}

// Control seen: right taken for left.
TEST(ShoreLines, AStraightCurveLeavesThePlaneAsItIs) {
  const ShoreLines straight = lines({spline({{0, 0}, {50, 0}, {200, 0}}, 40.0, 5.0)});
  ASSERT_FALSE(straight.empty());
  for (const glm::dvec2 at :
       {glm::dvec2(30.0, 0.0), glm::dvec2(71.3, -12.0), glm::dvec2(140.0, 14.9), glm::dvec2(10.0, 3.0)}) {
    const ShorePlace place = straight.at(at, 0.0);
    EXPECT_NEAR(glm::distance(place.bent_m, at), 0.0, 1e-9);
    EXPECT_NEAR(place.share, 1.0f, 1e-6f);
    EXPECT_NEAR(place.stretch, 1.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(place.forward, glm::dvec2(1.0, 0.0)), 0.0, 1e-12);
    EXPECT_NEAR(place.turning_per_m, 0.0, 1e-12);
  }
  // The share is that of other splines' soft edges, and of the ends'.
  EXPECT_NEAR(straight.at({100.0, 17.5}, 0.0).share, 0.5f, 1e-6f);
  EXPECT_NEAR(straight.at({2.5, 0.0}, 0.0).share, 0.5f, 1e-6f);
  EXPECT_NEAR(straight.at({197.5, 0.0}, 0.0).share, 0.5f, 1e-6f);
  // Beyond its width and its ends there is nothing.
  for (const glm::dvec2 at : {glm::dvec2(100.0, 20.1), glm::dvec2(100.0, -20.1), glm::dvec2(-0.1, 0.0),
                              glm::dvec2(200.1, 0.0), glm::dvec2(1e6, 1e6), glm::dvec2(std::nan(""), 0.0)})
    EXPECT_EQ(straight.at(at, 0.0).share, 0.0f) << at.x << ' ' << at.y;
  // Seen with a wide footprint it has no edge sharper than that, and coordinates beyond it too.
  EXPECT_GT(straight.at({100.0, 21.0}, 8.0).share, 0.0f);
  EXPECT_NEAR(straight.at({100.0, 30.0}, 8.0).bent_m.y, 30.0, 1e-9);
  EXPECT_NEAR(straight.at({-6.0, 3.0}, 8.0).bent_m.x, -6.0, 1e-9);
}

// Along a circle, either way about: distance and way are the radius' and the angle's, the pattern closes, its stretch
// is that of the radius, and it has no seam. Control seen: a pattern that is not stretched to close.
TEST(ShoreLines, ACircleHasNoSeam) {
  for (const double direction : {1.0, -1.0}) {
    const double radius = 50.0;
    const ShoreLines round = lines({spline(circle(radius, 24, direction), 24.0, 6.0, true)});
    const double scale =
        period * std::round(2.0 * std::numbers::pi * radius / period) / (2.0 * std::numbers::pi * radius);
    double before = 0.0, worst = 0.0;
    for (int i = 0; i <= 7200; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 7200, r = radius + 5.0 * std::sin(3.0 * angle);
      const ShorePlace place = round.at({r * std::cos(angle), r * std::sin(angle)}, 0.0);
      EXPECT_NEAR(place.bent_m.y, direction * (radius - r), 0.02)
          << "the middle lies to the right of a curve that goes clockwise";  // x to the east, z to the south
      EXPECT_NEAR(double(place.stretch), scale * radius / r, 0.02);
      EXPECT_GT(place.share, 0.5f);
      const double turn = place.bent_m.x / period;
      if (i > 0) worst = std::max(worst, std::abs((turn - before) - std::round(turn - before)));
      before = turn;
    }
    EXPECT_LT(worst, 0.003);
  }
  // One shorter than the pattern has none of it along its crests.
  const ShoreLines islet = lines({spline(circle(4.0, 12), 6.0, 1.0, true)});
  EXPECT_EQ(islet.at({4.2, 0.0}, 0.0).stretch, 0.0f);
  EXPECT_EQ(islet.at({0.0, -4.2}, 0.0).bent_m.x, 0.0);
}

// What coordinates and direction change by is what is said of it. Controls seen: the stretch of the other side of a
// bend; the turning's sign.
TEST(ShoreLines, GradientsAreThoseOfTheCoordinates) {
  const ShoreLines bent = lines(tangle());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-100.0, 130.0);
  int seen = 0;
  for (int i = 0; i < 20000 && seen < 1500; ++i) {
    const glm::dvec2 p(at(random), at(random));
    const ShorePlace here = bent.at(p, 0.0);
    if (here.share < 0.2f) continue;
    ++seen;
    const double e = 1e-4;
    const auto moved = [&](glm::dvec2 way) {
      return (bent.at(p + e * way, 0.0).bent_m - bent.at(p - e * way, 0.0).bent_m) / (2.0 * e);
    };
    const glm::dvec2 along = moved(here.forward), across = moved(here.right());
    ASSERT_LT(glm::distance(along, glm::dvec2(double(here.stretch), 0.0)), 0.02 * double(here.stretch))
        << p.x << ' ' << p.y;  // where the curve's bend has a step
    ASSERT_LT(glm::distance(across, glm::dvec2(0.0, 1.0)), 1e-5) << p.x << ' ' << p.y;
    const glm::dvec2 turned =
        (bent.at(p + e * here.forward, 0.0).forward - bent.at(p - e * here.forward, 0.0).forward) / (2.0 * e);
    ASSERT_NEAR(glm::dot(turned, here.right()), here.turning_per_m, 0.01) << p.x << ' ' << p.y;
  }
  EXPECT_GE(seen, 1000);
}

// Along any way the share changes no faster than its soft edges, and coordinates jump only where there are no waves:
// from one side of a bay to the other, from one spline to another, at the middle of a bend. Controls seen: the next
// best curve takes nothing away (25 jumps, a share that changes by 22 a metre); a bend's inner side with all of its
// waves (24, 33).
TEST(ShoreLines, NothingJumpsWhereThereAreWaves) {
  const ShoreLines bent = lines(tangle());
  int waves = 0, jumps = 0;
  double steepest = 0.0, most = 0.0;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-100.0, 130.0);
  for (int walk = 0; walk < 60; ++walk) {
    const glm::dvec2 from(any(random), any(random)), to(any(random), any(random));
    const double step = 0.02;
    const int steps = int(glm::distance(from, to) / step);
    ShorePlace last = bent.at(from, 0.0);
    for (int i = 1; i <= steps; ++i) {
      const ShorePlace here = bent.at(from + (to - from) * (double(i) / steps), 0.0);
      waves += here.share > 0.5f;
      steepest = std::max(steepest, double(std::abs(here.share - last.share)) / step);
      // Where both have waves, coordinates go on by no more than the stretch.
      if (here.share > 0.0f && last.share > 0.0f && glm::distance(here.bent_m, last.bent_m) > 5.0 * step)
        ++jumps, most = std::max(most, double(std::min(here.share, last.share)));
      last = here;
    }
  }
  EXPECT_GT(waves, 20000);
  EXPECT_EQ(jumps, 0) << most;
  EXPECT_LT(steepest, 1.0) << "1.5 / 6 m of a soft edge, and where two meet a few times that";
}

// Seen from above water comes to the left of the curve: a test of the rule that docs/inputs.md states, by the pattern's
// axes.
TEST(ShoreLines, TheShoreIsToTheLeft) {
  const ShoreLines north = lines({spline({{0, 0}, {0, -100}}, 40.0, 5.0)});  // to -z, so that left is -x
  const ShorePlace left = north.at({-10.0, -50.0}, 0.0);
  EXPECT_NEAR(left.bent_m.y, -10.0, 1e-9) << "the pattern's -z";
  EXPECT_NEAR(left.bent_m.x, 50.0, 1e-9);
}

}  // namespace
}  // namespace seascape
