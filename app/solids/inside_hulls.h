// The hulls of a model that keep water out of it, for the sea to clip by. Pure.
#pragma once
#include <memory>
#include <vector>

#include "engine/gltf.h"
#include "engine/solid_model.h"
#include "ocean/inputs/clip_body.h"

namespace seascape {

struct SolidThing;  // app/solids/solid_instances.h

// The meshes of nodes that the scene does not draw and whose names begin with "inside_", in the model's own axes. They
// need not be closed: hull_fault() tells.
std::vector<std::shared_ptr<const Model>> inside_hulls(const SolidModel& model);

// One of them where a thing has its model now; `hull` is its number in ClipRoom::hulls. A thing that moves gives its
// velocity and spin too.
ClipBody hull_body(const SolidThing& thing, int hull);

}  // namespace seascape
