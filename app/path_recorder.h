// Records where the camera goes as the key poses of a path.
#pragma once
#include <string>

#include "app/camera_path.h"

namespace seascape {

class PathRecorder {
 public:
  static constexpr double key_every_s = 0.5;

  bool recording() const { return recording_; }
  // The path begins with this pose at its time 0. `time_s` counts from anywhere.
  void start(double time_s, const Pose& pose, double scene_time_s);
  // Once a frame; takes a key when one is due. Does nothing unless recording.
  void sample(double time_s, const Pose& pose, double scene_time_s);
  // Ends with this pose as the last key and hands the path out.
  CameraPath stop(double time_s, const Pose& pose, double scene_time_s, const std::string& name);

 private:
  void add(double time_s, const Pose& pose, double scene_time_s);
  bool recording_ = false;
  double began_s_ = 0.0;
  CameraPath path_;
};

}  // namespace seascape
