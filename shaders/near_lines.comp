#version 460
// Lists the triangles that pass a near plane (near_corners.comp) in their patches' order, and says how many are drawn.
// One group works on all.
#extension GL_GOOGLE_include_directive : require
#include "shared/near_line.h"
#include "shared/slots.h"

layout(local_size_x = near_round) in;
layout(std430, binding = slot_near_found) readonly buffer Found { NearPatch found[]; };
layout(std430, binding = slot_near_listed) writeonly buffer Listed { NearTriangle listed[]; };
layout(std430, binding = slot_near_draw) writeonly buffer Draw { uvec4 draw; };  // VkDrawIndirectCommand
layout(push_constant) uniform Push { NearLinesPush push; };

shared uint counts[near_round];

void main() {
  const uint n = gl_LocalInvocationIndex;
  uint listed_before = 0u;  // in the rounds before
  for (uint first = 0u; first < push.patches; first += uint(near_round)) {
    const uint number = first + n;
    uint mask = number < push.patches ? found[number].passing.x : 0u;
    counts[n] = uint(bitCount(mask));
    barrier();
    uint at = listed_before;
    for (uint i = 0u; i < uint(near_round); ++i) {
      if (i < n) at += counts[i];
      listed_before += counts[i];
    }
    barrier();
    for (; mask != 0u && at < push.room; mask &= mask - 1u) {
      const ivec3 numbers = near_corner_numbers(findLSB(mask));
      listed[at].corner[0] = found[number].corner[numbers.x];
      listed[at].corner[1] = found[number].corner[numbers.y];
      listed[at].corner[2] = found[number].corner[numbers.z];
      ++at;
    }
  }
  if (n == 0u) draw = uvec4(near_line_vertices, min(listed_before, push.room), 0u, 0u);
}
