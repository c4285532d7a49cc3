// The skirt that carries the surface from the tree's border to the horizon, a strip outside every leaf on that border.
#pragma once
#include "ocean/lod/culling.h"
#include "ocean/lod/split_map.h"
#include "ocean/lod/surface_selection.h"

namespace seascape {

// Sets the selection's skirt_to_multiplier, skirt_to_horizon and skirt_rows for a skirt that reaches `reach_m` from the
// tree's centre and keeps the patches' density up to `multiplier` sizes of the tree, no farther than the water's motion is seen.
void lay_skirt(const TreeFrame& frame, double multiplier, double reach_m, SurfaceSelection& selection);

// Appends the strips that an eye may see, and counts them. `seen` is room to work in.
void select_skirt(const TreeFrame& frame, const SplitMap& splits, const EyeFrusta& frusta, std::vector<BorderRange>& seen, SurfaceSelection& selection);

}  // namespace seascape
