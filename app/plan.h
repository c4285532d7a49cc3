// Reads what an experience has built on its device and what its frames record.
#pragma once
#include "app/experience.h"
#include "app/plan_text.h"

namespace seascape {

// Draws two frames of `experience` at the scene's start: what only the first records is done once. Everything on
// `device` is taken into the plan, under the tag of its EffectScope, so the device must hold nothing but this
// experience.
Plan make_plan(Device& device, ShaderLibrary& shaders, Experience& experience, const std::string& preset);

}  // namespace seascape
