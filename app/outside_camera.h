// A camera that follows a head from behind and above, calmly: what an onlooker sees. Pure.
#pragma once
#include <glm/glm.hpp>

#include "engine/view.h"

namespace seascape {

struct OutsideCameraSettings {
  double distance_m = 4.0;  // behind the head
  double height_m = 1.5;    // above it
  double smooth_s = 0.6;    // after which a tenth of a step is left; 0: none at all
};

// Position and heading follow the head's, critically damped: without swinging, and as fast as that allows. They do so
// exactly for a head that stands still in between, however time is cut. The horizon stays level; the head's nods and
// rolls move nothing.
class OutsideCamera {
 public:
  static constexpr double clearance_m = 0.5;  // over the water under it

  // Follows for `dt_s` (s). The first head, and one that is further away than a person moves, is met at once.
  void step(const Pose& head, const OutsideCameraSettings& settings, double dt_s);
  // Looks at the head, from no nearer to the water than clearance_m.
  Pose pose(double water_m) const;
  // The next head is met at once.
  void forget() { known_ = false; }

 private:
  bool known_ = false;
  OutsideCameraSettings settings_;
  glm::dvec3 head_m_{0.0}, velocity_mps_{0.0};
  double yaw_deg_ = 0.0, turning_deg_per_s_ = 0.0;  // clockwise from -z; without bounds
};

}  // namespace seascape
