// Triangles of the drawn surface that pass an eye's near plane: found by near_corners.comp and near_lines.comp, drawn
// as instances by near_side.vert and meniscus.vert.
#ifndef SEASCAPE_NEAR_LINE_H
#define SEASCAPE_NEAR_LINE_H
#include "gpu_types.h"
#include "patch_instance.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::ivec3;
#endif

// Of a patch.
SEASCAPE_CONST int near_corners = (patch_quads + 1) * (patch_quads + 1), near_triangles = 2 * patch_quads * patch_quads;
SEASCAPE_CONST int near_round = 64;         // patches that near_lines.comp takes at once
SEASCAPE_CONST int near_line_vertices = 6;  // of the two triangles that are drawn along a line

struct NearPatch {
  vec4 corner[near_corners];  // xyz: metres from the viewer, curved as the earth is
  uvec4 passing;              // x: a bit for each triangle that passes
};

struct NearTriangle {
  vec4 corner[3];  // of a NearPatch; counter-clockwise seen from above
};

struct NearLinesPush {
  uint patches, eyes;
  uint room;  // triangles that there is room for
};

// The corners of a patch's triangle, row after row, as patch_indices() (ocean/mesh/patch_mesh.h) cuts a quad.
SEASCAPE_FUNCTION ivec3 near_corner_numbers(int triangle) {
  int quad = triangle / 2, row = patch_quads + 1;
  int at = quad / patch_quads * row + quad % patch_quads;
  return (triangle & 1) == 0 ? ivec3(at, at + row, at + 1) : ivec3(at + 1, at + row, at + row + 1);
}

SEASCAPE_SHARED_END
#endif
