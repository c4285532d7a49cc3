#version 460
// The sky behind everything: the map, and the sun's disc.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"
#include "lib/sky.glsl"
#include "lib/tone.glsl"

layout(binding = 0) uniform Frame { FrameData frame; };
layout(binding = 4) uniform sampler2D sky_map;
layout(binding = 5) uniform Light { SkyLight light; };
layout(constant_id = 2) const bool tile_shape = false;
layout(constant_id = 4) const bool debug = false;

layout(location = 0) in vec3 pixel_ray;
layout(location = 0) out vec4 colour;

void main() {
  const vec3 ray = normalize(pixel_ray);
  vec3 sky = textureLod(sky_map, sky_coordinate(ray), 0.0).rgb;
  // The disc, darkened towards its limb (Pierce and Slaughter 1977, 550 nm, first order), with an edge a pixel wide.
  const float cosine = dot(ray, frame.sun.xyz), radius = sqrt(2.0 * (1.0 - frame.sun.w));
  if (cosine > 0.9995 && ray.y > 0.0) {
    const float off = length(ray - frame.sun.xyz);  // the chord, which is the angle to 1e-5 here
    const float inside = 1.0 - smoothstep(radius - 0.5 * frame.view[eye_index()].eye.w, radius + 0.5 * frame.view[eye_index()].eye.w, off);
    const float mu = sqrt(max(1.0 - (off / radius) * (off / radius), 0.0));
    const float solid = 6.2831853 * (1.0 - frame.sun.w);
    sky += inside * light.sun_irradiance.rgb * (0.4 + 0.6 * mu) * 1.25 / solid;
  }
  vec3 lit = sky * light.exposure.x * exp2(frame.air.y);
  if (tile_shape) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), 1.0);
  if (debug && frame.grid.w == debug_holes) {
    // Beneath the lowest line where any water must be seen, nothing but the sea may lie: pure magenta, after tone mapping.
    const float h = max(frame.viewer.z + frame.view[eye_index()].eye.y + frame.sea.footprint.z, 0.0), c = frame.skirt.w;
    const float dip = sqrt(2.0 * h * c + h * h * c * c) / (1.0 + h * c) ;  // sine of the dip (0 when flat)
    if (ray.y < -dip - 2.0 * frame.view[eye_index()].eye.w) colour = tile_shape ? vec4(1.0, 0.0, 1.0, 1.0) : vec4(0.0);
  }
}
