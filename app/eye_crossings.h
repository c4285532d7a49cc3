// When eyes go into the water and come out of it: events for sound, for records, and for who is told. Pure.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace seascape {

struct EyeEvent {
  double time_s = 0.0;  // when it was past_m beyond the surface
  std::size_t eye = 0;  // of the views drawn
  bool in = false;      // into the water, or out of it
};

// An eye is in the water, or out of it, once it has been past_m beyond the surface for hold_s: an eye that bobs at the
// surface makes no chatter. The times do not depend on the rate of the frames: between two of them the depth changes
// evenly.
class EyeCrossings {
 public:
  static constexpr double past_m = 0.02, hold_s = 0.1;
  static constexpr std::size_t most_eyes = 2;

  // Where the eyes are at `time_s` (s, rising; where it does not rise nothing happens): metres below the water;
  // nothing: far above it. The first call says where they begin. Allocates nothing but for events.
  void step(double time_s, std::span<const std::optional<double>> depths_m);
  bool in_water(std::size_t eye) const { return eyes_[eye].in; }
  // What has happened since the last call, by rising time.
  std::vector<EyeEvent> take_events();

 private:
  struct Eye {
    bool known = false, in = false;
    double depth_m = 0.0;            // in the call before
    std::optional<double> beyond_s;  // since when it is past the surface on the other side
  };
  std::array<Eye, most_eyes> eyes_;
  std::optional<double> before_s_;
  std::vector<EyeEvent> events_;
};

}  // namespace seascape
