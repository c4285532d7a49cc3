// The bodies of a scene's things that float.
#pragma once
#include <memory>
#include <vector>

#include "app/scene.h"
#include "ocean/bodies/sea_bodies.h"

namespace seascape {

// Of all scene.objects.floating, in their order, where the scene places them; null where the scene has none, or does
// not name `boats`.
std::shared_ptr<SeaBodies> scene_bodies(const Scene& scene);

// What bodies are told of sea and air: its gravity, and the wind that makes the waves.
HullMedia body_media(const Settings& settings);

// A mesh cut into what hangs together.
std::vector<HullMesh> parts_of(const HullMesh& mesh);

}  // namespace seascape
