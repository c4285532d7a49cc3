#version 460
// The spectrum at the time asked for, and the first half of its inverse transforms: along x, for the 64 rows that are not zero.
#extension GL_GOOGLE_include_directive : require
#include "shared/wave_compute.h"
#include "lib/fft64.glsl"

// Eight transforms of length 64 a workgroup. Transform g of a cascade is row g / P, phase g mod P.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Bins { WaveBin bins[]; };
layout(std430, binding = 1) writeonly buffer Rows { vec2 rows[]; };
layout(push_constant) uniform Push { WavePush push; };

shared vec2 heights[8 * 64];       // the spectrum of the rows of this workgroup
shared vec2 exchanged[8 * 64 + 8 * 8];

void main() {
  const uint cascade = gl_WorkGroupID.y;
  const uint phases = max(1u, uint(push.resolution) / 64u);
  const uint log2_n = max(6u, uint(findMSB(uint(push.resolution))));
  const uint first = gl_WorkGroupID.x * 8u;
  const uint first_row = first / phases;
  const uint row_count = max(1u, 8u / phases);

  // Height of a real sea: half the wave and half the conjugate of its opposite (Tessendorf 2001, eq. 43, with amplitudes of
  // one-sided waves).
  for (uint i = gl_LocalInvocationIndex; i < row_count * 64u; i += 64u) {
    const uint row = first_row + i / 64u, column = i & 63u;
    const uint base = cascade * uint(wave_bins * wave_bins);
    vec2 h = vec2(0.0);
    if (row != 0u && column != 0u) {
      WaveBin wave = bins[base + row * uint(wave_bins) + column];
      WaveBin opposite = bins[base + (64u - row) * uint(wave_bins) + (64u - column)];
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
  const uint held = (row - first_row) * 64u;
  const int mz = bin_number(row);
  const vec2 step_x = push.wave_vector[cascade].xy, step_z = vec2(-step_x.y, step_x.x);
  vec2 w[8];
  twiddles(lane, w);
  vec2 turn[8];
  phase_twiddles(lane, phase, log2_n, turn);
  vec2 turned[8];  // height turned by this transform's phase
  vec2 k[8];
  float inverse_k[8];
  for (uint r = 0u; r < 8u; ++r) {
    const uint index = bin_index(lane, r);
    const int mx = bin_number(index);
    turned[r] = times(heights[held + index], turn[r]);
    k[r] = float(mx) * step_x + float(mz) * step_z;
    inverse_k[r] = inversesqrt(max(dot(k[r], k[r]), 1e-30));
  }
  const uint shrink = max(1u, 64u / uint(push.resolution));  // tiles under 64 samples keep every shrink-th
  const uint columns = uint(push.resolution);
  for (uint field = 0u; field < uint(wave_fields); ++field) {
    vec2 v[8];
    for (uint r = 0u; r < 8u; ++r) {
      // Two real fields a transform, A + iB. Displacement is i k/|k| chop h; a derivative multiplies by i k.
      const vec2 n = k[r] * inverse_k[r];
      vec2 factor;  // the complex number that turns h into A + iB
      if (field == 0u) factor = vec2(0.0, push.chop * n.x + 1.0);                          // Dx + i h
      else if (field == 1u) factor = vec2(0.0, push.chop * n.y * (1.0 - push.wave_vector[cascade].z * k[r].x));  // Dz + i length dDx/dz
      else if (field == 2u) factor = vec2(-k[r].y, k[r].x);                                // dh/dx + i dh/dz
      else factor = -push.chop * vec2(k[r].x * n.x, k[r].y * n.y);                         // dDx/dx + i dDz/dz
      v[r] = times(turned[r], factor);
    }
    dft8(v);
    barrier();
    for (uint c = 0u; c < 8u; ++c) exchanged[slot * 72u + c * 9u + lane] = times(v[c], w[c]);
    barrier();
    for (uint t = 0u; t < 8u; ++t) v[t] = exchanged[slot * 72u + lane * 9u + t];
    dft8(v);
    const uint target = ((cascade * uint(wave_fields) + field) * 64u + row) * columns;
    for (uint c = 0u; c < 8u; ++c) {
      const uint q = lane + 8u * c;
      if (q % shrink == 0u) rows[target + q / shrink * phases + phase] = v[c];
    }
  }
}
