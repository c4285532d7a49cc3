// The foam that actors make: discs of each step, kept for the foam, which is stepped at its own times.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "ocean/sea/step_made.h"

namespace seascape {

// Water around a place that foam comes to cover.
struct FoamDisc {
  glm::dvec2 at_m{0.0};  // x and z in the world
  double radius_m = 1.0;
  double per_s = 1.0;      // share of its water that foam comes to cover in a second
  double feather_m = 0.0;  // width of its soft edge, which lies inside
  bool lasting = false;    // it stays as a ship's trail does (foam_trail_life_s), not as a whitecap
};

inline constexpr std::size_t most_foam_discs = 256;  // in one step of the sea

// For the sea's owner.
class ActorFoam {
 public:
  // `taken`: whether anybody asks for the discs; else add() leaves all of them out.
  explicit ActorFoam(bool taken) : taken_(taken) {}
  // Adds to the step that runs. Gives false, and leaves it out, where the step has no room for more or a number is out
  // of the range of inputs (1e7 m, 1e6 m, 100 a second).
  bool add(const FoamDisc& disc);
  // As StepMade does.
  void end_step(double end_s, double length_s) { discs_.end_step(end_s, length_s); }
  void clear() { discs_.clear(); }
  void forget_before(double time_s) { discs_.forget_before(time_s); }

  // Appends the discs of a step of foam, with what they give on average from `from_s` to `to_s`.
  void append(double from_s, double to_s, std::vector<FoamDisc>& discs) const;

 private:
  bool taken_;
  StepMade<FoamDisc> discs_;
};

}  // namespace seascape
