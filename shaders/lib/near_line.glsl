// Where the drawn surface passes an eye's near plane. An instance is a patch of the sea near the eyes (PatchInstance);
// its triangles are computed once more, six vertices each, from the same numbers, so that lines found here are the
// very lines where the picture's sides part. Included after the uniform block `frame`.
#include "lib/mesh.glsl"
#include "lib/sea.glsl"
#include "lib/meniscus_plate.glsl"

vec3 corner_at(PatchInstance p, int i, int j) {
  const MeshVertex stands = mesh_vertex(p, i, j);
  const vec4 d = sea_displacement(sea_place(stands.rest, stands.footprint), stands.footprint);
  vec3 relative = curved(stands.rest - frame.viewer.xy + d.xz, d.y, frame.viewer.w);
  relative.y -= frame.viewer.z;
  return relative;
}

// Of a vertex's triangle: whether it passes the near plane, its water below; the end of the line where it does, metres
// from the viewer, that this vertex of a ribbon along the line stands at, and whether at the ribbon's upper edge.
bool near_line(PatchInstance p, int vertex, ViewData view, Plate plate, out vec3 end, out bool top) {
  const int triangle = vertex / 6, corner = vertex % 6, quad = triangle / 2;
  const int i = quad % patch_quads, j = quad / patch_quads;
  // As patch_indices() (ocean/mesh/patch_mesh.h) cuts a quad.
  const bool second = (triangle & 1) != 0;
  vec3 at[3];
  at[0] = corner_at(p, second ? i + 1 : i, j);
  // Most triangles are farther from the plane than waves draw their sides out.
  end = vec3(0.0);
  top = false;
  if (abs(dot(plate.ahead, at[0] - view.eye.xyz) - frame.air.z) > 4.0 * float(p.stride) * frame.mesh.unit_m)
    return false;
  at[1] = corner_at(p, i, j + 1);
  at[2] = corner_at(p, i + 1, second ? j + 1 : j);
  float beyond[3];
  for (int n = 0; n < 3; ++n) beyond[n] = dot(plate.ahead, at[n] - view.eye.xyz) - frame.air.z;
  vec3 ends[2];
  int found = 0;
  for (int n = 0; n < 3; ++n) {
    const int next = (n + 1) % 3;
    if ((beyond[n] < 0.0) == (beyond[next] < 0.0) || found == 2) continue;
    ends[found++] = mix(at[n], at[next], beyond[n] / (beyond[n] - beyond[next]));
  }
  end = ends[corner == 0 || corner == 2 || corner == 3 ? 0 : 1];
  top = corner == 2 || corner == 3 || corner == 5;
  // The lower face of a folded crest has its water above.
  return found == 2 && cross(at[1] - at[0], at[2] - at[0]).y > 0.0;
}
