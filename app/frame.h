// One frame of the experience, from top to bottom.
#pragma once
#include "app/experience.h"

namespace seascape {

// Records the frame into experience.frame(), which the caller has begun: simulates for `time_s` (seconds of the sea),
// selects for the viewpoint, and draws every eye. The picture is experience.picture() once the frame is submitted and
// done.
void draw_frame(Experience& experience, Frame& frame, const Viewpoint& viewpoint, double time_s);

}  // namespace seascape
