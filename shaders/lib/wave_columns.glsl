// The second half of the inverse transforms: along z, for every column, straight into the tiles. Included with
// TILE_FORMAT defined.
#extension GL_GOOGLE_include_directive : require
#include "shared/wave_compute.h"
#include "lib/fft64.glsl"

layout(constant_id = 1) const uint band = 64;  // rows that are not zero

// Eight neighbouring columns at one phase a workgroup.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Rows { vec2 rows[]; };
layout(binding = 1, TILE_FORMAT) writeonly uniform image2DArray displacement;  // Dx, h, Dz, dDx/dz
layout(binding = 2, TILE_FORMAT) writeonly uniform image2DArray derivatives;   // dh/dx, dh/dz, dDx/dx, dDz/dz
layout(binding = 3, TILE_FORMAT) writeonly uniform image2DArray moments;       // (dh/dx)^2, (dh/dz)^2, their product, (dDx/dx + dDz/dz)^2; each times WavePush's share
layout(push_constant) uniform Push { WavePush push; };

shared vec2 exchanged[8 * 72];

// One field's transform: the values of this lane, at q = lane + 8 c.
void transform(uint field, uint cascade, uint column, uint columns, uint lane, uint slot, vec2 w[8], vec2 turn[8], vec2 next_turn, out vec2 v[8]) {
  const uint source = (cascade * uint(wave_fields) + field) * band;
  for (uint r = 0u; r < 8u; ++r) {
    vec2 sum = vec2(0.0), by = turn[r];
    for (uint index = bin_index(lane, r, band); index < band; index += 64u) {
      sum += times(rows[(source + index) * columns + column], by);
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
}

void main() {
  const uint cascade = gl_WorkGroupID.z, phase = gl_WorkGroupID.y;
  const uint phases = max(1u, uint(push.samples) / 64u);
  const uint log2_n = max(6u, uint(findMSB(uint(push.samples))));
  const uint lane = gl_LocalInvocationIndex >> 3, slot = gl_LocalInvocationIndex & 7u;
  const uint column = gl_WorkGroupID.x * 8u + slot;
  const uint columns = uint(push.samples);
  const uint shrink = max(1u, 64u / columns);
  vec2 w[8], turn[8], a[8], b[8];
  twiddles(lane, w);
  phase_twiddles(lane, phase, log2_n, band, turn);
  const vec2 next_turn = cos_sin_turns((64u * phase) << (32u - log2_n));  // from a bin to the 64th after it
  // Two fields at a time, written out: a loop over them would keep the results in memory instead of registers.
  transform(0u, cascade, column, columns, lane, slot, w, turn, next_turn, a);
  transform(1u, cascade, column, columns, lane, slot, w, turn, next_turn, b);
  for (uint c = 0u; c < 8u; ++c) {
    const uint q = lane + 8u * c;
    if (q % shrink == 0u) imageStore(displacement, ivec3(column, q / shrink * phases + phase, cascade), vec4(a[c], b[c].x, b[c].y / push.wave_vector[cascade].z));
  }
  transform(2u, cascade, column, columns, lane, slot, w, turn, next_turn, a);
  transform(3u, cascade, column, columns, lane, slot, w, turn, next_turn, b);
  for (uint c = 0u; c < 8u; ++c) {
    const uint q = lane + 8u * c;
    if (q % shrink != 0u) continue;
    const ivec3 at = ivec3(column, q / shrink * phases + phase, cascade);
    const float divergence = b[c].x + b[c].y;
    imageStore(derivatives, at, vec4(a[c], b[c]));
    imageStore(moments, at, vec4(a[c] * a[c], a[c].x * a[c].y, divergence * divergence) * push.wave_vector[cascade].w);
  }
}
