// Where vertex (i, j) of a patch lies: the one mapping that lets every patch and skirt strip use one index buffer.
#ifndef SEASCAPE_PATCH_VERTEX_H
#define SEASCAPE_PATCH_VERTEX_H
#include "gpu_types.h"
#include "mesh_data.h"
#include "patch_instance.h"
#include "skirt.h"
SEASCAPE_SHARED_BEGIN

// The whole-number coordinate of vertex (i, j), 0 <= i, j <= patch_quads.
// A tree patch: i along +x, j along +z; on an edge whose bit is set an odd vertex falls onto the even one below it, so
// that the edge has exactly the coarser neighbour's vertices (every second triangle along it becomes empty).
// A skirt strip: the coordinate of its border vertex, the same for every row j. i runs along the border in the
// direction that keeps the triangles counter-clockwise seen from above with j outwards: north +x, west +z, south -x,
// east -z.
SEASCAPE_FUNCTION ivec2 patch_coordinate(PatchInstance p, int i, int j) {
  int quads = patch_quads;
  if ((p.flags & patch_skirt) != 0u) {
    uint side = (p.flags >> patch_skirt_side_shift) & 3u;
    if (side == 0u) return p.corner + ivec2(0, p.stride * (quads - i));
    if (side == 1u) return p.corner + ivec2(p.stride * i, 0);
    if (side == 2u) return p.corner + ivec2(0, p.stride * i);
    return p.corner + ivec2(p.stride * (quads - i), 0);
  }
  int x = i;
  int z = j;
  if ((i == quads && (p.flags & patch_east) != 0u) || (i == 0 && (p.flags & patch_west) != 0u)) z = j - (j & 1);
  if ((j == quads && (p.flags & patch_north) != 0u) || (j == 0 && (p.flags & patch_south) != 0u)) x = i - (i & 1);
  return p.corner + p.stride * ivec2(x, z);
}

// How many of the skirt's rows lie between a vertex and the tree's border: 0 for every vertex of the tree.
SEASCAPE_FUNCTION int patch_skirt_row(PatchInstance p, int j) {
  if ((p.flags & patch_skirt) == 0u) return 0;
  return int((p.flags >> patch_skirt_band_shift) & 63u) * patch_quads + j;
}

// Where the vertex stands, in units from the grid origin: slid to its coarser neighbour as far as mesh.morph says, and
// the skirt's rows moved outwards from the tree's centre. Row 0 of a strip returns the very numbers of the patch that
// it joins. Metres relative to the viewer are patch_vertex(...) * unit_m - viewer_fraction, with viewer_fraction =
// viewer - grid_origin_m.
SEASCAPE_FUNCTION vec2 patch_vertex(PatchInstance p, int i, int j, MeshData mesh) {
  vec2 place = morphed(mesh.morph, patch_coordinate(p, i, j), mesh.tree_centre, p.stride);
  int row = patch_skirt_row(p, j);
  if (row == 0) return place;
  vec2 centre = vec2(mesh.tree_centre);
  return centre + (place - centre) * skirt_scale(row, mesh.skirt_rows, mesh.skirt_to_multiplier, mesh.skirt_to_horizon);
}

SEASCAPE_SHARED_END
#endif
