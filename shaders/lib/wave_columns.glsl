// The second half of the inverse transforms: along z, for every column, straight into the tiles. Included with
// TILE_FORMAT and FFT_RADIX defined.
#extension GL_GOOGLE_include_directive : require
// Neighbouring columns at one phase, FFT_RADIX invocations each; as many as the device has room for.
layout(local_size_x = 64, local_size_x_id = 2) in;
#include "shared/wave_compute.h"
#include "lib/fft.glsl"

layout(constant_id = 1) const uint band = 64;  // rows that are not zero

layout(std430, binding = 0) readonly buffer Rows { vec2 rows[]; };
layout(binding = 1, TILE_FORMAT) writeonly uniform image2DArray displacement;  // Dx, h, Dz, dDx/dz
layout(binding = 2, TILE_FORMAT) writeonly uniform image2DArray derivatives;   // dh/dx, dh/dz, dDx/dx, dDz/dz
layout(binding = 3, TILE_FORMAT) writeonly uniform
    image2DArray moments;  // (dh/dx)^2, (dh/dz)^2, their product, (dDx/dx + dDz/dz)^2; each times WavePush's share
layout(push_constant) uniform Push { WavePush push; };

// One field's transform: the values of this lane, at q = lane + FFT_RADIX c.
void column(uint field, uint cascade, uint x, uint columns, uint lane, uint slot, vec2 w[FFT_RADIX],
            vec2 turn[FFT_RADIX], vec2 next_turn, out vec2 v[FFT_RADIX]) {
  const uint source = (cascade * uint(wave_fields) + field) * band;
  for (uint r = 0u; r < radix; ++r) {
    vec2 sum = vec2(0.0), by = turn[r];
    for (uint index = bin_index(lane, r, band); index < band; index += core) {
      sum += times(rows[(source + index) * columns + x], by);
      if (band > core) by = times(by, next_turn);
    }
    v[r] = sum;
  }
  transform(lane, slot, w, v);
}

void main() {
  const uint cascade = gl_WorkGroupID.z, phase = gl_WorkGroupID.y;
  const uint columns = uint(push.samples), log2_core = uint(findMSB(core));
  const uint phases = max(1u, columns / core), log2_n = max(log2_core, uint(findMSB(columns)));
  const uint slots = gl_WorkGroupSize.x / radix;
  const uint lane = gl_LocalInvocationIndex / slots, slot = gl_LocalInvocationIndex % slots;
  const uint x = gl_WorkGroupID.x * slots + slot;
  const uint shrink = max(1u, core / columns);
  vec2 w[FFT_RADIX], turn[FFT_RADIX], a[FFT_RADIX], b[FFT_RADIX];
  twiddles(lane, w);
  phase_twiddles(lane, phase, log2_n, band, turn);
  const vec2 next_turn = cos_sin_turns((core * phase) << (32u - log2_n));  // from a bin to that a core after it
  // Two fields at a time, written out: a loop over them would keep the results in memory instead of registers.
  column(0u, cascade, x, columns, lane, slot, w, turn, next_turn, a);
  column(1u, cascade, x, columns, lane, slot, w, turn, next_turn, b);
  for (uint c = 0u; c < radix; ++c) {
    const uint q = lane + radix * c;
    if (q % shrink == 0u)
      imageStore(displacement, ivec3(x, q / shrink * phases + phase, cascade),
                 vec4(a[c], b[c].x, b[c].y / push.wave_vector[cascade].z));
  }
  column(2u, cascade, x, columns, lane, slot, w, turn, next_turn, a);
  column(3u, cascade, x, columns, lane, slot, w, turn, next_turn, b);
  for (uint c = 0u; c < radix; ++c) {
    const uint q = lane + radix * c;
    if (q % shrink != 0u) continue;
    const ivec3 at = ivec3(x, q / shrink * phases + phase, cascade);
    const float divergence = b[c].x + b[c].y;
    imageStore(derivatives, at, vec4(a[c], b[c]));
    imageStore(moments, at, vec4(a[c] * a[c], a[c].x * a[c].y, divergence * divergence) * push.wave_vector[cascade].w);
  }
}
