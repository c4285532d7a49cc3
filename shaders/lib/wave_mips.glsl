// Up to three levels of a tile's mip chain at once, each sample the mean of four. Included with TILE_FORMAT defined.
#extension GL_GOOGLE_include_directive : require
#include "shared/wave_compute.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2DArray source;  // a view of one level
layout(binding = 1, TILE_FORMAT) writeonly uniform image2DArray level1;
layout(binding = 2, TILE_FORMAT) writeonly uniform image2DArray level2;
layout(binding = 3, TILE_FORMAT) writeonly uniform image2DArray level3;
layout(push_constant) uniform Push { MipPush push; };

shared vec4 means[64];

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy), here = ivec2(gl_LocalInvocationID.xy);
  const int cascade = int(gl_GlobalInvocationID.z);
  const int last = push.source_size - 1;
  vec4 mean = vec4(0.0);
  if (2 * at.x <= last && 2 * at.y <= last)
    for (int i = 0; i < 4; ++i)
      mean += 0.25 * texelFetch(source, ivec3(min(2 * at + ivec2(i & 1, i >> 1), last), cascade), 0);
  const int size1 = max(1, push.source_size >> 1);
  if (all(lessThan(at, ivec2(size1)))) imageStore(level1, ivec3(at, cascade), mean);
  means[gl_LocalInvocationIndex] = mean;
  barrier();
  if (push.levels >= 2 && all(equal(here & 1, ivec2(0)))) {
    const uint i = gl_LocalInvocationIndex;
    mean = 0.25 * (means[i] + means[i + 1u] + means[i + 8u] + means[i + 9u]);
    if (all(lessThan(at, ivec2(size1)))) imageStore(level2, ivec3(at / 2, cascade), mean);
  }
  barrier();
  if (push.levels >= 2 && all(equal(here & 1, ivec2(0)))) means[gl_LocalInvocationIndex] = mean;
  barrier();
  if (push.levels >= 3 && all(equal(here & 3, ivec2(0)))) {
    const uint i = gl_LocalInvocationIndex;
    mean = 0.25 * (means[i] + means[i + 2u] + means[i + 16u] + means[i + 18u]);
    if (all(lessThan(at, ivec2(size1)))) imageStore(level3, ivec3(at / 4, cascade), mean);
  }
}
