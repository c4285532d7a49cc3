// Chooses the patches of the surface for a viewer: a quadtree over a square that follows the viewer, split until its
// mesh misses the sea by no more pixels than are allowed, culled against the union of all eyes. Pure: viewpoint in,
// list out.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/view.h"
#include "ocean/mesh/culling.h"
#include "ocean/mesh/leaf_runs.h"
#include "ocean/mesh/lod_settings.h"
#include "ocean/mesh/mesher.h"
#include "ocean/mesh/near_reaches.h"
#include "ocean/mesh/skirt_strips.h"
#include "ocean/mesh/split_map.h"
#include "ocean/mesh/tree_frame.h"
#include "ocean/mesh/water_below.h"

namespace seascape {

class Quadtree final : public Mesher {
 public:
  // Throws Error naming the key when a setting is out of range.
  explicit Quadtree(const LodSettings& settings);

  // Takes other settings. Those that only change `freeze` keep the last selection. Throws as the constructor does, and
  // then nothing has changed.
  void apply(const LodSettings& settings) override;

  // Selects for the viewpoint: levels follow the viewer, culling the eyes (none: nothing is culled, for a map or a
  // test). Neighbouring patches differ by at most one level. The result depends on nothing but the arguments: no
  // history, so a frame drawn alone equals the same frame of a replay. What the viewer's distance decides is taken from
  // its grid point, so a viewer that trembles about a corner of the tree by less than half a unit flips nothing. There
  // is no hysteresis, which would be history: a viewer that moves to and fro over a half unit may change the list each
  // time. Where vertices slide (lod.join) they have arrived before the level changes, so that the list changes and the
  // surface does not. With settings.freeze the last selection is kept, re-expressed relative to the new viewer; the
  // first is made as usual. drop_patch counts in the list as it is after culling; beyond its end it drops nothing. No
  // allocation once the list has reached its size. Throws Error when the viewpoint or the bounds are not finite, the
  // viewer is more than 2^50 units from the world's origin, or more than 2^30 from where the selection was frozen.
  // Of water.field and water.tiles patches are left out that no eye sees as the water stands; and patches of the tree,
  // but no frozen ones, all of whose water within the bounds is gone.
  const SurfaceSelection& select(const Viewpoint& viewpoint, const MeshWater& water) override;
  const SurfaceSelection& select(const Viewpoint& viewpoint, const DisplacementBounds& bounds) {
    return select(viewpoint, MeshWater(bounds));
  }

  int levels() const { return levels_; }  // of patches in the ocean's square: 0 is that alone
  const LodSettings& settings() const { return settings_; }

  // How far vertices may be apart at a distance. By settings.pixel_error: as far as a mesh of the sea misses it by no
  // more than that many pixels there (DisplacementBounds::mesh_error, Viewpoint::pixels_per_radian). By
  // settings.threshold: split_ratio * threshold / patch_quads of the distance, which is a square of patch_quads quads
  // that splits while size / distance exceeds split_ratio * threshold. Distance in three dimensions, from the viewer to
  // the square raised to the water's upper bound. Where a mesh that coarse misses more than the water moves at all,
  // nothing is gained by splitting: beyond the distance at which all of its motion is below the error allowed, no patch
  // splits.
  static constexpr double split_ratio = 0.5;
  // What a mesh misses at most over its vertices' spacing, where the sea does not say (measured: 0.07 to 0.12 in a
  // fresh breeze or a storm).
  static constexpr double error_over_spacing = MeshError::most_over_spacing;
  static constexpr int max_square_levels = 12;
  static constexpr int max_levels = 17;  // of patches, with three levels of them in a square of 64 quads
  static constexpr int least_levels = TreeFrame::least_levels;

  // By the threshold: the vertices' spacing over their distance, at most; the finest level's spacing apart.
  static double spacing_over_distance(const LodSettings& settings) {
    return split_ratio * settings.threshold / settings.patch_quads;
  }

 private:
  // How far levels reach, in units (TreeFrame::reach and the names after it), and of what: found anew where that is
  // another. No history: what was found before is what would be found.
  struct Reaches {
    struct Asked {
      double pixels_per_radian = 0.0, vertical_m = 0.0;
      MeshError mesh_error;
      std::span<const NearMeshError> near;
      double over_m = 0.0;  // the viewer, over water that is near
      std::optional<NearMotion> motion;
      bool operator==(const Asked& o) const {
        return pixels_per_radian == o.pixels_per_radian && vertical_m == o.vertical_m &&
               mesh_error.octave_m == o.mesh_error.octave_m && over_m == o.over_m &&
               motion.has_value() == o.motion.has_value() &&
               (!motion ||
                (motion->vertical_m == o.motion->vertical_m && motion->horizontal_m == o.motion->horizontal_m));
      }
    };
    bool known = false;
    Asked asked;  // but for its `near`, which is
    std::vector<NearMeshError> near;
    int levels = 0;
    std::array<double, TreeFrame::max_levels> reach{};
    double border_spacing = 1.0, visible = 0.0;
  };
  void find_reaches(const Reaches::Asked& asked);
  void leave_out(const MeshWater& water);
  void find_leaves(const TreeFrame& frame, const DisplacementBounds& bounds);
  void list_leaves(const TreeFrame& frame);
  unsigned coarser_sides(int level, int x, int z, int end) const;
  void move_frozen(std::int64_t grid_x, std::int64_t grid_z);

  LodSettings settings_;
  int levels_ = 0;
  double unit_m_ = 1.0;
  bool selected_ = false;
  std::int64_t grid_x_ = 0, grid_z_ = 0;  // of the last selection: its grid origin in units
  SplitMap splits_;
  EyeFrusta frusta_;
  std::vector<BoxRange> seen_;  // of the rows of a level
  Reaches reaches_;
  NearReaches near_reaches_;
  SkirtStrips skirt_;
  std::vector<LeafRun> runs_;      // of all levels, finer ones first
  std::vector<LeafLevel> leaves_;  // that have any
  WaterCulling cull_by_water_;
  SurfaceSelection selection_;
};

}  // namespace seascape
