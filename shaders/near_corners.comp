#version 460
// Where the drawn surface passes an eye's near plane: of a patch about it, computed once more from the same numbers as
// it is drawn, the corners, and which of its triangles pass. A group works on a patch.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "shared/near_line.h"

layout(local_size_x = near_triangles) in;
layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/mesh.glsl"
#include "lib/sea.glsl"
layout(std430, binding = slot_near_patches) readonly buffer Patches { PatchInstance patches[]; };
layout(std430, binding = slot_near_found) writeonly buffer Found { NearPatch found[]; };
layout(push_constant) uniform Push { NearLinesPush push; };

shared vec3 corner[near_corners];
shared uint passing;

vec3 corner_at(PatchInstance p, int i, int j) {
  const MeshVertex stands = mesh_vertex(p, i, j);
  const vec4 d = sea_displacement(sea_place(stands.rest, stands.footprint), stands.footprint);
  vec3 relative = curved(stands.rest - frame.viewer.xy + d.xz, d.y, frame.viewer.w);
  relative.y -= frame.viewer.z;
  return relative;
}

bool passes(ViewData view, vec3 a, vec3 b, vec3 c) {
  const mat4 clip = view.clip_from_relative;
  const vec3 ahead = normalize(vec3(clip[0].w, clip[1].w, clip[2].w));
  const bvec3 before =
      lessThan(vec3(dot(ahead, a - view.eye.xyz), dot(ahead, b - view.eye.xyz), dot(ahead, c - view.eye.xyz)),
               vec3(frame.air.z));
  return any(before) && !all(before);
}

void main() {
  const int n = int(gl_LocalInvocationIndex);
  if (n == 0) passing = 0u;
  if (n < near_corners) {
    corner[n] = corner_at(patches[gl_WorkGroupID.x], n % (patch_quads + 1), n / (patch_quads + 1));
    found[gl_WorkGroupID.x].corner[n] = vec4(corner[n], 0.0);
  }
  barrier();
  const ivec3 numbers = near_corner_numbers(n);
  const vec3 a = corner[numbers.x], b = corner[numbers.y], c = corner[numbers.z];
  // The lower face of a folded crest has its water above.
  if (cross(b - a, c - a).y > 0.0)
    for (uint eye = 0u; eye < push.eyes; ++eye)
      if (passes(frame.view[eye], a, b, c)) atomicOr(passing, 1u << n);
  barrier();
  if (n == 0) found[gl_WorkGroupID.x].passing = uvec4(passing, 0u, 0u, 0u);
}
