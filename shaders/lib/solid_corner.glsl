// A corner of a solid thing, on the curved sea: for vertex shaders that have declared the uniform block `frame`.
#include "shared/earth_curve.h"
#include "shared/solid_data.h"

layout(location = 0) in vec4 corner_place;  // SolidVertex
layout(location = 1) in vec4 corner_normal;
layout(location = 2) in vec4 corner_uv;
layout(location = 3) in vec4 corner_colour;
layout(location = 4) in vec4 row_x;  // SolidInstance
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;

layout(location = 0) out vec3 relative;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 uv;
layout(location = 3) out vec4 tint;

void place_corner() {
  const vec4 from = vec4(corner_place.xyz, 1.0);
  const vec3 on_sea = vec3(dot(row_x, from), dot(row_y, from), dot(row_z, from));
  relative = curved(on_sea.xz, on_sea.y, frame.viewer.w) - vec3(0.0, frame.viewer.z, 0.0);
  // The cofactors, which turn normals of flattened things too, and of mirrored ones inwards: their triangles are turned
  // round, so these are turned back.
  const vec3 x = row_x.xyz, y = row_y.xyz, z = row_z.xyz;
  const mat3 cofactors = mat3(cross(y, z), cross(z, x), cross(x, y));
  normal = vec3(dot(cofactors[0], corner_normal.xyz), dot(cofactors[1], corner_normal.xyz),
                dot(cofactors[2], corner_normal.xyz));
  if (dot(x, cofactors[0]) < 0.0) normal = -normal;
  uv = corner_uv;
  tint = corner_colour;
}
