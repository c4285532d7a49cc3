#version 460
// Over the finished picture: a vignette about where the head looks, the same directions in every eye, and over it a
// line that stays at the Earth's horizon.
#extension GL_GOOGLE_include_directive : require
#include "shared/comfort_data.h"
#include "shared/slots.h"

layout(binding = slot_comfort) uniform Comfort { ComfortData comfort; };

layout(location = 0) in vec3 pixel_ray;
layout(location = 0) out vec4 shown;

const vec3 night = vec3(0.0012, 0.0019, 0.0027);  // what it darkens to: black would be a hole in a bright sea
const vec3 line_light = vec3(0.80, 0.88, 0.92);
const float line_half = 0.0013089969;                 // 0.075 degrees
const float line_strength = 0.3, line_in_dark = 0.3;  // of the light behind it; in the dark it needs less

// Gradient noise of a pixel, 0 to 1 (Jimenez 2014).
float dither(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

void main() {
  const vec3 ray = normalize(pixel_ray);

  // How much of the pixel the line covers: a band across a box as wide as the pixel is high in elevation.
  const float pixel = length(vec2(dFdx(ray.y), dFdy(ray.y)));
  const float within = min(ray.y + 0.5 * pixel, line_half) - max(ray.y - 0.5 * pixel, -line_half);
  const float covered = clamp(within / max(pixel, 1e-9), 0.0, 1.0) * comfort.ahead.w;

  // Even to the eye, whose scale goes about as the root of light. Dithered by a step of the picture's 8 bits.
  const float from_ahead = atan(length(cross(ray, comfort.ahead.xyz)), dot(ray, comfort.ahead.xyz));
  const float out_of_clear = (from_ahead - comfort.edge.x) / comfort.edge.y;
  float dark = smoothstep(0.0, 1.0, out_of_clear);
  if (dark > 0.0 && dark < 1.0) dark = clamp(dark + (dither(gl_FragCoord.xy) - 0.5) * (2.0 / 255.0), 0.0, 1.0);
  const float vignette = 1.0 - (1.0 - dark) * (1.0 - dark);
  const float line = covered * line_strength * mix(1.0, line_in_dark, vignette);

  const float hidden = 1.0 - (1.0 - vignette) * (1.0 - line);
  if (hidden <= 0.0) discard;
  shown = vec4((night * vignette * (1.0 - line) + line_light * line) / hidden, hidden);
}
