// The skirt that carries the surface from the tree's border to the horizon, a strip outside every leaf on that border.
#pragma once
#include <array>
#include <vector>

#include "ocean/mesh/culling.h"
#include "ocean/mesh/split_map.h"
#include "ocean/mesh/surface_selection.h"

namespace seascape {

// Sets the selection's skirt_to_multiplier, skirt_to_horizon and skirt_rows for a skirt that reaches `reach_m` from the
// tree's centre and keeps the patches' density up to `multiplier` sizes of the tree, no farther than the water's motion
// is seen.
void lay_skirt(const TreeFrame& frame, double multiplier, double reach_m, SurfaceSelection& selection);

// Lists the strips that an eye may see. Keeps room to work in, and where rows lie as long as the skirt is laid the
// same.
class SkirtStrips {
 public:
  static constexpr std::size_t most_bands = 63;

  // Appends them to the selection's patches, and counts them.
  void select(const TreeFrame& frame, const SplitMap& splits, const EyeFrusta& frusta, SurfaceSelection& selection);

 private:
  void find_rows(const SurfaceSelection& selection);

  // Of a side, at a place along it: the strip of band 0.
  struct Leaf {
    double from, to;
    gpu::PatchInstance strip;
  };
  struct Rows {
    double inner, outer;  // what a band reaches from and to, in distances of the border
  };
  std::vector<BorderRange> seen_;
  std::vector<BorderBand> bands_;
  std::array<std::vector<Leaf>, 4> leaves_;  // along the sides
  int rows_ = 0;
  float to_multiplier_ = 0.0f, to_horizon_ = 0.0f;
  std::array<Rows, most_bands> of_band_;
};

}  // namespace seascape
