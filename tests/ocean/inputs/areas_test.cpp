// Ellipses, rectangles and whirlpools against their areas, their edges and Rankine's formula.
#include <gtest/gtest.h>

#include <numbers>

#include "ocean/inputs/inputs.h"
#include "ocean/inputs/soft_edge.h"
#include "tests/support/input_truth.h"

namespace seascape {
namespace {

InputSpec area(bool round, glm::dvec2 at, glm::dvec2 size, double turn = 0.0) {
  InputSpec spec;
  spec.where = "here";
  spec.value = {1.0f, 0.0f, 0.0f, 0.0f};
  spec.shape = AreaInput{.round = round, .at_m = at, .size_m = size, .turn_deg = turn};
  return spec;
}
double at(const Inputs& inputs, glm::dvec2 place, double footprint = 0.0) {
  return inputs.value(place, footprint, 0.0, glm::vec4(0.0f)).x;
}
double summed(const Inputs& inputs, glm::dvec2 middle, double reach, double step, double footprint) {
  double sum = 0.0;
  for (double x = -reach + 0.5 * step; x < reach; x += step)
    for (double z = -reach + 0.5 * step; z < reach; z += step) sum += at(inputs, middle + glm::dvec2(x, z), footprint);
  return sum * step * step;
}

// What is summed over the plane is the shape's area, seen sharp or with a footprint far wider than the shape. Control:
// without disc_factor() the disc of 6 m is 6.5 times too much with a footprint of 10 m.
TEST(InputAreas, CoverTheirAreaAtAnyFootprint) {
  const glm::dvec2 middle{1234.5, -77.25};
  for (const double footprint : {0.0, 0.5, 3.0, 10.0, 40.0}) {
    const double step = footprint > 3.0 ? 0.25 : 0.06, reach = 12.0 + 0.5 * footprint;
    const double disc =
        summed(Inputs(InputTarget::level, std::vector{area(true, middle, {6.0, 6.0})}), middle, reach, step, footprint);
    EXPECT_NEAR(disc / (9.0 * std::numbers::pi), 1.0, 4e-3) << footprint;
    const double rectangle = summed(Inputs(InputTarget::level, std::vector{area(false, middle, {2.0, 9.0}, 30.0)}),
                                    middle, reach, step, footprint);
    EXPECT_NEAR(rectangle / 18.0, 1.0, 4e-3) << footprint;
  }
  const double ellipse =
      summed(Inputs(InputTarget::level, std::vector{area(true, middle, {3.0, 12.0}, -50.0)}), middle, 8.0, 0.03, 0.0);
  EXPECT_NEAR(ellipse / (9.0 * std::numbers::pi), 1.0, 2e-3);
}

// Turned clockwise seen from above: what points to -z points to +x after 90 degrees. Control: the sine's sign the other
// way round fails at 30 degrees.
TEST(InputAreas, TurnClockwise) {
  const Inputs quarter(InputTarget::level, std::vector{area(false, {0.0, 0.0}, {1.0, 20.0}, 90.0)});
  EXPECT_EQ(at(quarter, {9.0, 0.0}), 1.0);
  EXPECT_EQ(at(quarter, {0.0, -9.0}), 0.0);
  const Inputs some(InputTarget::level, std::vector{area(false, {0.0, 0.0}, {1.0, 20.0}, 30.0)});
  EXPECT_EQ(at(some, {4.5, -4.5 * std::sqrt(3.0)}), 1.0) << "30 degrees clockwise from -z";
  EXPECT_EQ(at(some, {-4.5, -4.5 * std::sqrt(3.0)}), 0.0);
}

// The soft edge lies inside, is continuous and has no corner; with a wide footprint too. Control: soft_share() about
// the edge, not inside of it, covers places beyond the edge.
TEST(InputAreas, TheSoftEdgeLiesInside) {
  for (const bool round : {true, false}) {
    InputSpec spec = area(round, {0.0, 0.0}, {20.0, 20.0});
    spec.feather_m = 4.0;
    const Inputs inputs(InputTarget::level, std::vector{spec});
    EXPECT_EQ(at(inputs, {10.0, 0.0}), 0.0);
    EXPECT_EQ(at(inputs, {6.0, 0.0}), 1.0);
    for (double x = 5.0; x < 11.0; x += 0.1)
      EXPECT_NEAR(at(inputs, {x, 0.0}), test::smooth((10.0 - x) / 4.0), 1e-6) << x;
    for (const double footprint : {0.0, 2.0, 9.0, 70.0}) {
      double before = at(inputs, {0.0, 0.0}, footprint), slope = 0.0;
      for (double x = 0.01; x < 60.0; x += 0.01) {
        const double here = at(inputs, {x, 0.3 * x}, footprint), now = (here - before) / 0.01;
        EXPECT_LT(std::abs(here - before), 0.006) << x;
        if (footprint < 5.0) {
          EXPECT_LT(std::abs(now - slope), 0.02) << x;
        }
        before = here, slope = now;
      }
    }
  }
}

InputSpec whirlpool(double inflow = 0.0) {
  InputSpec spec;
  spec.to = InputTarget::flow;
  spec.where = "here";
  spec.feather_m = 40.0;
  spec.shape =
      VortexInput{.at_m = {100.0, 200.0}, .core_m = 5.0, .reach_m = 90.0, .swirl_mps = 3.0, .inflow_mps = inflow};
  return spec;
}

// Control: an r for the core's square (a profile with a jump at the core) is off by 12 m/s.
TEST(InputAreas, AWhirlpoolIsRankines) {
  const Inputs inputs(InputTarget::flow, std::vector{whirlpool()});
  double worst = 0.0;
  for (double x = -30.0; x <= 30.0; x += 0.37)
    for (double z = -30.0; z <= 30.0; z += 0.41) {
      const glm::vec4 v = inputs.value({100.0 + x, 200.0 + z}, 0.0, 0.0, glm::vec4(0.0f));
      const test::Flat truth = test::rankine({x, z}, 5.0, 3.0);
      worst = std::max(worst, std::hypot(v.x - truth.x, v.y - truth.z));
    }
  EXPECT_LT(worst, 1e-5);
}

// Round any square nothing goes in or out of a whirlpool, and within its reach its soft end changes nothing of that;
// one with an inflow takes in as much through any circle between its core and its end. Control: a share that falls off
// along x alone lets 0.07 m2/s out of a square.
TEST(InputAreas, AWhirlpoolKeepsTheWater) {
  const Inputs swirl(InputTarget::flow, std::vector{whirlpool()});
  const auto v = [](const Inputs& inputs, double x, double z) {
    return glm::dvec2(glm::vec2(inputs.value({100.0 + x, 200.0 + z}, 0.0, 0.0, glm::vec4(0.0f))));
  };
  double worst = 0.0;
  for (const glm::dvec2 middle :
       {glm::dvec2(1.0, 0.5), glm::dvec2(12.0, -7.0), glm::dvec2(60.0, 20.0), glm::dvec2(-80.0, 30.0)}) {
    double out = 0.0;
    const double half = 3.0, step = 0.002;
    for (double s = -half + 0.5 * step; s < half; s += step)
      out += step * (v(swirl, middle.x + half, middle.y + s).x - v(swirl, middle.x - half, middle.y + s).x +
                     v(swirl, middle.x + s, middle.y + half).y - v(swirl, middle.x + s, middle.y - half).y);
    worst = std::max(worst, std::abs(out));
  }
  EXPECT_LT(worst, 1e-3) << "of 3 m/s x 6 m, in m2/s";

  const Inputs sink(InputTarget::flow, std::vector{whirlpool(0.5)});
  for (const double r : {5.0, 12.0, 49.0}) {
    double in = 0.0;
    for (int i = 0; i < 720; ++i) {
      const double angle = i * std::numbers::pi / 360.0, x = std::cos(angle), z = std::sin(angle);
      in -= glm::dot(v(sink, r * x, r * z), glm::dvec2(x, z)) * r * std::numbers::pi / 360.0;
    }
    EXPECT_NEAR(in, 0.5 * 2.0 * std::numbers::pi * 5.0, 1e-3) << r;
  }
}

}  // namespace
}  // namespace seascape
