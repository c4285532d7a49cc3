// Pockets of air and portals, both eyes in one pass: what each eye draws alone, bit for bit.
#include <gtest/gtest.h>

#include "shaders/shared/water_line.h"
#include "tests/support/gpu/each_eye.h"
#include "tests/support/solid_maker.h"

namespace seascape {
namespace {

using test::pose;
using test::ShotOptions;

class WaterShapesStereo : public test::GpuTest {};

PlacedShape ball(double radius_m, const glm::dvec3& at_m) {
  PlacedShape shape;
  shape.form = gpu::shape_sphere;
  shape.half_m = glm::dvec3(radius_m);
  shape.radius_m = radius_m;
  shape.pose.position_m = at_m;
  return shape;
}

// The side of a pocket between the eyes, and a volume whose side is: each eye decides for itself. Control seen: the
// first eye's place for both in the line of sight through open water.
TEST_F(WaterShapesStereo, OnePassEqualsEachEyeAndMono) {
  for (const test::FrameLook& look : {test::frame_looks[0], test::frame_looks[1]})
    for (const bool portals : {false, true}) {
      ShotOptions options{.scene = "calm", .preset = "medium", .width = 96, .height = 72, .set = look.set};
      options.set.emplace_back("waves.resolution", "32");
      options.effects = {{"waves", "models", "underwater", "portals"}};
      test::stand(options.objects, test::solid_model(test::solid_sphere(0.4f, 12), "{}"), Pose{{-0.3, -2.0, -2.0}});
      if (portals)
        options.shapes.portals = {ball(1.0, {-1.0, -2.0, 0.0}), ball(0.8, {0.5, -1.6, -3.0})};
      else
        options.shapes.air = {ball(1.0, {-1.0, -2.0, 0.0}), ball(0.8, {0.5, -1.6, -3.0})};
      for (PlacedShape& one : options.shapes.portals) one.mode = gpu::portal_fly_through;
      const Pose head = pose({0.0, -2.0, 0.0}, 3.0, 5.0, 0.0);
      test::expect_each_eye_alone(options, head, 5.0, look.name + (portals ? " portals" : " air"));
    }
}

}  // namespace
}  // namespace seascape
