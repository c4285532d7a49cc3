#include "app/boats/path_on_body.h"

#include "app/scene_hulls.h"
#include "engine/error.h"

namespace seascape {

namespace {

std::size_t body_named(const SceneObjects& objects, const std::string& name) {
  for (std::size_t n = 0; n < objects.floating.size(); ++n)
    if (objects.names[objects.floating[n].thing] == name) return n;
  return objects.floating.size();
}

}  // namespace

Pose levelled(const Pose& body, double horizon_lock) {
  ViewAngles angles = angles_from_orientation(body.orientation);
  angles.pitch_deg *= 1.0 - horizon_lock;
  angles.roll_deg *= 1.0 - horizon_lock;
  return {body.position_m, orientation_from_angles(angles)};
}

void validate_rider(const CameraPath& path, const Scene& scene) {
  if (path.on.empty()) return;
  if (!calls_for(scene, "boats") || body_named(scene.objects, path.on) == scene.objects.floating.size())
    throw Error("--path",
                "path '" + path.name + "' rides '" + path.on + "', and nothing of that name floats in scene '" +
                    scene.name + "'",
                "choose the path's own scene, or give one of its objects that name and a \"float\"", 2);
}

Pose pose_in_world(Experience& experience, const CameraPath& path, const PathSample& sample, double scene_time_s,
                   const glm::dvec3& viewer_m) {
  if (path.on.empty()) return sample.pose;
  experience.sea()->advance(scene_time_s, viewer_m);
  const std::size_t body = body_named(experience.scene().objects, path.on);
  return composed(levelled(experience.bodies()->pose_at(body, scene_time_s), path.horizon_lock), sample.pose);
}

}  // namespace seascape
