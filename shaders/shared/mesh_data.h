// What shaders are told of the mesh: the block of the planar quadtree. Only patch_vertex.h, vertex_morph.h and
// lib/mesh.glsl read it.
#ifndef SEASCAPE_MESH_DATA_H
#define SEASCAPE_MESH_DATA_H
#include "gpu_types.h"
#include "vertex_morph.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::ivec2;
#endif

// Places are in units, from the grid origin.
struct MeshData {
  ivec2 tree_centre;          // the root's
  int skirt_rows;             // a multiple of patch_quads, 63 times as many at most
  float unit_m;               // metres a unit
  float skirt_to_multiplier;  // for skirt_scale()
  float skirt_to_horizon;
  vec2 from_grid;     // of the bed: metres from the grid origin of the surface to its own
  VertexMorph morph;  // how vertices slide; with lod.join = masked none does
};

SEASCAPE_SHARED_END
#endif
