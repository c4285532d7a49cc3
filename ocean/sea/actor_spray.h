// The spray that actors throw up: bows that cut waves, blades, slaps. Kept for the spray, which is stepped at its own
// times.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>

#include "ocean/sea/step_made.h"

namespace seascape {

// Puffs of droplets from one place.
struct SprayThrow {
  glm::dvec3 at_m{0.0};
  glm::dvec3 velocity_mps{0.0};  // of what is thrown, in the mean
  double spread_mps = 0.5;       // its deviation, each way
  double per_s = 10.0;           // puffs a second
  double width_m = 0.2;          // they begin so far around the place
  double coarse = 0.5;           // 0 mist to 1 drops that one tells apart
};

inline constexpr std::size_t most_spray_throws = 128;  // in one step of the sea
inline constexpr double most_thrown_per_s = 2000.0;    // of one

// For the sea's owner.
class ActorSpray {
 public:
  // Gives false, and leaves it out, where the step has no room for more or a number is out of range (1e7 m, 100 m/s,
  // 2000 a second, 100 m around, a share of 0 to 1).
  bool add(const SprayThrow& thrown);
  void end_step(double end_s, double length_s) { throws_.end_step(end_s, length_s); }
  void clear() { throws_.clear(); }
  void forget_before(double time_s) { throws_.forget_before(time_s); }
  const StepMade<SprayThrow>& throws() const { return throws_; }

 private:
  StepMade<SprayThrow> throws_;
};

}  // namespace seascape
