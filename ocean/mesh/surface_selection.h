// What is drawn of the surface for a viewer: the patches, and the numbers that place their vertices.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "ocean/waves/wave_field.h"
#include "shaders/shared/mesh_data.h"
#include "shaders/shared/patch_instance.h"

namespace seascape {

// What meshes miss besides of data that lie in windows: from `from_m` to `reach_m` away from the viewer, in plan.
struct NearMeshError {
  static constexpr int adds = -1;
  double reach_m = 0.0;
  MeshError error;
  double from_m = 0.0;
  int shares = adds;  // of those of one number from 0 on only the largest counts at a place; others add up
  static constexpr int most_shared = 4;  // numbers
  bool operator==(const NearMeshError& o) const {
    return reach_m == o.reach_m && error.octave_m == o.error.octave_m && from_m == o.from_m && shares == o.shares;
  }
};

// What the surface may be displaced by, in metres, anywhere: bounds for culling; and what meshes of it miss.
struct DisplacementBounds {
  double vertical_m = 1.0;
  double horizontal_m = 1.0;
  MeshError mesh_error;
  // Of the water beneath the viewer, where it is known: its rest place in the world and how it is displaced from there,
  // smoothed over NearMotion::footprint_m; and how far the water about it moves otherwise. Levels then follow the
  // distance from that water, and culling grows bounds by what water that near may be off it.
  struct Below {
    glm::dvec2 rest_m{0.0};
    glm::dvec3 displacement_m{0.0};
    NearMotion motion;
    NearMotion off;  // how far water may stand off it besides, at most, and land with it; by distances as in `motion`
  };
  std::optional<Below> below;
  // To add to mesh_error, nearest first. Of whoever gave the bounds, until its next frame.
  std::span<const NearMeshError> near{};
};

struct SurfaceSelection {
  std::vector<gpu::PatchInstance> patches;  // tree patches first, nearest first within a node, then skirt strips
  double unit_m = 1.0;                      // metres of one step of PatchInstance's coordinates
  glm::dvec2 grid_origin_m{0.0};  // world x, z of coordinate (0, 0): the viewer's grid point, the nearest to it
  gpu::MeshData mesh{};           // what shaders are told
  int half_size = 0;              // half the root's side in the same coordinates
  double horizon_m = 0.0;         // how far the skirt reaches from the viewer, past the true horizon
  int visited_nodes = 0;          // leaves of the tree, and strips of the skirt that are listed
  int culled_nodes = 0;           // leaves that no eye can see
  int skirt_strips = 0;           // how many of the patches are strips of the skirt
};

}  // namespace seascape
