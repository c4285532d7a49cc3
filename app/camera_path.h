// A recorded walk of the camera: timed key poses, interpolated smoothly.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/view.h"

namespace seascape {

struct PathKey {
  double time_s = 0.0;        // along the path, strictly increasing
  Pose pose;
  double scene_time_s = 0.0;  // the sea's time there; equal to time_s where the file gives none
};

struct PathSample {
  Pose pose;
  double scene_time_s = 0.0;
};

struct CameraPath {
  std::string name;
  std::vector<PathKey> keys;  // one or more
  double duration_s() const { return keys.empty() ? 0.0 : keys.back().time_s; }
  // Cubic (centripetal Catmull-Rom) in position, spherical (squad) in orientation, monotone in scene time; held at both
  // ends. Passes through every key exactly.
  PathSample at(double time_s) const;
};

CameraPath load_camera_path(const std::string& name_or_file);            // throws Error
void save_camera_path(const CameraPath& path, const std::filesystem::path& file);  // atomic; throws Error

}  // namespace seascape
