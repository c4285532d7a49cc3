// Poses as files of ours have them: read with their faults, and written so that every number reads back.
#pragma once
#include <string>

#include "app/located_json.h"
#include "engine/view.h"

namespace seascape {

// The keys of a pose among those of the object that `reader` reads: "position_m", required, and "orientation" (a unit
// quaternion) or "yaw_deg", "pitch_deg" and "roll_deg", which are 0 by default. `json` is that object.
Pose read_pose(ObjectReader& reader, const LocatedJson& json, const std::string& where, Faults& faults);

// `"position_m": [x, y, z], "orientation": [x, y, z, w]`.
std::string pose_text(const Pose& pose);

}  // namespace seascape
