// Pockets of air where their things stand, and how high water stands in bells.
#include "app/water_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seascape {
namespace {

constexpr double atmosphere_m = 10.08;

PlacedShape box(const glm::dvec3& sides_m, const glm::dvec3& at_m) {
  PlacedShape shape;
  shape.form = gpu::shape_box;
  shape.half_m = 0.5 * sides_m;
  shape.radius_m = glm::length(shape.half_m);
  shape.pose.position_m = at_m;
  return shape;
}

// Whether a place of the world (m) is in a pocket of air, under a sea that lies still at y = 0.
bool in_air_pocket(const SceneShapes& shapes, const SceneObjects& objects, const glm::dvec3& at_m) {
  if (shapes.air.empty()) return false;
  const gpu::WaterShapes placed = placed_shapes(shapes, objects, at_m, nullptr);
  return WaterLines{placed, int(shapes.air.size())}.in_air(glm::dvec3(0.0));
}

// Where a column of air `high` m high comes to rest whose top is `top` m deep: its air is x m high, and x/high =
// 10.08/(10.08 + top + x) (facts/underwater.md, section 5). Control seen: the depth of the top in place of the water's.
TEST(WaterShapes, ABoxedBellFillsAsBoyleHasIt) {
  for (const double top_m : {0.0, 3.0, 9.0, 40.0})
    for (const double high_m : {1.0, 2.5, 8.0}) {
      SceneShapes shapes;
      shapes.air.push_back(box({2.0, high_m, 3.0}, {4.0, -top_m - 0.5 * high_m, -7.0}));
      shapes.air.back().open_below = true;
      const glm::dvec3 viewer(3.0, 2.0, 1.0);
      const gpu::WaterShapes placed = placed_shapes(shapes, {}, viewer, nullptr);
      const double b = atmosphere_m + top_m, x = 0.5 * (std::sqrt(b * b + 4.0 * high_m * atmosphere_m) - b);
      EXPECT_NEAR(double(placed.air[0].water.x) + viewer.y, -top_m - x, 1e-4) << top_m << " " << high_m;
    }
}

// A round bell, by the volume of a ball's cap, to 1 % of its height. Control seen: the depth of its top in
// place of the water's.
TEST(WaterShapes, ARoundBellFillsAsBoyleHasIt) {
  for (const double depth_m : {5.0, 20.0}) {
    SceneShapes shapes;
    PlacedShape ball = box({3.0, 3.0, 3.0}, {0.0, -depth_m, 0.0});
    ball.form = gpu::shape_sphere;
    ball.radius_m = 1.5;
    ball.open_below = true;
    shapes.air.push_back(ball);
    const double level = double(placed_shapes(shapes, {}, {}, nullptr).air[0].water.x), cap = -depth_m + 1.5 - level,
                 share = cap * cap * (3.0 * 1.5 - cap) / (4.0 * 1.5 * 1.5 * 1.5);
    EXPECT_NEAR(share, atmosphere_m / (atmosphere_m - level), 0.01) << depth_m;
  }
}

// On a thing it moves and turns with it, and its own water stays level. Control seen: the thing's turn left out.
TEST(WaterShapes, PocketsGoWithTheirThing) {
  SceneShapes shapes;
  shapes.air.push_back(box({2.0, 2.0, 6.0}, {0.0, -1.0, 0.0}));
  shapes.air.back().on = 1;
  SceneObjects objects;
  objects.things.resize(2);
  Pose& boat = objects.things[1].pose;
  boat = {{100.0, 0.5, -40.0}, glm::angleAxis(glm::radians(30.0), glm::dvec3(0.0, 0.0, 1.0))};
  const auto at = [&](const glm::dvec3& own) { return composed(boat, Pose{own}).position_m; };
  EXPECT_TRUE(in_air_pocket(shapes, objects, at({0.9, -1.9, 2.9})));
  EXPECT_TRUE(in_air_pocket(shapes, objects, at({-0.9, -0.1, -2.9})));
  EXPECT_FALSE(in_air_pocket(shapes, objects, at({1.1, -1.0, 0.0})));
  EXPECT_FALSE(in_air_pocket(shapes, objects, at({0.0, -2.1, 0.0})));
  EXPECT_FALSE(in_air_pocket(shapes, objects, {0.0, -1.0, 0.0}));
  // Water 0.5 m under its middle: the lower corner is under it, the higher one is not, both 0.4 m under the middle.
  shapes.air.back().level_m = -0.5;
  EXPECT_TRUE(in_air_pocket(shapes, objects, at({0.8, -1.4, 0.0})));
  EXPECT_FALSE(in_air_pocket(shapes, objects, at({-0.8, -1.4, 0.0})));
}

// Where a pocket comes up to the surface each pixel is asked; deep ones leave the eyes' side; portals in sight ask
// always, and out of sight or turned away nothing. The surface is seen from above by eyes that are not all deep in the
// water, and through what comes up to it. Controls seen: each other's case; a portal's front not asked for; portals
// behind the eyes taken for seen; what is deep taken to come up.
TEST(WaterShapes, TheEyesSideKnowsThem) {
  Viewpoint viewpoint;
  viewpoint.viewer.position_m = {0.0, -6.0, 0.0};
  View eye;
  eye.pose.position_m = viewpoint.viewer.position_m;
  eye.fov = symmetric_fov(60.0, 1.5);
  viewpoint.eyes = {eye};
  const auto expect = [&](const SceneShapes& shapes, EyesIn eyes, EyesIn expected, bool from_above) {
    const gpu::WaterShapes placed = placed_shapes(shapes, {}, viewpoint.viewer.position_m, nullptr);
    const EyesAmongShapes among = eyes_among(eyes, shapes, placed, viewpoint, 1.0);
    EXPECT_EQ(among.eyes, expected);
    EXPECT_EQ(among.from_above, from_above);
    EXPECT_EQ(among.portals.any(), expected == EyesIn::either && !shapes.portals.empty());
  };
  SceneShapes deep, high, ahead, behind, high_ahead, with_high;
  deep.air.push_back(box({2, 2, 2}, {0, -6, 0}));
  high.air.push_back(box({2, 2, 2}, {0, -2, 0}));
  ahead.portals.push_back(box({2, 2, 2}, {0, -6, -9}));
  const glm::dquat turned_round = glm::angleAxis(glm::radians(180.0), glm::dvec3(0.0, 1.0, 0.0));
  behind.portals.push_back(box({2, 2, 2}, {0, -6, 9}));
  behind.portals.back().pose.orientation = turned_round;
  high_ahead.portals.push_back(box({2, 2, 2}, {0, -2, -9}));
  with_high = ahead;
  with_high.air = high.air;
  expect(deep, EyesIn::water, EyesIn::water, false);
  expect(high, EyesIn::water, EyesIn::either, true);
  expect(high, EyesIn::air, EyesIn::air, true);
  expect(deep, EyesIn::either, EyesIn::either, true);
  expect(ahead, EyesIn::air, EyesIn::either, false);
  expect(ahead, EyesIn::water, EyesIn::either, false);
  expect(behind, EyesIn::water, EyesIn::air, false);
  expect(high_ahead, EyesIn::water, EyesIn::either, true);
  expect(with_high, EyesIn::water, EyesIn::either, true);
  SceneShapes faces_us = ahead;
  faces_us.portals.back().form = gpu::shape_disc;
  faces_us.portals.back().mode = gpu::portal_front;
  expect(faces_us, EyesIn::water, EyesIn::either, false);
  SceneShapes faces_away = faces_us;
  faces_away.portals.back().pose.orientation = turned_round;
  expect(faces_away, EyesIn::water, EyesIn::air, false);
}

}  // namespace
}  // namespace seascape
