#version 460
// A puff of spray as a quad that stands across the line from the viewer's head, so that both eyes see the same one,
// drawn out along its way; and its light.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sky_light.glsl"
#include "lib/tone.glsl"
#include "lib/water_light.glsl"

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here

layout(location = 0) in vec4 puff_place;  // SprayPuff
layout(location = 1) in vec4 puff_streak;
layout(location = 2) in vec2 puff_look;

layout(location = 0) out vec2 at;           // across the quad, in radii
layout(location = 1) flat out vec4 colour;  // its radius, m, last
layout(location = 2) flat out vec4 shape;   // half of its way in radii; how much it hides; SprayPuff::look

void main() {
  vec3 relative = curved(puff_place.xz, puff_place.y, frame.viewer.w);
  relative.y -= frame.viewer.z;
  const vec3 ahead = relative / max(length(relative), 1e-6);
  const vec3 drawn_out = puff_streak.xyz - ahead * dot(ahead, puff_streak.xyz);
  const float way = length(drawn_out), radius = puff_place.w;
  // Without a way any direction across will do.
  const vec3 along = way > 1e-5
                         ? drawn_out / way
                         : normalize(abs(ahead.y) < 0.9 ? vec3(-ahead.z, 0.0, ahead.x) : vec3(ahead.y, -ahead.x, 0.0));
  const int corner = gl_VertexIndex < 3 ? gl_VertexIndex : gl_VertexIndex - 2;  // 0 1 2, 1 2 3
  at = vec2((corner & 1) == 0 ? -1.0 : 1.0, corner < 2 ? -1.0 : 1.0) * vec2(1.0 + way / radius, 1.0);

  // Single scattering by droplets much longer than the light's waves: half of it is bent forward by little, the rest
  // goes anywhere. A cloud of them that hides what lies behind shines like a white one.
  const ViewData view = frame.view[eye_index()];
  const vec3 to_eye = view.eye.xyz - relative;
  const float range = max(length(to_eye), 1e-3);
  const vec3 v = to_eye / range;
  const float scattered = 0.5 * henyey_greenstein(-dot(v, frame.sun.xyz), 0.8) + 0.5 / (2.0 * pi);
  vec3 lit = 0.75 * light.sky_irradiance.rgb / pi + scattered * light.sun_irradiance.rgb;
  lit = through_air(lit, v, range) * light.exposure.x * exp2(frame.air.y);
  if (tile_shape) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), radius);
  shape = vec4(way / radius, puff_streak.w, puff_look);
  gl_Position = view.clip_from_relative * vec4(relative + radius * (at.x * along + at.y * cross(ahead, along)), 1.0);
}
