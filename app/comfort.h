// What keeps a moving viewer well: how far a vignette closes with the speed, how much of a carrier's motion the camera
// takes, and turns by steps. Pure: motion and time in, numbers and a pose out.
#pragma once
#include <optional>

#include "app/comfort_settings.h"
#include "engine/view.h"

namespace seascape {

// The height of a thing without its quick motions: a critically damped low-pass of second order, which never
// overshoots a step. Of a wave as long as the period it leaves half, of one of half the period a fifth; what is slower
// comes later by period / pi.
class SlowHeight {
 public:
  // Goes on by `dt_s`, in which the height runs evenly from its last value to `height_m`; solved exactly. The first
  // height is taken as it is. A period of 0 lets everything through.
  double step(double height_m, double period_s, double dt_s);

 private:
  double height_m_ = 0.0;  // given last
  double slow_m_ = 0.0, slow_mps_ = 0.0;
  bool known_ = false;
};

// How the viewer is moved during a step, his own head's movement left out.
struct ComfortMotion {
  glm::dvec3 velocity_mps{0.0};  // through the world
  double turn_deg_per_s = 0.0;   // turns by a stick that are not steps, and a carrier's
  std::optional<Pose> carrier;   // of the deck, at the step's end; none: nothing carries him
};

// What is drawn over the picture.
struct ComfortShown {
  double clear_deg = 360.0;  // full angle about the head's forward direction that stays clear; 360: no vignette
  double soft_deg = 0.0;     // from there until it is dark
  bool horizon_line = false;
};

// How far it is closed and the like follow differential equations that are solved exactly while speeds are constant and
// heights run evenly, so that nothing depends on how time is cut into frames. What is not a number counts as no motion.
class Comfort {
 public:
  void step(const ComfortSettings& settings, const ComfortMotion& motion, double dt_s);
  // After a jump of place or time, or onto another carrier: the vignette opens, filters begin anew.
  void begin_anew() { *this = {}; }

  const ComfortShown& shown() const { return shown_; }
  // The deck as the camera takes it; none where nothing carries. The heading is always the carrier's.
  const std::optional<Pose>& carrier() const { return carrier_; }

  // The height (m) of the water that a camera rides, without small waves.
  double ridden_m(const ComfortSettings& settings, double water_m, double dt_s);

  // How far (deg, to the right) a stick at -1 to 1 turns the viewer during `dt_s`: a whole step when it is pushed, none
  // again before it was let go or goes to the other side; or evenly, where turns are smooth or comfort is off.
  double turned_deg(const ComfortSettings& settings, double stick, double dt_s);

 private:
  double closed_ = 0.0;  // 0 open to 1
  SlowHeight deck_, water_;
  double pushed_ = 0.0;  // where to the stick was, if not let go since: -1 or 1
  ComfortShown shown_;
  std::optional<Pose> carrier_;
};

}  // namespace seascape
