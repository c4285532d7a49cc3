#include "app/eyes_in_water.h"

#include <cmath>

#include "app/eye_adaptation.h"
#include "app/lamp.h"
#include "app/water_shapes.h"
#include "shaders/shared/fresnel.h"

namespace seascape {

namespace {

// What deep water sends up, and how it fades at this sun (shaders/lib/underwater.glsl).
LightInWater light_in_water(const gpu::FrameData& data, double depth_m) {
  const double sine = data.sun.y, index = gpu::water_index;
  const double sun_cosine = std::sqrt(std::max(1.0 - (1.0 - sine * sine) / (index * index), 0.1));
  return {glm::dvec3(data.water_reflectance),
          (glm::dvec3(data.water_absorption) + glm::dvec3(data.water_backscatter)) / sun_cosine, depth_m};
}

// Tells shaders where shapes of air and portals are, and what the eyes' sides are among them.
void find_shapes(Experience& e, gpu::FrameData& data, const Viewpoint& viewpoint, Ocean::EyesSide& side) {
  const Scene& scene = e.scene();
  const bool above = side.eyes == EyesIn::air, portals = !scene.shapes.portals.empty();
  if (above && !portals) {  // they cut the surface, wherever it stands
    data.shapes = placed_shapes(scene.shapes, scene.objects, viewpoint.viewer.position_m, nullptr);
    return;
  }
  const SeaView felt = e.sea()->view_at(e.sea()->time_s(), SeaDetail::felt);
  data.shapes = placed_shapes(scene.shapes, scene.objects, viewpoint.viewer.position_m, &felt);
  const WaterLines lines{data.shapes, int(scene.shapes.air.size()), int(scene.shapes.portals.size())};
  for (std::size_t i = 0; i < viewpoint.eyes.size() && i < side.depth_m.size(); ++i)
    if (lines.keep_dry(viewpoint.eyes[i].pose.position_m - viewpoint.viewer.position_m)) side.depth_m[i].reset();
  const EyesAmongShapes among = eyes_among(side.eyes, scene.shapes, data.shapes, viewpoint, e.ocean().highest_m());
  side.eyes = among.eyes;
  side.from_above = among.from_above;
  side.high_air = among.high_air;
  side.portals = among.portals;
  if (portals) side.over_viewer_m = 0.0;  // who looks into them stands in a dry place
  if (!above || side.eyes == EyesIn::air) return;
  // Of eyes far above it the sea's plane is the still one.
  const glm::dvec3& viewer = viewpoint.viewer.position_m;
  side.still_m = felt.query({viewer.x, viewer.z}).still_m;
  for (std::size_t i = 0; i < viewpoint.eyes.size() && i < side.over_eye.size(); ++i)
    side.over_eye[i] = {side.still_m - viewpoint.eyes[i].pose.position_m.y, 0.0, 0.0};
}

}  // namespace

Ocean::EyesSide find_eyes(Experience& e, gpu::FrameData& data, const Viewpoint& viewpoint) {
  // A line of sight begins on the near plane, of which a corner is farthest off.
  double wide = 0.0;  // tangents of a corner
  for (const View& eye : viewpoint.eyes)
    for (const double across : {eye.fov.left, eye.fov.right})
      for (const double up : {eye.fov.up, eye.fov.down}) wide = std::max(wide, std::hypot(across, up));
  Ocean::EyesSide side = e.ocean().eyes_in(viewpoint, e.scene().settings.render.near_m * std::hypot(1.0, wide));
  if (e.shaped()) find_shapes(e, data, viewpoint, side);
  data.shown.y = int(side.eyes);
  data.water_scattering.w = float(side.still_m);
  for (std::size_t i = 0; i < side.over_eye.size(); ++i)
    data.water_at_eye[i] = glm::vec4(glm::vec3(side.over_eye[i]), 0.0f);
  data.lamp = lamp_data(e.scene().settings.dive_light, viewpoint.viewer, e.lamp_hand());
  if (side.eyes != EyesIn::air) {
    const bool portals = !e.scene().shapes.portals.empty();
    side.bed = e.ocean().select_bed(viewpoint, portals ? &side.portals : nullptr, data);
  }
  const LightInWater light = light_in_water(data, side.over_viewer_m);  // both eyes get used to it as one
  data.air.y += float(adaptation_stops(light, e.scene().settings.water.adaptation));
  return side;
}

}  // namespace seascape
