// Where a frame's eyes are: in the air, in the water, or where each pixel has to be asked.
#pragma once
#include "app/experience.h"

namespace seascape {

// Tells shaders which eyes may be in the water, what shapes of air and portals are about them, the lamp that the viewer
// carries, and the exposure that eyes in the water get used to. `data` has the sun and the water already; with
// Experience::underwater().
Ocean::EyesSide find_eyes(Experience& experience, gpu::FrameData& data, const Viewpoint& viewpoint);

}  // namespace seascape
