// From radiance to what a screen shows.
#ifndef SEASCAPE_TONE_GLSL
#define SEASCAPE_TONE_GLSL

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// Reinhard's curve with a white point (2002, eq. 4), half by channel and half by luminance: dark water keeps its blue,
// glitter keeps its shape up to sixteen times the mid grey's light, and what is brighter turns white.
vec3 tone_map(vec3 c) {
  const float white2 = 16.0 * 16.0;
  const float l = luminance(c);
  const vec3 per_channel = c * (1.0 + c / white2) / (1.0 + c);
  const vec3 by_luminance = c * ((1.0 + l / white2) / (1.0 + l));
  const vec3 shown = clamp(mix(per_channel, by_luminance, 0.5), 0.0, 1.0);
  // A gentle S on what is shown, about middle grey: the contrast of a print.
  return mix(shown, shown * shown * (3.0 - 2.0 * shown), 0.1);
}
#endif
