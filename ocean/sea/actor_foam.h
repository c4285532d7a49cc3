// The foam that actors make: discs of each step, kept for the foam, which is stepped at its own times.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

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
  // The step ends, at end_s, that was length_s long.
  void end_step(double end_s, double length_s);
  // Steps are missing: what was before is no more.
  void clear();
  // Steps that ended before this time are not asked for any more.
  void forget_before(double time_s);

  // Appends the discs of a step of foam, with what they give on average from `from_s` to `to_s`. Those of a step of the
  // sea count from its end on for as long as it was, so that all of them are known in any frame at or after `to_s`.
  void append(double from_s, double to_s, std::vector<FoamDisc>& discs) const;

 private:
  struct Kept {
    double end_s, length_s;
    FoamDisc disc;
  };
  bool taken_;
  std::vector<Kept> kept_;  // in order of their steps
  std::size_t ended_ = 0;   // how many of them are of steps that have ended
};

}  // namespace seascape
