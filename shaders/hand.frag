#version 460
// A glove's light: sun and sky from above, what the sea throws back from below.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sky_light.glsl"
#include "lib/tone.glsl"

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here
layout(constant_id = value_depth_sampled) const
    bool depth_sampled = false;  // the sea's depth is a picture, not this pass's
layout(binding = slot_sea_depths) uniform sampler2DArray sea_depths;

layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 to_eye;
layout(location = 2) flat in vec4 colour;  // HandLimb
layout(location = 3) flat in vec3 axis;    // of length 1

layout(location = 0) out vec4 shown;

void main() {
  if (depth_sampled && gl_FragCoord.z <= texelFetch(sea_depths, ivec3(gl_FragCoord.xy, eye_index()), 0).r) discard;
  const vec3 n = normalize(normal), v = normalize(to_eye);
  if (dot(n, v) < 0.0) discard;  // limbs are whole: where they join, the far side of one would lie over the next
  const float above = 0.5 + 0.5 * n.y;
  const vec3 sea = 0.06 * (light.sky_irradiance.rgb + light.sun_irradiance.rgb * max(frame.sun.y, 0.0));
  const vec3 arrives = light.sun_irradiance.rgb * max(dot(n, frame.sun.xyz), 0.0) + light.sky_irradiance.rgb * above +
                       sea * (1.0 - above);
  // Wet rubber shines a little, most at its edges (Schlick 1994).
  const float edge = 0.04 + 0.3 * pow(1.0 - max(dot(n, v), 0.0), 5.0);
  vec3 lit = (colour.rgb * arrives + edge * light.sky_irradiance.rgb * above) / 3.14159265;
  lit *= light.exposure.x * exp2(frame.air.y);
  // What glows is as bright by day and by night, with a dark edge before glitter and foam: where a limb turns away
  // across its axis, for it may be looked at along it.
  const float across = max(length(v - axis * dot(v, axis)), 0.02);
  if (colour.w > 0.0) lit = colour.rgb * (1.5 * smoothstep(0.1, 0.5, dot(n, v) / across));
  if (tile_shape) lit = tone_map(lit);
  shown = vec4(min(lit, vec3(6e4)), 1.0);
}
