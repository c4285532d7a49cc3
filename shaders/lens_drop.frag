#version 460
// A drop as a small lens: a cap of a sphere, which shows the world upside down.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sea_light.glsl"
#include "lib/lens_light.glsl"
#include "lib/tone.glsl"

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here

layout(location = 0) in vec2 at;
layout(location = 1) in vec3 line_of_sight;
layout(location = 2) flat in vec3 along;
layout(location = 3) flat in vec3 across;
layout(location = 4) flat in vec2 look;

layout(location = 0) out vec4 colour;

// Sine of the angle at which the cap meets the lens: 42 degrees, of water on glass that is not quite clean.
const float rim = 0.67;

void main() {
  if (not_in_air()) discard;
  // Behind it thins to a tail.
  const float tail = 1.0 + look.x;
  const vec2 off = at.x > 0.0 ? vec2(at.x / tail, at.y / mix(1.0, 0.45, at.x / tail)) : at;
  const float from_middle = length(off);
  if (from_middle >= 1.0) discard;
  // The cap leans by `lean` there, and turns the line of sight towards its middle.
  const vec3 sight = normalize(line_of_sight), outwards = off.x * along + off.y * across;
  const float sine = rim * from_middle, lean = asin(sine), leaves = asin(min(water_index * sine, 1.0));
  const vec3 inwards = outwards - sight * dot(outwards, sight);
  const float turned = leaves - lean;
  const vec3 ray = from_middle < 1e-4 ? sight : cos(turned) * sight - sin(turned) * normalize(inwards);
  vec3 lit = (1.0 - fresnel(cos(leaves))) * light_of_air(ray, frame.view[eye_index()]);
  lit = shown_light(lit);
  if (tile_shape) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), look.y * (1.0 - smoothstep(0.86, 1.0, from_middle)));
}
