// What a scene's things keep free of water, and what the scene calls for because of them.
#pragma once
#include <string_view>
#include <vector>

#include "app/scene.h"
#include "ocean/bodies/sea_bodies.h"
#include "ocean/effects.h"

namespace seascape {

inline constexpr std::size_t most_still_hulls = 4096;  // of all things together

// Room for the scene's bodies (Scene::clip_room) and for those of its things that float, and the inside hulls of the
// others where they stand: of those that water may reach. None without the effect models.
ClipRoom hulls_of(const Scene& scene);
// Of each floating thing, in their order, its hulls in that room; the first most_clip_bodies have it.
std::vector<BodyInsides> insides_of(const Scene& scene);

// Throws Error, of which `where` is the place, for more hulls than a sea takes: most_still_hulls, or most_input_hulls
// different ones with those of inputs.
void validate_hulls(const Scene& scene, const std::string& where);

// The effects that the scene names, what they need, and `clip` where things keep water out.
std::vector<EffectEntry> called_for(const Scene& scene);
bool calls_for(const Scene& scene, std::string_view effect);

}  // namespace seascape
