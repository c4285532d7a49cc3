// What happens to bodies, told once each: coming out of the water and into it, slams, groundings, hits, capsizes and
// swampings; and of their lines (moorings.h) that one parts or that an anchor drags.
#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "ocean/bodies/bodies.h"

namespace seascape {

enum class BodyEventKind { in, out, slam, ground, hit, capsize, swamped, parted, drags };
std::string_view name_of(BodyEventKind kind);

struct BodyEvent {
  double time_s = 0.0;
  std::size_t body = 0;
  BodyEventKind kind = BodyEventKind::in;
  // m/s that it came in with; of slam, ground and hit the m/s it lost; that its anchor drags with; of the others 0.
  double strength = 0.0;
};

// A state begins where the first limit is met and is over where the second is: between the two nothing is told.
struct BodyEventSettings {
  double in_share = 0.02, out_share = 0.002;   // of what it displaces at rest, of its mass where it sinks
  double slam_mps = 0.5, slam_over_mps = 0.1;  // lost in a step by coming onto the water
  double hit_mps = 0.15, hit_over_mps = 0.02;  // by an impulse in a step
  double ground_mps = 0.05, ground_over_mps = 0.0;
  double capsize_up = 0.0, righted_up = 0.5;       // the height of her mast's unit vector
  double swamped_share = 0.8, bailed_share = 0.5;  // of the inside
  double quiet_s = 0.25;  // so long it must have been over, before a slam, a hit or a grounding is another
};

class BodyEvents {
 public:
  explicit BodyEvents(const BodyEventSettings& settings = {}) : settings_(settings) {}
  // Follows bodies to the end of a step, and appends what has happened in it, in their order. The first call tells
  // nothing: it only sees how they are. So does one whose time lies before the last.
  void follow(double time_s, const Bodies& bodies, std::vector<BodyEvent>& events);

 private:
  struct Pulse {  // of what comes and goes in single steps
    bool on = false;
    double last_s = 0.0;
  };
  struct Followed {
    double displaces_m3 = 1.0;
    bool wet = false, capsized = false, swamped = false;
    Pulse slam, hit, ground;
    double falls_mps = 0.0;
  };
  bool begins(Pulse& pulse, double time_s, double value, double limit, double over) const;
  Followed begin(const Bodies& bodies, std::size_t body) const;
  BodyEventSettings settings_;
  std::vector<Followed> followed_;
  double time_s_ = 0.0;
};

}  // namespace seascape
