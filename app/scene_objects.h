// The things that a scene file puts somewhere: models with a place, one by one or scattered.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/boats/boat_model.h"
#include "app/faults.h"
#include "app/located_json.h"
#include "app/solids/solid_instances.h"

namespace seascape {

// A thing that floats.
struct FloatingThing {
  std::size_t thing = 0;  // of SceneObjects::things
  FloatSpec floats;
  std::string at;  // file and line, for faults
};

struct SceneObjects {
  std::vector<PlacedModel> models;  // each file once
  std::vector<SolidThing> things;
  std::vector<std::string> names;       // of the things; those that are scattered have a number behind theirs
  std::vector<FloatingThing> floating;  // in the order of the things
  // Pieces of lines and chains, behind all other things (app/boats/line_shape.h).
  struct Lines {
    std::size_t first = 0, drawn = 0;  // of the things: the first piece, and behind the last that is shown
    std::size_t rope = 0, chain = 0;   // models
  };
  std::optional<Lines> lines;
  bool empty() const { return things.empty(); }
};

inline constexpr std::size_t most_objects = 4096;   // in a file
inline constexpr std::size_t most_things = 100000;  // with all that are scattered
inline constexpr std::size_t most_floating = 4096;

// Reads the list of a scene's key "objects". A model is a .glb or .gltf file beside the scene, or the name of one in
// content/models. `effects` are those that the scene names: objects need `models`, those that float `boats`. Faults
// name file and line, key, value, range and remedy.
SceneObjects read_objects(const LocatedJson& list, const std::vector<std::string>& effects, const std::string& where,
                          Faults& faults);

}  // namespace seascape
