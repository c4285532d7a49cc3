// Records where the camera goes as the key poses of a path, and what hands and actions do on the way.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/camera_path.h"

namespace seascape {

// What a frame was told of hands and actions.
struct RecordedInput {
  ActionValues values{};
  // Since the frame before, in order, also those that are over by now. Their times do not count. What the values show
  // by themselves need not be among them.
  std::vector<ActionPress> presses;
  std::array<std::optional<Pose>, 2> hands;  // left, right, in the world; nothing: not tracked
};

class PathRecorder {
 public:
  static constexpr double key_every_s = 0.5;

  // How often keys are taken: each half second, or with each frame of a display. Then all times are put on the
  // display's even beat, so that a replay at its rate has the same in the same frames.
  struct Every {
    double rate_hz;  // of the display; 0: each half second
  };

  bool recording() const { return recording_; }
  // Why nothing more is recorded, for the path holds all that its file may; empty while there is room. It still has to
  // be stopped.
  const std::string& full() const { return full_; }

  // The path begins with this pose at its time 0. `time_s` counts from anywhere.
  void start(double time_s, const Pose& pose, double scene_time_s, Every every = {});
  // Once a frame, the first included; takes a key when one is due, and what of hands and actions has changed. Does
  // nothing unless recording.
  void sample(double time_s, const Pose& pose, double scene_time_s, const RecordedInput& input = {});
  // Ends with this pose as the last key and hands the path out.
  CameraPath stop(double time_s, const Pose& pose, double scene_time_s, const std::string& name);

 private:
  struct Hand {
    std::optional<Pose> pose;  // of the last frame
    double written_s = 0.0;    // when the last event was
    bool ever_written = false;
  };

  bool by_frames() const { return every_.rate_hz > 0.0; }
  Pose kept(const Pose& pose) const;
  double path_time(double time_s) const;
  bool has_room();
  void add_key(double at_s, const Pose& pose, double scene_time_s);
  void add_event(double at_s, decltype(InputEvent::what) what);
  void add_hands(double at_s, const RecordedInput& input);
  void add_actions(double at_s, const RecordedInput& input);

  bool recording_ = false;
  std::string full_;
  Every every_{};
  double began_s_ = 0.0;
  double last_s_ = 0.0;  // the last frame's time on the path
  CameraPath path_;
  std::vector<InputEvent> events_;
  ActionValues values_{};
  std::array<Hand, 2> hands_;
  std::size_t bytes_ = 0, json_values_ = 0;  // of the path's file, or a little more
};

}  // namespace seascape
