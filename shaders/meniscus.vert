#version 460
// The edge of the water at the lens: where a triangle of the surface passes the near plane, a ribbon on that plane from
// the line of passage upwards. An instance is a patch near the eyes; its triangles are computed once more, from the
// same numbers, so that the ribbon stands on the very line where the picture's sides part.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "shared/patch_instance.h"
#include "shared/phase.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/mesh.glsl"
#include "lib/sea.glsl"
#include "lib/meniscus_plate.glsl"

layout(location = 0) in ivec4 patch_data;  // PatchInstance

layout(location = 0) out vec3 line_of_sight;  // metres from the eye to the near plane
layout(location = 1) out float over_line;     // metres up the near plane from the line
layout(location = 2) out vec3 line_at;        // the line's place beside: metres from the viewer

vec3 corner_at(PatchInstance p, int i, int j) {
  const MeshVertex stands = mesh_vertex(p, i, j);
  const vec4 d = sea_displacement(sea_place(stands.rest, stands.footprint), stands.footprint);
  vec3 relative = curved(stands.rest - frame.viewer.xy + d.xz, d.y, frame.viewer.w);
  relative.y -= frame.viewer.z;
  return relative;
}

void main() {
  const int triangle = gl_VertexIndex / 6, corner = gl_VertexIndex % 6, quad = triangle / 2;
  const int i = quad % patch_quads, j = quad / patch_quads;
  const PatchInstance p = PatchInstance(patch_data.xy, patch_data.z, uint(patch_data.w));
  // As patch_indices() (ocean/mesh/patch_mesh.h) cuts a quad.
  const bool second = (triangle & 1) != 0;
  vec3 at[3];
  at[0] = corner_at(p, second ? i + 1 : i, j);
  at[1] = corner_at(p, i, j + 1);
  at[2] = corner_at(p, i + 1, second ? j + 1 : j);

  const ViewData view = frame.view[eye_index()];
  const Plate plate = plate_before(view);
  float beyond[3];
  for (int n = 0; n < 3; ++n) beyond[n] = dot(plate.ahead, at[n] - view.eye.xyz) - frame.air.z;
  vec3 ends[2];
  int found = 0;
  for (int n = 0; n < 3; ++n) {
    const int next = (n + 1) % 3;
    if ((beyond[n] < 0.0) == (beyond[next] < 0.0) || found == 2) continue;
    ends[found++] = mix(at[n], at[next], beyond[n] / (beyond[n] - beyond[next]));
  }
  // The lower face of a folded crest has its water above.
  const bool upright = cross(at[1] - at[0], at[2] - at[0]).y > 0.0;
  line_of_sight = line_at = vec3(0.0);
  over_line = 0.0;
  gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // before the near plane
  if (found < 2 || !upright) return;
  const int end = corner == 0 || corner == 2 || corner == 3 ? 0 : 1;
  const bool top = corner == 2 || corner == 3 || corner == 5;
  const float below_m = 0.0005;  // so that no sample at the line is left out: the sides say where it ends
  over_line = top ? plate.rises_m : -below_m;
  line_at = ends[end];
  line_of_sight = line_at - view.eye.xyz + over_line * plate.up;
  // Nearer than all that is drawn, and farther than what hides pixels that no eye sees.
  gl_Position = view.clip_from_relative * vec4(view.eye.xyz + 1.001 * line_of_sight, 1.0);
}
