// The earth's curve against the exact sphere, there and back.
#include "shaders/shared/earth_curve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

constexpr double radius_m = 6371000.0, curvature = 1.0 / radius_m;

struct Point {
  double flat_m, above_m;  // along the surface from the viewer, above the still sea
};

// From a metre to beyond the horizon of 20 km, from the trough of a storm to the highest viewer.
template <typename Check>
void for_points(const Check& check) {
  for (double flat_m = 0.5; flat_m < 9.4e5; flat_m *= 1.9)
    for (const double above_m : {-30.0, -1.0, 0.0, 2.5, 300.0, 20000.0}) check(Point{flat_m, above_m});
}

// x, y of the point in the plane of the viewer's plumb line, from the still sea beneath the viewer.
struct Exact {
  double along, up;
};
Exact exact(const Point& p) {
  const double angle = p.flat_m / radius_m, half = std::sin(0.5 * angle);
  return {(radius_m + p.above_m) * std::sin(angle), p.above_m * std::cos(angle) - 2.0 * radius_m * half * half};
}

// Single precision keeps six digits; of the height as many as of the sea's fall. Controls seen, each fails here: the
// sine's and the fall's highest terms left out (from 6.8e5 m on).
TEST(EarthCurve, IsTheSphere) {
  for_points([](const Point& p) {
    const glm::vec3 place =
        gpu::curved({0.6f * float(p.flat_m), -0.8f * float(p.flat_m)}, float(p.above_m), float(curvature));
    const Exact e = exact(p);
    EXPECT_NEAR(place.x, 0.6 * e.along, 4e-7 * e.along + 1e-6) << p.flat_m << " m, " << p.above_m << " m high";
    EXPECT_NEAR(place.z, -0.8 * e.along, 4e-7 * e.along + 1e-6) << p.flat_m << " m, " << p.above_m << " m high";
    EXPECT_NEAR(place.y, e.up, 5e-7 * (std::abs(p.above_m) + std::abs(e.up - p.above_m)) + 1e-6)
        << p.flat_m << " m, " << p.above_m << " m high";
  });
}

// Controls seen: without the arc sine's terms after the first (from 3.6e5 m on), the height as a difference of
// distances from the earth's centre (everywhere).
TEST(EarthCurve, TheWayBackEndsWhereItBegan) {
  for_points([](const Point& p) {
    const Exact e = exact(p);
    const glm::vec3 back =
        gpu::flattened({0.6f * float(e.along), float(e.up), -0.8f * float(e.along)}, float(curvature));
    EXPECT_NEAR(back.x, 0.6 * p.flat_m, 5e-7 * p.flat_m + 1e-6) << p.flat_m << " m, " << p.above_m << " m high";
    EXPECT_NEAR(back.z, -0.8 * p.flat_m, 5e-7 * p.flat_m + 1e-6) << p.flat_m << " m, " << p.above_m << " m high";
    // What the place itself has lost to single precision is lost.
    EXPECT_NEAR(back.y, p.above_m, 4e-7 * (std::abs(e.up) + 0.15 * e.along + std::abs(p.above_m)) + 1e-6)
        << p.flat_m << " m, " << p.above_m << " m high";
  });
}

TEST(EarthCurve, AFlatEarthChangesNothing) {
  const glm::vec3 there = gpu::curved({3.0f, -4.0f}, 2.0f, 0.0f);
  EXPECT_EQ(there, glm::vec3(3.0f, 2.0f, -4.0f));
  EXPECT_EQ(gpu::flattened(there, 0.0f), glm::vec3(3.0f, 2.0f, -4.0f));
}

}  // namespace
}  // namespace seascape
