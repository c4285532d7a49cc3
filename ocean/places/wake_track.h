// The way that a body has gone over the water, as far back as its windows of waves lie.
#pragma once
#include <deque>
#include <glm/glm.hpp>

namespace seascape {

// Straight pieces between places a piece apart; a body that stays within one piece of its last place leaves none.
// Whatever the body does, behind() moves no farther in a step than the body does.
class WakeTrack {
 public:
  void begin(const glm::dvec2& at_m) {
    places_.assign(1, at_m);
    now_ = at_m;
  }
  // `piece_m`, above 0: between places. Of the way `longest_m` is remembered at least.
  void go_to(const glm::dvec2& at_m, double piece_m, double longest_m);
  // The place that was passed so far back along the way (m, 0 or more); the oldest one known where that is farther.
  glm::dvec2 behind(double way_m) const;
  // How long the way is as far as it is known, m.
  double length_m() const;
  const glm::dvec2& now() const { return now_; }

 private:
  std::deque<glm::dvec2> places_;  // the oldest first
  glm::dvec2 now_{0.0};
};

}  // namespace seascape
