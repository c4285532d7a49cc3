// What is drawn of the surface for a viewer: the patches, and the numbers that place their vertices.
#pragma once
#include <vector>

#include "shaders/shared/patch_instance.h"
#include "shaders/shared/vertex_morph.h"

namespace seascape {

// What the surface may be displaced by, in metres, anywhere: bounds for culling.
struct DisplacementBounds {
  double vertical_m = 1.0;
  double horizontal_m = 1.0;
};

struct SurfaceSelection {
  std::vector<gpu::PatchInstance> patches;  // tree patches first, nearest first within a node, then skirt strips
  double unit_m = 1.0;             // metres of one step of PatchInstance's coordinates
  glm::dvec2 grid_origin_m{0.0};   // world x, z of coordinate (0, 0): the viewer's grid point, the nearest to it
  glm::ivec2 tree_centre{0, 0};    // the root's centre in the same coordinates
  int half_size = 0;               // half the root's side in the same coordinates
  double horizon_m = 0.0;          // how far the skirt reaches from the viewer, past the true horizon
  float skirt_to_multiplier = 1.0f, skirt_to_horizon = 2.0f;  // for skirt_scale of shaders/shared/skirt.h
  int skirt_rows = gpu::patch_quads;                          // a multiple of gpu::patch_quads, 31 times as many at most
  gpu::VertexMorph morph{};         // how vertices slide; with lod.join = masked none does
  int visited_nodes = 0;  // nodes of the tree and skirt strips that were considered
  int culled_nodes = 0;   // those of them that no eye can see (with all that is below them)
  int skirt_strips = 0;   // how many of the patches are strips of the skirt
};

}  // namespace seascape
