// What feeds a scene's sea beside its waves, by the effects that it names.
#pragma once
#include "app/scene.h"
#include "ocean/waves/gerstner.h"
#include "ocean/waves/sea_limits.h"
#include "ocean/waves/tile_source.h"

namespace seascape {

struct SeaSpec;  // ocean/sea/sea_spec.h

// What was made of the same effects and inputs under other settings: what these did not change is shared with it.
struct MadeBefore {
  const Settings& settings;
  const SeaSpec& sea;
};

// One source for each effect of the scene's closure that is one, in the order of their names in the design; made for
// its settings, wave particles as `limited` has them. Throws Error where they do not go together.
TileSources tile_sources(const Scene& scene, const LimitedSea& limited, const MadeBefore* before = nullptr);

// The tile of the sets that run along the scene's splines; null where there are no such sets or no splines.
std::shared_ptr<const Gerstner> shore_gerstner(const Scene& scene, const MadeBefore* before = nullptr);

}  // namespace seascape
