// Meshes of a model that are not drawn: what keeps water out of it, for the sea to clip by, and what floats. Pure.
#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include "engine/gltf.h"
#include "engine/solid_model.h"
#include "ocean/inputs/clip_body.h"

namespace seascape {

struct SolidThing;  // app/solids/solid_instances.h

// The meshes of nodes that the scene does not draw and whose names begin so, in the model's own axes.
std::vector<std::shared_ptr<const Model>> hidden_meshes(const SolidModel& model, std::string_view name);
// Those that hold no water: "inside_". They need not be closed: hull_fault() tells.
inline std::vector<std::shared_ptr<const Model>> inside_hulls(const SolidModel& model) {
  return hidden_meshes(model, "inside_");
}

// One of them where a thing has its model now; `hull` is its number in ClipRoom::hulls. A thing that moves gives its
// velocity and spin too.
ClipBody hull_body(const SolidThing& thing, int hull);

}  // namespace seascape
