// Keeps a boat to a course of places, round and round, by her helm or, without an engine, by her oars. Pure.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ocean/bodies/boat.h"

namespace seascape {

class Helmsman {
 public:
  // `course_m`: two places or more (x, z), the first of which is sailed for from wherever she is. `length_m`: hers.
  // `controls`: what he keeps asking for besides: throttle, or how hard he rows.
  Helmsman(std::vector<glm::dvec2> course_m, double length_m, const BoatControls& controls);

  // What he asks for in a step. He steers for a place on the leg two and a half lengths ahead of her (line of sight:
  // Fossen 2011, "Handbook of Marine Craft Hydrodynamics and Motion Control", section 10.3.2), and turns to the next
  // leg 1.2 lengths before a place, or once she is past it.
  BoatControls step(const BoatSpec& boat, const BodyState& state);
  void begin_anew() { *this = Helmsman(course_m_, length_m_, controls_); }
  std::uint64_t mixed_into(std::uint64_t hash) const;

 private:
  std::vector<glm::dvec2> course_m_;
  double length_m_;
  BoatControls controls_;
  std::size_t next_ = 0;
  bool begun_ = false;  // there is a leg that leads to the next place, and not only that
};

}  // namespace seascape
