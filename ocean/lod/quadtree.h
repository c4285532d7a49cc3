// Chooses the patches of the surface for a viewer: a quadtree over a square that follows the viewer, split by size over
// distance, culled against the union of all eyes. Pure: viewpoint in, list out.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/view.h"
#include "ocean/lod/lod_settings.h"
#include "shaders/shared/patch_instance.h"

namespace seascape {

// What the surface may be displaced by, in metres, anywhere: bounds for culling.
struct DisplacementBounds {
  double vertical_m = 1.0;
  double horizontal_m = 1.0;
};

struct SurfaceSelection {
  std::vector<gpu::PatchInstance> patches;  // tree patches first, then skirt strips
  double unit_m = 1.0;             // metres of one step of PatchInstance's coordinates
  glm::dvec2 grid_origin_m{0.0};   // world x, z of coordinate (0, 0): the viewer's grid point
  glm::ivec2 tree_centre{0, 0};    // the root's centre in the same coordinates
  int half_size = 0;               // half the root's side in the same coordinates
  double horizon_m = 0.0;          // how far the skirt reaches from the viewer, past the true horizon
  int visited_nodes = 0, culled_nodes = 0, skirt_strips = 0;
};

class Quadtree {
 public:
  // Throws Error naming the key when a setting is out of range.
  explicit Quadtree(const LodSettings& settings);

  // Selects for the viewpoint. With settings.freeze the last selection is kept (re-expressed relative to the new viewer).
  // Neighbouring patches differ by at most one level. No allocation once the list has reached its size.
  const SurfaceSelection& select(const Viewpoint& viewpoint, const DisplacementBounds& bounds);

  int levels() const { return levels_; }  // leaf level, 0 is the root alone
  const LodSettings& settings() const { return settings_; }

 private:
  LodSettings settings_;
  int levels_ = 0;
  SurfaceSelection selection_;
  std::vector<std::uint8_t> leaf_level_;  // see quadtree.cpp
};

}  // namespace seascape
