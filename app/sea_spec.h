// The sea that a scene describes.
#pragma once
#include <string>

#include "app/scene.h"
#include "app/tile_sources.h"
#include "ocean/sea/sea_spec.h"

namespace seascape {

// What the scene's effects, settings and inputs make of the sea. Throws Error where they do not go together, or a file
// of theirs cannot be read.
SeaSpec sea_spec(const Scene& scene, const MadeBefore* before = nullptr);

// Differs between two scenes of the same inputs where their seas do, in more than the picture's quality
// (Sea::draw_in).
std::string sea_key(const Scene& scene);

}  // namespace seascape
