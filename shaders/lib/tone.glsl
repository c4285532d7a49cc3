// From radiance to what a screen shows.
#ifndef SEASCAPE_TONE_GLSL
#define SEASCAPE_TONE_GLSL

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// A filmic shoulder and toe on exposed linear light: the rational fit of the ACES curve by Narkowicz (2015), with a quarter of
// it applied to luminance so that bright water keeps its hue.
vec3 tone_map(vec3 c) {
  c *= 0.8;
  const float l = max(luminance(c), 1e-6);
  const vec3 per_channel = c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
  const vec3 by_luminance = c * ((2.51 * l + 0.03) / (l * (2.43 * l + 0.59) + 0.14));
  return clamp(mix(per_channel, by_luminance, 0.25), 0.0, 1.0);
}
#endif
