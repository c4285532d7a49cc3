// The spectrum at the time asked for: a row's heights, and the factors that make the fields of them.
#include "shared/phase.h"
#include "shared/wave_compute.h"

// Bins a side of a cascade's table, and how many of them, about its middle, its tile carries.
layout(constant_id = 0) const uint bins = 64;
layout(constant_id = 1) const uint band = 64;
layout(std430, binding = 0) readonly buffer Bins { WaveBin waves[]; };
layout(push_constant) uniform Push { WavePush push; };

// Height of a real sea: half the wave and half the conjugate of its opposite (Tessendorf 2001, eq. 43, with amplitudes
// of one-sided waves). `row` and `column` count from -band / 2, whose waves have no opposite and are none.
vec2 wave_height(uint cascade, uint row, uint column) {
  if (row == 0u || column == 0u) return vec2(0.0);
  const int centre = int((cascade * bins + bins / 2u) * bins + bins / 2u);
  const int offset = (int(row) - int(band / 2u)) * int(bins) + int(column) - int(band / 2u);
  const WaveBin wave = waves[centre + offset];
  const vec2 opposite = waves[centre - offset].amplitude;
  const vec2 turn = cos_sin_turns(phase_turns(wave.turns_high, wave.turns_low, push.ticks_high, push.ticks_low));
  // exp(-i w t) for the wave, exp(+i w t) for the conjugate of its opposite, which has the same frequency.
  return 0.5 * (times(wave.amplitude, vec2(turn.x, -turn.y)) + times(vec2(opposite.x, -opposite.y), turn));
}

// The complex number that turns a wave's height into the two real fields A + i B of a transform. Displacement is i
// k/|k| chop h; a derivative multiplies by i k.
vec2 field_factor(uint field, vec2 k, float length_m) {
  vec2 n = k * inversesqrt(max(dot(k, k), 1e-30));
  if (push.depth_m > 0.0) {  // orbits wider than high: coth(k h), held at 8 (orbit_width in ocean/waves/dispersion.h)
    const float e = exp(-2.0 * push.depth_m * length(k));
    n *= min((1.0 + e) / max(1.0 - e, 1e-30), 8.0);
  }
  if (field == 0u) return vec2(0.0, push.chop * n.x + 1.0);                     // Dx + i h
  if (field == 1u) return vec2(0.0, push.chop * n.y * (1.0 - length_m * k.x));  // Dz + i length dDx/dz
  if (field == 2u) return vec2(-k.y, k.x);                                      // dh/dx + i dh/dz
  return -push.chop * vec2(k.x * n.x, k.y * n.y);                               // dDx/dx + i dDz/dz
}
