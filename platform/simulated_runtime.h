// A headset that is not there: a runtime of OpenXR in the program itself, in which a script plays the person. All that
// shows pictures in a real headset works on it unchanged, in simulated time: as fast as it draws.
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/image_file.h"
#include "platform/input_script.h"
#include "platform/xr_api.h"

namespace seascape {

struct SimulatedOptions {
  InputScript script;
  bool ends = true;           // with the script: the person leaves then
  std::filesystem::path out;  // folder for the pictures that both eyes see; empty: none
  int every = 0;              // of so many frames one; 0: none
  // "/interaction_profiles/...": the controllers' inputs are what set_input() says, and do what was suggested for them.
  // Empty: the script gives actions by their names.
  std::string profile;
  // The ellipse of a picture's field that an eye sees through its lens, against the largest within it: a visibility
  // mask hides what lies outside. 0: everything is seen.
  double lens = 0.0;
  // Hands (left, right) that hold no controller, but are seen joint by joint: they close as the script's grab_left and
  // grab_right say, pinch as select_left and select_right say, and do nothing else. Where one is, both are seen.
  std::array<bool, 2> bare_hands{};
};

struct SimulatedBuzz {
  double time_s;
  int hand;  // 0 left, 1 right
  double strength, seconds;
};

class SimulatedRuntime {
 public:
  explicit SimulatedRuntime(const SimulatedOptions& options);
  ~SimulatedRuntime();
  SimulatedRuntime(const SimulatedRuntime&) = delete;
  SimulatedRuntime& operator=(const SimulatedRuntime&) = delete;

  // What HeadsetSystem is made with.
  PFN_xrGetInstanceProcAddr get() const;
  const void* next() const;

  // How far an input of the profile's controllers is pressed or pushed from now on: "left/input/trigger/value".
  void set_input(const std::string& path, double value);

  // Other lenses from now on, which an event tells of (SimulatedOptions::lens).
  void set_lens(double lens);

  std::size_t frames_ended() const;  // since the start, those without a picture too
  std::size_t frames_shown() const;
  const std::vector<SimulatedBuzz>& buzzes() const;

  struct State;  // simulated_state.h

 private:
  std::unique_ptr<State> state_;
};

}  // namespace seascape
