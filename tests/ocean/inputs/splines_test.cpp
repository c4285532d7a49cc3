// Bands along curves: through their points, as wide as they say, with the flow along them; and lakes that they
// surround.
#include <gtest/gtest.h>

#include <random>

#include "ocean/inputs/inputs.h"
#include "tests/support/input_truth.h"

namespace seascape {
namespace {

using test::Flat;

InputSpec spline(InputTarget to, std::vector<SplinePoint> points, bool closed = false, bool filled = false) {
  InputSpec spec;
  spec.to = to;
  spec.where = "here";
  spec.shape = SplineInput{std::move(points), closed, filled};
  return spec;
}
SplinePoint point(double x, double z, double width, double value) {
  return {{x, z}, width, {float(value), 0.0f, 0.0f, 0.0f}};
}
glm::vec4 at(const Inputs& inputs, double x, double z, double footprint = 0.0) {
  return inputs.value({x, z}, footprint, 0.0, glm::vec4(0.0f));
}

// By how much a number lies outside of what two others bound.
double off_the_two(double a, double b, double value) {
  return std::max(std::min(a, b) - value, value - std::max(a, b));
}

const std::vector<SplinePoint> river{point(0, 0, 8, 30), point(40, 10, 10, 28), point(80, -20, 12, 20),
                                     point(150, 0, 20, 20), point(200, 60, 30, 5)};

// Where the band ends is measured from Barry and Goldman's curve, walked in small steps. Control: without Newton's
// steps values differ by 0.02 m across the river; with the width for half of it there is water where the land should
// be.
TEST(InputSplines, AreAsWideAndHighAsTheirPointsSay) {
  const Inputs inputs(InputTarget::level, std::vector{spline(InputTarget::level, river)});
  for (const SplinePoint& p : river) EXPECT_NEAR(at(inputs, p.at_m.x, p.at_m.y).x, p.value.x, 1e-5);
  const auto flat = [](const SplinePoint& p) { return Flat{p.at_m.x, p.at_m.y}; };
  for (std::size_t i = 1; i + 2 < river.size(); ++i)
    for (double s = 0.02; s < 1.0; s += 0.02) {
      const auto truth = [&](double u) {
        return test::pyramid(flat(river[i - 1]), flat(river[i]), flat(river[i + 1]), flat(river[i + 2]), u);
      };
      const Flat here = truth(s), before = truth(s - 1e-4), after = truth(s + 1e-4);
      const double dx = after.x - before.x, dz = after.z - before.z, length = std::hypot(dx, dz);
      const double half = 0.5 * std::min(river[i].width_m, river[i + 1].width_m),
                   wide = 0.5 * std::max(river[i].width_m, river[i + 1].width_m);
      for (const double side : {-1.0, 1.0}) {
        const auto off = [&](double by) {
          return at(inputs, here.x - side * by * dz / length, here.z + side * by * dx / length);
        };
        EXPECT_NE(off(0.99 * half).x, 0.0f) << i << " " << s;
        EXPECT_EQ(off(1.03 * wide).x, 0.0f) << i << " " << s;
        EXPECT_NEAR(off(0.5 * half).x, off(0.0).x, 2e-4) << "the same across the river";
      }
      EXPECT_LE(off_the_two(river[i].value.x, river[i + 1].value.x, at(inputs, here.x, here.z).x), 1e-5)
          << "between its points";
    }
}

// A straight canal is exact: its edges, its soft edge, and its values by Hermite's cubic.
TEST(InputSplines, AStraightOneIsExact) {
  InputSpec spec = spline(InputTarget::level, {point(0, 0, 10, 2), point(100, 0, 10, 4)});
  spec.feather_m = 2.0;
  const Inputs inputs(InputTarget::level, std::vector{spec});
  for (double x = 5.0; x < 100.0; x += 5.0)
    for (double z = -6.0; z < 6.0; z += 0.25)
      EXPECT_NEAR(at(inputs, x, z).x, (2.0 + 0.02 * x) * test::smooth((5.0 - std::abs(z)) / 2.0), 1e-5)
          << x << " " << z;
  EXPECT_NEAR(at(inputs, -2.0, 0.0).x, 2.0, 1e-5) << "its ends are round";
  EXPECT_EQ(at(inputs, -5.0, 0.0).x, 0.0f);
}

// Control: the derivative with its components swapped fails here.
TEST(InputSplines, FlowGoesAlongThem) {
  const Inputs inputs(InputTarget::flow,
                      std::vector{spline(InputTarget::flow, {point(0, 0, 20, 3), point(100, 0, 20, 3),
                                                             point(150, 50, 20, 3), point(150, 150, 20, 3)})});
  for (double x = 0.0; x <= 150.0; x += 1.0)
    for (double z = -10.0; z < 150.0; z += 1.0) {
      const glm::vec4 v = at(inputs, x, z);
      if (v.x != 0.0f || v.y != 0.0f) {
        EXPECT_NEAR(std::hypot(v.x, v.y), 3.0, 1e-5);
      }
    }
  EXPECT_GT(at(inputs, 30.0, 0.0).x, 2.9f);
  EXPECT_GT(at(inputs, 150.0, 130.0).y, 2.9f);
  EXPECT_NEAR(at(inputs, 100.0, 0.0).x, at(inputs, 100.01, 0.0).x, 0.01);
}

// A lake is what its curve surrounds: every place against the sum of angles, and the area. Control: an even number of
// crossings for an odd one fails everywhere; without the step away from the curve 3 places beside it are wrong.
TEST(InputSplines, AFilledOneIsWhatItSurrounds) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> radius(40.0, 90.0);
  std::vector<SplinePoint> shore;
  for (int i = 0; i < 24; ++i) {
    const double r = radius(random), angle = i * 6.283185307179586 / 24;
    shore.push_back(point(r * std::cos(angle), r * std::sin(angle), 1.0, 7.0));
  }
  std::vector<Flat> fine;
  for (std::size_t i = 0; i < 24; ++i) {
    const auto p = [&](std::size_t k) { return Flat{shore[k % 24].at_m.x, shore[k % 24].at_m.y}; };
    for (int k = 0; k < 400; ++k) fine.push_back(test::pyramid(p(i + 23), p(i), p(i + 1), p(i + 2), k / 400.0));
  }
  const Inputs inputs(InputTarget::level, std::vector{spline(InputTarget::level, shore, true, true)});
  std::uniform_real_distribution<double> place(-100.0, 100.0);
  int wrong = 0;
  for (int i = 0; i < 3000; ++i) {
    const Flat p{place(random), place(random)};
    wrong += (at(inputs, p.x, p.z).x == 7.0f) != test::polygon_holds(fine, p);
  }
  EXPECT_EQ(wrong, 0);
  int beside = 0, count = 0;
  for (std::size_t i = 0; i < fine.size(); i += 7)
    for (const double by : {1e-3, 1e-2, 5e-2}) {
      const Flat a = fine[(i + fine.size() - 1) % fine.size()], b = fine[(i + 1) % fine.size()];
      const double dx = b.x - a.x, dz = b.z - a.z, length = std::hypot(dx, dz);
      for (const double side :
           {-1.0, 1.0}) {  // angles grow from +x to +z: within is to the right of it, towards (-dz, dx)
        const float v = at(inputs, fine[i].x - side * by * dz / length, fine[i].z + side * by * dx / length).x;
        beside += (v == 7.0f) != (side > 0.0);
        ++count;
      }
    }
  EXPECT_EQ(beside, 0) << "of " << count;
  double sum = 0.0;
  for (double x = -100.0; x < 100.0; x += 0.5)
    for (double z = -100.0; z < 100.0; z += 0.5) sum += 0.25 * at(inputs, x, z).x / 7.0;
  EXPECT_NEAR(sum / test::polygon_area(fine), 1.0, 2e-3);
}

// A figure of eight surrounds both loops, whichever way round each goes, and keeps what it gives at a footprint wider
// than its feather: the integral over the plane stays within a tenth. Controls: loops of opposite sense taken off one
// another, or crossings of rows not sorted (nothing is left).
TEST(InputSplines, AFilledOneThatCrossesItselfKeepsBothItsLoops) {
  InputSpec spec =
      spline(InputTarget::foam,
             {point(-40, -20, 1, 1), point(-40, 20, 1, 1), point(40, -20, 1, 1), point(40, 20, 1, 1)}, true, true);
  spec.feather_m = 1.0;
  const Inputs inputs(InputTarget::foam, std::vector{spec});
  const auto integral = [&](double footprint) {
    double sum = 0.0;
    for (double x = -79.5; x < 80.0; x += 1.0)
      for (double z = -59.5; z < 60.0; z += 1.0) sum += double(at(inputs, x, z, footprint).x);
    return sum;
  };
  const double whole = integral(0.0);
  EXPECT_GT(whole, 1000.0);
  EXPECT_GT(at(inputs, 30.0, 0.0).x, 0.99f);
  EXPECT_GT(at(inputs, -30.0, 0.0).x, 0.99f);
  for (const double footprint : {2.0, 4.0, 8.0}) EXPECT_NEAR(integral(footprint), whole, 0.1 * whole) << footprint;
}

// One whose points lie on a line surrounds nothing, which is said; one that a micrometre opens, or that crosses itself,
// is there. Control seen: nothing said.
TEST(InputSplines, AFilledOneOnALineIsSaid) {
  const auto remarks = [](double off, bool filled) {
    const std::vector specs{
        spline(InputTarget::level,
               {point(7, -3, 5, 1), point(17, 2, 5, 1), point(-3, -8, 5, 1), point(37, 12 + off, 5, 1)}, true, filled)};
    return remarks_of(specs);
  };
  ASSERT_EQ(remarks(0.0, true).size(), 1u);
  EXPECT_NE(remarks(0.0, true)[0].find("here: a filled spline whose points lie on one line surrounds nothing"),
            std::string::npos);
  EXPECT_TRUE(remarks(0.0, false).empty());
  EXPECT_TRUE(remarks(1e-3, true).empty());
}

// Control: chords looked for no farther than half the width less their distance from the curve, instead of more, leave
// a step at the edge.
TEST(InputSplines, TheEdgeIsContinuousAtAnyFootprint) {
  std::vector<SplinePoint> bends = river;
  for (SplinePoint& p : bends) p.width_m = 20.0;
  InputSpec spec = spline(InputTarget::level, bends);
  spec.feather_m = 3.0;
  const Inputs inputs(InputTarget::level, std::vector{spec});
  for (const double footprint : {0.0, 1.0, 8.0, 50.0}) {
    float before = at(inputs, 60.0, -80.0, footprint).x, most = 0.0f;
    for (double z = -80.0; z < 80.0; z += 0.002) {
      const float here = at(inputs, 60.0 + 0.2 * z, z, footprint).x;
      EXPECT_LT(std::abs(here - before), 0.05f) << z;
      before = here, most = std::max(most, here);
    }
    EXPECT_GT(most, 1.0f);
  }
}

}  // namespace
}  // namespace seascape
