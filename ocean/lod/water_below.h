// What the water about a viewer does now: which water stands beneath, and which patches no eye sees as it stands.
#pragma once
#include "ocean/lod/surface_selection.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

class EyeFrusta;

// The water beneath a viewer, by the waves that a footprint of NearMotion::footprint_m leaves, which fold nowhere: the search always
// ends, and what it finds moves as smoothly as the water does. `viewer_m` in the world; not finite: none.
std::optional<DisplacementBounds::Below> water_below(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& viewer_m,
                                                     const NearMotion& motion);

// Takes the near patches off the list that no eye sees as their water stands, which culling by bounds cannot tell: a patch's water lies
// about its corners, no farther off than a mesh of its size misses, times `cull_scale`. `frusta` as the tree was culled with
// (relative to its grid origin), `tiles` with all waves that are drawn. Looks at patches of up to 4 m.
void cull_by_water(const WaveField& field, const WaveTiles& tiles, const EyeFrusta& frusta, double cull_scale, const glm::dvec3& viewer_m,
                   SurfaceSelection& selection);

}  // namespace seascape
