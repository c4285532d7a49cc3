#version 460
// The water's curved edge at the lens: the line of sight leaves the water through the meniscus, which bends it, or
// mirrors it back into the water.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sea_light.glsl"
#include "lib/lens_light.glsl"
#include "lib/line_clip.glsl"
#include "lib/meniscus_plate.glsl"
#include "lib/tone.glsl"

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here

layout(location = 0) in vec3 line_of_sight;
layout(location = 1) in float over_line;
layout(location = 2) in vec3 line_at;

layout(location = 0) out vec4 colour;

// Radiance of a ray in the water that the surface has mirrored.
vec3 light_of_water(vec3 ray) { return open_water(0.0, vec3(ray.x, -abs(ray.y), ray.z)); }

void main() {
  if (not_in_air()) discard;
  if (line_is_dry(line_at)) discard;
  const ViewData view = frame.view[eye_index()];
  const Plate plate = plate_before(view);
  const vec3 sight = normalize(line_of_sight), inside = refract(sight, -plate.ahead, 1.0 / water_index);
  const vec3 out_from_plate = normalize(plate.ahead - plate.over * dot(plate.ahead, plate.over));
  // In capillary lengths from where the surface meets the plate, and over the level water.
  const float up_plate = clamp(over_line, 0.0, plate.rises_m) / capillary_length_m;
  const float back = (plate.rises_m / capillary_length_m - up_plate) * cos(plate.wall);
  const float angle =
      meniscus_met(plate.wall, back, up_plate * sin(plate.wall), dot(inside, out_from_plate), dot(inside, plate.over));
  vec3 lit;
  float bent = 2.0;  // from the line of sight, as a chord
  if (angle < 0.0) {
    lit = light_of_water(inside);
  } else {
    const vec3 normal = sin(angle) * out_from_plate + cos(angle) * plate.over;
    const vec3 leaves = refract(inside, -normal, water_index);
    const vec3 mirrored = light_of_water(reflect(inside, normal));
    lit = mirrored;
    if (leaves != vec3(0.0)) {
      lit = mix(light_of_air(leaves, view), mirrored, fresnel(dot(leaves, normal)));
      bent = length(leaves - sight);
    }
  }
  // Where the water hardly bends light, what lies behind is seen as it is.
  const float shown = smoothstep(0.0, 0.06, bent);
  lit = shown_light(lit);
  if (tile_shape) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), shown);
}
