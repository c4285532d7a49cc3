#include "app/path_recorder.h"

#include <utility>

namespace seascape {

void PathRecorder::add(double time_s, const Pose& pose, double scene_time_s) {
  path_.keys.push_back({time_s - began_s_, pose, scene_time_s});
}

void PathRecorder::start(double time_s, const Pose& pose, double scene_time_s) {
  recording_ = true;
  began_s_ = time_s;
  path_ = {};
  add(time_s, pose, scene_time_s);
}

void PathRecorder::sample(double time_s, const Pose& pose, double scene_time_s) {
  if (recording_ && time_s - began_s_ >= path_.keys.back().time_s + key_every_s) add(time_s, pose, scene_time_s);
}

CameraPath PathRecorder::stop(double time_s, const Pose& pose, double scene_time_s, const std::string& name) {
  recording_ = false;
  // The last pose belongs to the path; a key a moment before it would only make it jerk.
  constexpr double least_s = 0.05;
  const double at_s = time_s - began_s_;
  if (path_.keys.size() > 1 && at_s < path_.keys.back().time_s + least_s) path_.keys.pop_back();
  if (at_s > path_.keys.back().time_s) add(time_s, pose, scene_time_s);
  path_.name = name;
  return std::exchange(path_, {});
}

}  // namespace seascape
