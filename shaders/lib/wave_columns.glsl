// The second half of the inverse transforms: along z, for every column, straight into the tiles. Included with
// TILE_FORMAT defined.
#extension GL_GOOGLE_include_directive : require
#include "shared/wave_compute.h"
#include "lib/fft64.glsl"

// Eight neighbouring columns at one phase a workgroup.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Rows { vec2 rows[]; };
layout(binding = 1, TILE_FORMAT) writeonly uniform image2DArray displacement;  // Dx, h, Dz, 0
layout(binding = 2, TILE_FORMAT) writeonly uniform image2DArray derivatives;   // dh/dx, dh/dz, dDx/dx, dDz/dz
layout(binding = 3, TILE_FORMAT) writeonly uniform image2DArray moments;       // (dh/dx)^2, (dh/dz)^2, their product, dDx/dz
layout(push_constant) uniform Push { WavePush push; };

shared vec2 exchanged[8 * 72];

void main() {
  const uint cascade = gl_WorkGroupID.z, phase = gl_WorkGroupID.y;
  const uint phases = max(1u, uint(push.resolution) / 64u);
  const uint log2_n = max(6u, uint(findMSB(uint(push.resolution))));
  const uint lane = gl_LocalInvocationIndex >> 3, slot = gl_LocalInvocationIndex & 7u;
  const uint column = gl_WorkGroupID.x * 8u + slot;
  const uint columns = uint(push.resolution);
  vec2 w[8], turn[8];
  twiddles(lane, w);
  phase_twiddles(lane, phase, log2_n, turn);
  vec2 result[wave_fields][8];
  for (uint field = 0u; field < uint(wave_fields); ++field) {
    const uint source = (cascade * uint(wave_fields) + field) * 64u;
    vec2 v[8];
    for (uint r = 0u; r < 8u; ++r) v[r] = times(rows[(source + bin_index(lane, r)) * columns + column], turn[r]);
    dft8(v);
    barrier();
    for (uint c = 0u; c < 8u; ++c) exchanged[slot * 72u + c * 9u + lane] = times(v[c], w[c]);
    barrier();
    for (uint t = 0u; t < 8u; ++t) v[t] = exchanged[slot * 72u + lane * 9u + t];
    dft8(v);
    for (uint c = 0u; c < 8u; ++c) result[field][c] = v[c];
  }
  const uint shrink = max(1u, 64u / uint(push.resolution));
  for (uint c = 0u; c < 8u; ++c) {
    const uint q = lane + 8u * c;
    if (q % shrink != 0u) continue;
    const ivec3 at = ivec3(column, q / shrink * phases + phase, cascade);
    const vec2 slope = result[2][c];
    imageStore(displacement, at, vec4(result[0][c].x, result[0][c].y, result[1][c].x, 0.0));
    imageStore(derivatives, at, vec4(slope, result[3][c]));
    imageStore(moments, at, vec4(slope * slope, slope.x * slope.y, result[1][c].y));
  }
}
