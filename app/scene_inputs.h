// The inputs that a scene file lists: splines, areas, whirlpools, models, pictures and trails, each with what it feeds.
// docs/inputs.md has every key.
#pragma once
#include <string>
#include <vector>

#include "app/faults.h"
#include "app/located_json.h"
#include "ocean/inputs/input_spec.h"

namespace seascape {

// Reads the list of a scene's key "inputs", with the files it names, which lie relative to the scene. `effects` are
// those the scene names: an input needs the one that it feeds. `where` is the scene's file. Faults name file and line,
// key, value, range and remedy; inputs without a fault come back.
std::vector<InputSpec> read_inputs(const LocatedJson& list, const std::vector<std::string>& effects,
                                   const std::string& where, Faults& faults);

}  // namespace seascape
