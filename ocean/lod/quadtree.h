// Chooses the patches of the surface for a viewer: a quadtree over a square that follows the viewer, split by size over
// distance, culled against the union of all eyes. Pure: viewpoint in, list out.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "engine/view.h"
#include "ocean/lod/culling.h"
#include "ocean/lod/lod_settings.h"
#include "shaders/shared/patch_instance.h"

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
  int skirt_rows = gpu::patch_quads;                          // a multiple of gpu::patch_quads, at most three times as many
  int visited_nodes = 0;  // nodes of the tree and skirt strips that were tested against the eyes
  int culled_nodes = 0;   // those of them that no eye can see (with all that is below them)
  int skirt_strips = 0;   // how many of the patches are strips of the skirt
};

class Quadtree {
 public:
  // Throws Error naming the key when a setting is out of range.
  explicit Quadtree(const LodSettings& settings);

  // Takes other settings. Those that only change `freeze` keep the last selection. Throws as the constructor does, and
  // then nothing has changed.
  void apply(const LodSettings& settings);

  // Selects for the viewpoint: levels follow the viewer, culling the eyes (none: nothing is culled, for a map or a test).
  // Neighbouring patches differ by at most one level. The result depends on nothing but the arguments: no history, so a
  // frame drawn alone equals the same frame of a replay. What the viewer's distance decides is taken from its grid point,
  // so a viewer that trembles about a corner of the tree by less than half a unit flips nothing. There is no hysteresis
  // yet: a viewer that moves to and fro over a half unit may change the list each time.
  // With settings.freeze the last selection is kept, re-expressed relative to the new viewer; the first is made as usual.
  // drop_patch counts in the list as it is after culling; beyond its end it drops nothing.
  // No allocation once the list has reached its size. Throws Error when the viewpoint or the bounds are not finite, the
  // viewer is more than 2^50 units from the world's origin, or more than 2^30 from where the selection was frozen.
  const SurfaceSelection& select(const Viewpoint& viewpoint, const DisplacementBounds& bounds);

  int levels() const { return levels_; }  // of patches: the leaves', 0 is the root alone
  const LodSettings& settings() const { return settings_; }

  // A square of LodSettings::patch_quads quads splits while size / distance exceeds split_ratio * threshold, and a patch,
  // which is drawn with fewer quads, while its own does in proportion: the vertices of both are then at most
  // split_ratio * threshold / patch_quads of their distance apart. Distance in three dimensions, from the viewer to the
  // square raised to the water's upper bound.
  // A mesh of a sea misses at most a tenth of its vertices' spacing (measured: 0.07 to 0.11 for the largest of 4,000 points
  // at any spacing of a fresh breeze or a storm). Where that is more than the water moves at all, nothing is gained by
  // splitting: beyond the distance at which all of its motion is below the error allowed, no patch splits.
  static constexpr double split_ratio = 2.4;
  static constexpr double error_over_spacing = 0.1;
  static constexpr int max_square_levels = 12;
  static constexpr int max_levels = 15;  // of patches, with three levels of them in a square of 64 quads
  static constexpr int least_levels = 2;

  // The vertices' spacing over their distance, at most; the finest level's spacing apart.
  static double spacing_over_distance(const LodSettings& settings) { return split_ratio * settings.threshold / settings.patch_quads; }

 private:
  // The split nodes of one level, a bit each, in a window about the viewer. Splitting is local: a level's split nodes
  // lie within size / patch_ratio() of the viewer, plus the ring that balancing adds (see quadtree.cpp).
  struct SplitWindow {
    static constexpr int width = 32;
    int x0 = 0, z0 = 0;
    std::array<std::uint32_t, width> rows{};
    bool get(int x, int z) const {
      const unsigned dx = static_cast<unsigned>(x - x0), dz = static_cast<unsigned>(z - z0);
      return dx < width && dz < width && ((rows[dz] >> dx) & 1u) != 0u;
    }
    void set(int x, int z);
  };
  struct Frame;  // the select call's numbers

  double patch_ratio() const;  // a patch splits while its size / distance exceeds this
  double visible_reach(const Frame& frame) const;
  double split_reach(const Frame& frame, int level) const;
  void lay_skirt(const Frame& frame, double off_centre_m);
  int centre_spacing(const Frame& frame) const;
  void find_splits(const Frame& frame);
  void balance();
  void select_tree(const Frame& frame);
  void select_skirt(const Frame& frame);
  void select_strip(const Frame& frame, unsigned side, int level, int along, unsigned band);
  bool node_may_be_seen(const Frame& frame, int level, int x, int z) const;
  unsigned coarser_edges(int level, int x, int z) const;
  void move_frozen(std::int64_t grid_x, std::int64_t grid_z);

  LodSettings settings_;
  int levels_ = 0;
  double unit_m_ = 1.0;
  bool selected_ = false;
  std::int64_t grid_x_ = 0, grid_z_ = 0;  // of the last selection: its grid origin in units
  std::array<SplitWindow, max_levels> splits_;
  EyeFrusta frusta_;
  SurfaceSelection selection_;
};

}  // namespace seascape
