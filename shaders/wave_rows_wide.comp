#version 460
// The spectrum at the time asked for, and the first half of its inverse transforms: along x, for tiles that carry 256
// bins a side in 256 samples or a multiple. Each invocation keeps the heights of its bins for all phases and fields.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define FFT_RADIX 16
layout(local_size_x = 64, local_size_x_id = 2) in;
#include "lib/fft.glsl"
#include "lib/wave_spectrum.glsl"

layout(std430, binding = 1) writeonly buffer Rows { vec2 rows[]; };

void main() {
  const uint lane = gl_LocalInvocationIndex % radix, slot = gl_LocalInvocationIndex / radix;
  const uint row = gl_WorkGroupID.x * (gl_WorkGroupSize.x / radix) + slot, cascade = gl_WorkGroupID.y;
  const uint columns = uint(push.samples), phases = columns / core, log2_n = uint(findMSB(columns));
  const vec2 step_x = push.wave_vector[cascade].xy, step_z = vec2(-step_x.y, step_x.x);
  const vec2 row_k = float(int(row) - int(band / 2u)) * step_z;
  vec2 w[16], heights[16];
  twiddles(lane, w);
  for (uint r = 0u; r < radix; ++r) heights[r] = wave_height(cascade, row, bin_index(lane, r, band));
  [[dont_unroll]] for (uint phase = 0u; phase < phases; ++phase) {
    vec2 turned[16];
    phase_twiddles(lane, phase, log2_n, band, turned);
    for (uint r = 0u; r < radix; ++r) turned[r] = times(heights[r], turned[r]);
    [[dont_unroll]] for (uint field = 0u; field < uint(wave_fields); ++field) {
      vec2 v[16];
      for (uint r = 0u; r < radix; ++r) {
        const vec2 k = float(int(bin_index(lane, r, band)) - int(band / 2u)) * step_x + row_k;
        v[r] = times(turned[r], field_factor(field, k, push.wave_vector[cascade].z));
      }
      transform(lane, slot, w, v);
      const uint target = ((cascade * uint(wave_fields) + field) * band + row) * columns + phase;
      for (uint c = 0u; c < radix; ++c) rows[target + (lane + radix * c) * phases] = v[c];
    }
  }
}
