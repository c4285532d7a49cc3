// How light leaves the sea: reflection of sky and sun by its facets, light from below, light through crests.
#ifndef SEASCAPE_WATER_LIGHT_GLSL
#define SEASCAPE_WATER_LIGHT_GLSL

#include "shared/fresnel.h"
#include "shared/water_volume.h"

const float pi = 3.14159265;

// Of the sun's rays under a level surface.
float sun_cosine_in_water() {
  return sqrt(max(1.0 - (1.0 - frame.sun.y * frame.sun.y) / (water_index * water_index), 0.1));
}

// How much of the light of a column of water, and of what lies in it, is between the surface and `way` metres below: of
// what deep water scatters back, and of what lies there (Lee, Carder, Mobley, Steward and Patch 1998, eqs. 1, 2, 5 and
// 6). `eye_cosine`: of the line of sight under water, downwards.
struct WaterColumn {
  vec3 scattered, passed;
};
WaterColumn water_column(float way, float eye_cosine) {
  const vec3 attenuation = frame.water_absorption.rgb + frame.water_backscatter.rgb,
             u = frame.water_backscatter.rgb / attenuation;
  const float sun_cosine = sun_cosine_in_water();
  const vec3 of_column = 1.03 * sqrt(1.0 + 2.4 * u), of_thing = 1.04 * sqrt(1.0 + 5.4 * u);
  return WaterColumn(1.0 - exp(-(1.0 / sun_cosine + of_column / eye_cosine) * attenuation * way),
                     exp(-(1.0 / sun_cosine + of_thing / eye_cosine) * attenuation * way));
}

// Radiance that comes out of water in which something lies, bed or thing, where `deep` comes out of deep water. `sent`:
// what it would send up just under the surface; `down`: irradiance that has entered. It spreads as it leaves (Mobley
// 1994, eq. 4.21), and what the surface throws back lights it again, as much as a white bed at most.
vec3 light_out_of_water(WaterColumn column, vec3 deep, vec3 sent, vec3 down) {
  const vec3 arrived = sent * column.passed, again = min(1.5 * arrived / max(down, vec3(1e-9)), vec3(0.48));
  return deep * column.scattered + arrived / (water_index * water_index * (1.0 - again));
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
