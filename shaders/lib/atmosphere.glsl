// The air: Rayleigh and aerosol scattering, ozone, with one bounce table for the rest (Hillaire 2020). Metres above the
// sea.
#ifndef SEASCAPE_ATMOSPHERE_GLSL
#define SEASCAPE_ATMOSPHERE_GLSL

const float air_ground = 6360e3, air_top = 6460e3;
const vec3 sun_above_air = vec3(1.474, 1.8504, 1.91198);  // Bruneton (2017), W/m^2/nm at 680, 550, 440 nm
const vec3 rayleigh = vec3(5.802e-6, 13.558e-6, 33.1e-6);
const float aerosol_scattering = 3.996e-6, aerosol_absorption = 0.44e-6;
const vec3 ozone = vec3(0.650e-6, 1.881e-6, 0.085e-6);

struct Air {
  vec3 rayleigh;
  float aerosol;
  vec3 extinction;
};

Air air_at(float height, float haze) {
  Air a;
  a.rayleigh = rayleigh * exp(-height / 8000.0);
  const float aerosol = haze * exp(-height / 1200.0);
  a.aerosol = aerosol_scattering * aerosol;
  a.extinction = a.rayleigh + (aerosol_scattering + aerosol_absorption) * aerosol +
                 ozone * max(0.0, 1.0 - abs(height - 25000.0) / 15000.0);
  return a;
}

float to_sphere(vec3 origin, vec3 direction, float radius) {  // the far crossing; negative where there is none
  const float b = dot(origin, direction), c = dot(origin, origin) - radius * radius, d = b * b - c;
  return d < 0.0 ? -1.0 : -b + sqrt(d);
}

bool meets_ground(vec3 origin, vec3 direction) {
  const float b = dot(origin, direction), c = dot(origin, origin) - air_ground * air_ground;
  return b < 0.0 && b * b - c > 0.0;
}

// Share of the sun's light that reaches `origin`, softened as its disc sets.
vec3 sunlight(vec3 origin, vec3 sun, float haze) {
  const float radius = length(origin);
  const float sine = dot(origin, sun) / radius,
              dip = -sqrt(max(0.0, 1.0 - air_ground * air_ground / (radius * radius)));
  const float above = smoothstep(dip - 0.0047, dip + 0.0047, sine);
  if (above <= 0.0) return vec3(0.0);
  const float length_m = to_sphere(origin, sun, air_top);
  vec3 depth = vec3(0.0);
  const int steps = 20;
  float before = 0.0;
  for (int i = 0; i < steps; ++i) {
    const float f = (float(i) + 1.0) / float(steps), at = length_m * f * f;  // finer where the air is dense
    const float middle = 0.5 * (before + at);
    depth += air_at(max(length(origin + sun * middle) - air_ground, 0.0), haze).extinction * (at - before);
    before = at;
  }
  return above * exp(-depth);
}

float rayleigh_phase(float c) { return 0.0596831037 * (1.0 + c * c); }
// Cornette and Shanks (1992), g = 0.8.
float aerosol_phase(float c) {
  const float g = 0.8;
  return 0.1193662073 * (1.0 - g * g) * (1.0 + c * c) / ((2.0 + g * g) * pow(1.0 + g * g - 2.0 * g * c, 1.5));
}
#endif
