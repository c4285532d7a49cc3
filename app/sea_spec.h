// The sea that a scene describes.
#pragma once
#include <string>

#include "app/scene.h"
#include "ocean/sea/sea_spec.h"

namespace seascape {

// What the scene's effects, settings and inputs make of the sea. Throws Error where they do not go together, or a file
// of theirs cannot be read.
SeaSpec sea_spec(const Scene& scene);

// Differs between two scenes of the same inputs where their seas do, in more than what Sea::draw_in and Sea::change can
// bring about.
std::string sea_key(const Scene& scene);

}  // namespace seascape
