// How light leaves the sea: reflection of sky and sun by its facets, light from below, light through crests.
#ifndef SEASCAPE_WATER_LIGHT_GLSL
#define SEASCAPE_WATER_LIGHT_GLSL

#include "shared/fresnel.h"

const float pi = 3.14159265;

// Henyey and Greenstein (1941).
float henyey_greenstein(float cosine, float g) {
  const float d = max(1.0 + g * g - 2.0 * g * cosine, 1e-4);
  return (1.0 - g * g) / (4.0 * pi * d * sqrt(d));
}

// Smith's Lambda of a Beckmann surface (Walter 2007, eq. 15): a = cot(theta) / (sqrt 2 sigma).
float smith_lambda(float cosine, float variance) {
  const float sine = sqrt(max(1.0 - cosine * cosine, 1e-6));
  const float a = max(cosine, 1e-3) / (sine * sqrt(2.0 * variance));
  return a < 1.6 ? (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a) : 0.0;
}

// Complement of the error function, within 2e-4 (Abramowitz and Stegun 7.1.27).
float erfc_approx(float x) {
  const float a = abs(x);
  const float t = 1.0 + a * (0.278393 + a * (0.230389 + a * (0.000972 + a * 0.078108)));
  const float e = 1.0 / (t * t * t * t);
  return x >= 0.0 ? e : 2.0 - e;
}
#endif
