// Where a triangle of the drawn surface passes an eye's near plane: the very line where the picture's sides part, for
// its corners are found from the same numbers (near_corners.comp). Included after the uniform block `frame`.
#include "shared/near_line.h"
#include "lib/meniscus_plate.glsl"

// An instance is a NearTriangle.
layout(location = 0) in vec3 corner_0;
layout(location = 1) in vec3 corner_1;
layout(location = 2) in vec3 corner_2;

// Whether the triangle passes the plane of this eye; the end of the line where it does, metres from the viewer, that
// the vertex stands at of a ribbon along the line, and whether at the ribbon's upper edge.
bool near_line(ViewData view, Plate plate, out vec3 end, out bool top) {
  const vec3 at[3] = vec3[](corner_0, corner_1, corner_2);
  float beyond[3];
  for (int n = 0; n < 3; ++n) beyond[n] = dot(plate.ahead, at[n] - view.eye.xyz) - frame.air.z;
  vec3 ends[2] = vec3[](vec3(0.0), vec3(0.0));
  int found = 0;
  for (int n = 0; n < 3; ++n) {
    const int next = (n + 1) % 3;
    if ((beyond[n] < 0.0) == (beyond[next] < 0.0) || found == 2) continue;
    ends[found++] = mix(at[n], at[next], beyond[n] / (beyond[n] - beyond[next]));
  }
  const int vertex = gl_VertexIndex;
  end = ends[vertex == 0 || vertex == 2 || vertex == 3 ? 0 : 1];
  top = vertex == 2 || vertex == 3 || vertex == 5;
  return found == 2;
}
