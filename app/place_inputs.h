// What a scene says of the sea's places, as the effects it calls for ask for it.
#pragma once
#include "app/scene.h"
#include "app/tile_sources.h"
#include "ocean/foam/foam_sea.h"
#include "ocean/sea/place_sea.h"

namespace seascape {

// Of the built effects only, and none of a kind that nothing feeds and that would be the same everywhere as without the
// effect.
PlaceInputs place_inputs(const Scene& scene, const MadeBefore* before = nullptr);

// What it says of foam; none without the effect.
std::optional<FoamSpec> foam_spec(const Scene& scene);

}  // namespace seascape
