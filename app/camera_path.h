// A recorded walk of the camera: timed key poses, interpolated smoothly, and what was done on the way.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/faults.h"
#include "engine/view.h"
#include "platform/input_script.h"

namespace seascape {

// A direction of view in degrees: yaw clockwise from -z seen from above, pitch upwards, roll of the head to its right.
struct ViewAngles {
  double yaw_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
};

glm::dquat orientation_from_angles(const ViewAngles& angles);
// Yaw and roll in [-180, 180], pitch in [-90, 90]; looking straight up or down has roll 0.
ViewAngles angles_from_orientation(const glm::dquat& orientation);

struct PathKey {
  double time_s = 0.0;  // along the path, strictly increasing
  Pose pose;
  double scene_time_s = 0.0;  // the sea's time there; equal to time_s where the file gives none
};

struct PathSample {
  Pose pose;
  double scene_time_s = 0.0;
};

inline constexpr std::size_t most_path_keys = 100'000;

struct CameraPath {
  std::string name;
  std::vector<PathKey> keys;  // one to most_path_keys
  std::string on;             // the body that all poses are seen from; empty: the world
  double horizon_lock = 0.0;  // share of its pitch and roll that they leave out, 0 to 1
  // What hands and actions did, by the path's time; hands are in the world. Its head is the keys.
  std::optional<InputScript> actions;
  double duration_s() const { return keys.empty() ? 0.0 : keys.back().time_s; }
  // Cubic in time through every key exactly: Hermite in position, its counterpart on unit quaternions in orientation,
  // both with continuous velocities that come to rest at both ends; monotone between keys in scene time. Held before
  // the first key and after the last. A hold stays still, and between two keys the height stays between theirs.
  PathSample at(double time_s) const;
};

// `name_or_file` is a path, or the name of one in content/paths. Throws Error with file and line.
CameraPath load_camera_path(const std::string& name_or_file);
CameraPath parse_camera_path(std::string_view text, const std::string& where);
CameraPath parse_camera_path(std::string_view text, const std::string& where, Faults& faults);  // may collect

// The text of a path file: every number reads back as the same double.
std::string camera_path_text(const CameraPath& path);
std::string path_key_text(const PathKey& key);                                     // one of its keys
void save_camera_path(const CameraPath& path, const std::filesystem::path& file);  // atomic; throws Error

}  // namespace seascape
