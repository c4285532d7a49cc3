// One frame of the experience, from top to bottom.
#pragma once
#include "app/experience.h"

namespace seascape {

// Records the frame into experience.frame(), which the caller has begun: simulates for `time_s` (seconds of the sea),
// selects for the viewpoint, and draws every eye. The picture is experience.picture() once the frame is submitted and
// done.
void draw_frame(Experience& experience, Frame& frame, const Viewpoint& viewpoint, double time_s);

// What shaders are told of a viewpoint before the ocean adds what it knows; of a picture `height` pixels high.
gpu::FrameData frame_data(const Settings& settings, const Viewpoint& viewpoint, std::uint32_t height);

// The water (`felt`) that a camera at `camera_m` floats on in the frame that comes, for whoever moves it before
// draw_frame(). Has the sea advanced to `time_s` (s) and the frame's waves made, so that both share them.
QueryAnswer water_at_camera(Experience& experience, const glm::dvec3& camera_m, double time_s);

}  // namespace seascape
