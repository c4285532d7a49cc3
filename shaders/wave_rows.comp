#version 460
// The spectrum at the time asked for, and the first half of its inverse transforms: along x, for the rows that are not
// zero, of tiles that carry at most 128 bins a side.
#extension GL_GOOGLE_include_directive : require
#define FFT_RADIX 8
// Eight transforms of length 64 a workgroup. Transform g of a cascade is row g / P, phase g mod P.
layout(local_size_x = 64) in;
#include "lib/fft.glsl"
#include "lib/wave_spectrum.glsl"

layout(std430, binding = 1) writeonly buffer Rows { vec2 rows[]; };

shared vec2 heights[8 * 64];  // the spectrum of the rows of this workgroup

void main() {
  const uint cascade = gl_WorkGroupID.y;
  const uint phases = max(1u, uint(push.samples) / core);
  const uint log2_n = max(6u, uint(findMSB(uint(push.samples))));
  const uint first = gl_WorkGroupID.x * 8u;
  const uint first_row = first / phases;
  const uint row_count = max(1u, 8u / phases);
  for (uint i = gl_LocalInvocationIndex; i < row_count * band; i += 64u)
    heights[i] = wave_height(cascade, first_row + i / band, i % band);
  barrier();

  const uint lane = gl_LocalInvocationIndex >> 3, slot = gl_LocalInvocationIndex & 7u;
  const uint row = (first + slot) / phases, phase = (first + slot) % phases;
  const uint held = (row - first_row) * band;
  const vec2 step_x = push.wave_vector[cascade].xy, step_z = vec2(-step_x.y, step_x.x);
  const vec2 row_k = float(int(row) - int(band / 2u)) * step_z;
  vec2 w[8], turn[8];
  twiddles(lane, w);
  phase_twiddles(lane, phase, log2_n, band, turn);
  const vec2 next_turn = cos_sin_turns((core * phase) << (32u - log2_n));  // from a bin to that a core after it
  const uint shrink = max(1u, core / uint(push.samples));  // tiles under 64 samples keep every shrink-th
  const uint columns = uint(push.samples);
  for (uint field = 0u; field < uint(wave_fields); ++field) {
    vec2 v[8];
    for (uint r = 0u; r < 8u; ++r) {
      vec2 sum = vec2(0.0), by = turn[r];
      for (uint index = bin_index(lane, r, band); index < band; index += core) {
        const vec2 k = float(int(index) - int(band / 2u)) * step_x + row_k;
        sum += times(times(heights[held + index], by), field_factor(field, k, push.wave_vector[cascade].z));
        if (band > core) by = times(by, next_turn);
      }
      v[r] = sum;
    }
    transform(lane, slot, w, v);
    const uint target = ((cascade * uint(wave_fields) + field) * band + row) * columns;
    for (uint c = 0u; c < 8u; ++c) {
      const uint q = lane + 8u * c;
      if (q % shrink == 0u) rows[target + q / shrink * phases + phase] = v[c];
    }
  }
}
