// Where the water is looked for that passes an eye's near plane.
#include "ocean/surface/eyes_in.h"

#include <gtest/gtest.h>

#include <random>

namespace seascape {
namespace {

// Eyes turned to all sides over water that leans by up to 27 degrees: the places of the picture where the near plane
// passes the water rest in the rectangle, though the water is drawn out by 0.45 and shifted by what is unsure. The
// rectangle of level eyes is smaller than the square that the picture's corners would reach. Controls seen: no margin
// for what is drawn out; the line looked for below the picture and not above it; its middle alone.
TEST(NearWater, HoldsWhatTheNearPlanePasses) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  constexpr double near_m = 0.1, unsure_m = 0.02;
  int passed = 0, small = 0, level = 0;
  for (int n = 0; n < 2000; ++n) {
    const double pitch = n % 4 == 0 ? 0.0 : 1.3 * unit(random);
    const View eye{{glm::dvec3(0.0), glm::angleAxis(3.14 * unit(random), y) * glm::angleAxis(pitch, x) *
                                         glm::angleAxis(unit(random), z)},
                   symmetric_fov(100.0, 1680.0 / 1760.0)};
    const glm::dvec3 over((pitch == 0.0 ? 0.02 : 0.12) * unit(random), 0.36 * unit(random), 0.36 * unit(random));
    const double reach_m = near_m * std::hypot(1.0, eye.fov.right, eye.fov.up);
    const NearWater near = near_water(eye, near_m, reach_m, over, unsure_m);
    if (pitch == 0.0) ++level, small += 4.0 * near.half_m.x * near.half_m.y < std::pow(3.0 * reach_m, 2);
    for (double across = -1.0; across <= 1.0; across += 0.25)
      for (double up = -1.0; up < 1.0; up += 0.02) {
        const auto on = [&](double v) {
          return eye.pose.orientation * (near_m * glm::dvec3(across * eye.fov.right, v * eye.fov.up, -1.0));
        };
        const auto wet = [&](const glm::dvec3& p) { return p.y < over.x + over.y * p.x + over.z * p.z; };
        const glm::dvec3 p = on(up);
        if (wet(p) == wet(on(up + 0.02))) continue;
        ++passed;
        for (const glm::dvec2 away :
             {glm::dvec2(1.0, 0.0), glm::dvec2(-1.0, 0.0), glm::dvec2(0.0, 1.0), glm::dvec2(0.0, -1.0)}) {
          const glm::dvec2 rest = glm::dvec2(p.x, p.z) + (0.45 * std::hypot(p.x, p.z) + unsure_m) * away;
          ASSERT_TRUE(near.touches(rest, rest)) << n << ": " << rest.x << " " << rest.y;
        }
      }
  }
  EXPECT_GT(passed, 5000);
  EXPECT_GT(small, 0.9 * level);
}

// Against all corners and a fine net of places. Control seen: the fourth axis left out.
TEST(NearWater, TouchesWhatItOverlaps) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int touched = 0, apart = 0;
  for (int n = 0; n < 3000; ++n) {
    const double turn = 6.3 * unit(random);
    const NearWater water{
        {unit(random), unit(random)}, {std::cos(turn), std::sin(turn)}, {0.4 * unit(random), 0.1 * unit(random)}};
    const glm::dvec2 least(2.0 * unit(random) - 0.5, 2.0 * unit(random) - 0.5), most = least + 0.3 * unit(random);
    bool overlaps = false;  // a place of the one in the other, of a net of a thousandth
    const glm::dvec2 beside(-water.across.y, water.across.x);
    for (int i = -20; i <= 20 && !overlaps; ++i)
      for (int j = -20; j <= 20 && !overlaps; ++j) {
        const glm::dvec2 at =
            water.rest_m + water.half_m.x * i / 20.0 * water.across + water.half_m.y * j / 20.0 * beside;
        overlaps = glm::all(glm::greaterThanEqual(at, least)) && glm::all(glm::lessThanEqual(at, most));
        const glm::dvec2 of_box = least + (most - least) * glm::dvec2(i + 20, j + 20) / 40.0 - water.rest_m;
        overlaps = overlaps || (std::abs(glm::dot(of_box, water.across)) <= water.half_m.x &&
                                std::abs(glm::dot(of_box, beside)) <= water.half_m.y);
      }
    if (overlaps) {
      EXPECT_TRUE(water.touches(least, most)) << n;
      ++touched;
    }
    apart += !water.touches(least, most);
    // Boxes that it calls touched though a wider one, by a net's step, is not overlapped, would be wrong.
    const glm::dvec2 step = 0.03 + (most - least) / 40.0;
    if (!overlaps && water.touches(least + step, most - step) && glm::all(glm::greaterThan(most - step, least + step)))
      ADD_FAILURE() << n;
  }
  EXPECT_GT(touched, 100);
  EXPECT_GT(apart, 1000);
}

}  // namespace
}  // namespace seascape
