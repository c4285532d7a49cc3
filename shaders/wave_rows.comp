#version 460
// The spectrum at the time asked for, and the first half of its inverse transforms: along x, for the rows that are not zero.
#extension GL_GOOGLE_include_directive : require
#include "shared/wave_compute.h"
#include "lib/fft64.glsl"

// Bins a side of a cascade's table, and how many of them, about its middle, its tile carries.
layout(constant_id = 0) const uint bins = 64;
layout(constant_id = 1) const uint band = 64;

// Eight transforms of length 64 a workgroup. Transform g of a cascade is row g / P, phase g mod P.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Bins { WaveBin waves[]; };
layout(std430, binding = 1) writeonly buffer Rows { vec2 rows[]; };
layout(push_constant) uniform Push { WavePush push; };

shared vec2 heights[8 * 64];       // the spectrum of the rows of this workgroup
shared vec2 exchanged[8 * 64 + 8 * 8];

// The complex number that turns a wave's height into the two real fields A + i B of a transform. Displacement is i k/|k| chop h; a
// derivative multiplies by i k.
vec2 field_factor(uint field, vec2 k, float length_m) {
  const vec2 n = k * inversesqrt(max(dot(k, k), 1e-30));
  if (field == 0u) return vec2(0.0, push.chop * n.x + 1.0);                           // Dx + i h
  if (field == 1u) return vec2(0.0, push.chop * n.y * (1.0 - length_m * k.x));        // Dz + i length dDx/dz
  if (field == 2u) return vec2(-k.y, k.x);                                            // dh/dx + i dh/dz
  return -push.chop * vec2(k.x * n.x, k.y * n.y);                                     // dDx/dx + i dDz/dz
}

void main() {
  const uint cascade = gl_WorkGroupID.y;
  const uint phases = max(1u, uint(push.samples) / 64u);
  const uint log2_n = max(6u, uint(findMSB(uint(push.samples))));
  const uint first = gl_WorkGroupID.x * 8u;
  const uint first_row = first / phases;
  const uint row_count = max(1u, 8u / phases);

  // Height of a real sea: half the wave and half the conjugate of its opposite (Tessendorf 2001, eq. 43, with amplitudes of
  // one-sided waves).
  for (uint i = gl_LocalInvocationIndex; i < row_count * band; i += 64u) {
    const uint row = first_row + i / band, column = i % band;
    const uint centre = (cascade * bins + bins / 2u) * bins + bins / 2u;
    vec2 h = vec2(0.0);
    if (row != 0u && column != 0u) {
      const int offset = (int(row) - int(band / 2u)) * int(bins) + int(column) - int(band / 2u);
      WaveBin wave = waves[uint(int(centre) + offset)];
      WaveBin opposite = waves[uint(int(centre) - offset)];
      vec2 turn = cos_sin_turns(phase_turns(wave.turns_high, wave.turns_low, push.ticks_high, push.ticks_low));
      // exp(-i w t) for the wave, exp(+i w t) for the conjugate of its opposite, which has the same frequency.
      vec2 forward = times(wave.amplitude, vec2(turn.x, -turn.y));
      vec2 backward = times(vec2(opposite.amplitude.x, -opposite.amplitude.y), turn);
      h = 0.5 * (forward + backward);
    }
    heights[i] = h;
  }
  barrier();

  const uint lane = gl_LocalInvocationIndex >> 3, slot = gl_LocalInvocationIndex & 7u;
  const uint transform = first + slot;
  const uint row = transform / phases, phase = transform % phases;
  const uint held = (row - first_row) * band;
  const vec2 step_x = push.wave_vector[cascade].xy, step_z = vec2(-step_x.y, step_x.x);
  const vec2 row_k = float(int(row) - int(band / 2u)) * step_z;
  vec2 w[8];
  twiddles(lane, w);
  vec2 turn[8];
  phase_twiddles(lane, phase, log2_n, band, turn);
  const vec2 next_turn = cos_sin_turns((64u * phase) << (32u - log2_n));  // from a bin to the 64th after it
  const uint shrink = max(1u, 64u / uint(push.samples));  // tiles under 64 samples keep every shrink-th
  const uint columns = uint(push.samples);
  for (uint field = 0u; field < uint(wave_fields); ++field) {
    vec2 v[8];
    for (uint r = 0u; r < 8u; ++r) {
      vec2 sum = vec2(0.0), by = turn[r];
      for (uint index = bin_index(lane, r, band); index < band; index += 64u) {
        const vec2 k = float(int(index) - int(band / 2u)) * step_x + row_k;
        sum += times(times(heights[held + index], by), field_factor(field, k, push.wave_vector[cascade].z));
        if (band > 64u) by = times(by, next_turn);
      }
      v[r] = sum;
    }
    dft8(v);
    barrier();
    for (uint c = 0u; c < 8u; ++c) exchanged[slot * 72u + c * 9u + lane] = times(v[c], w[c]);
    barrier();
    for (uint t = 0u; t < 8u; ++t) v[t] = exchanged[slot * 72u + lane * 9u + t];
    dft8(v);
    const uint target = ((cascade * uint(wave_fields) + field) * band + row) * columns;
    for (uint c = 0u; c < 8u; ++c) {
      const uint q = lane + 8u * c;
      if (q % shrink == 0u) rows[target + q / shrink * phases + phase] = v[c];
    }
  }
}
