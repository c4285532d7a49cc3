// The mesh: where its vertices stand, and how far apart they are. Nothing else in the shaders knows how it was made.
// Included after the uniform block `frame` (FrameData) has been declared.
#ifndef SEASCAPE_MESH_GLSL
#define SEASCAPE_MESH_GLSL
#include "shared/patch_vertex.h"

struct MeshVertex {
  vec2 rest;        // rest position, metres from the grid origin
  float footprint;  // what its displacement is averaged over, metres
};

// Vertex (i, j) of a patch.
MeshVertex mesh_vertex(PatchInstance p, int i, int j) {
  const vec2 stands = patch_vertex(p, i, j, frame.mesh);
  const float unit_m = frame.mesh.unit_m;
  return MeshVertex(stands * unit_m, displacement_footprint(frame.mesh.morph, stands) * unit_m);
}

// How far vertices are apart at most, in metres: it follows distance from the viewer alone, never the patch, so that
// shared vertices agree to the bit.
float mesh_spacing(vec2 rest) {
  const float unit_m = frame.mesh.unit_m;
  return vertex_spacing(frame.mesh.morph, rest / unit_m) * unit_m;
}

#endif
