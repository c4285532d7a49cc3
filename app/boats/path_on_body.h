// Camera paths that ride a body: their poses are in its axes.
#pragma once
#include "app/camera_path.h"
#include "app/experience.h"

namespace seascape {

// Throws Error where the path rides a body that the scene does not have.
void validate_rider(const CameraPath& path, const Scene& scene);

// The pose of a moment in the world. Of a path that rides a body the sea is brought to that time first, around a viewer
// who is as yet where he was.
Pose pose_in_world(Experience& experience, const CameraPath& path, const PathSample& sample, double scene_time_s,
                   const glm::dvec3& viewer_m);

// What a body carries, with this share of its pitch and roll left out.
Pose levelled(const Pose& body, double horizon_lock);

}  // namespace seascape
