// What a hull that goes ahead meets beside pressure and friction: the drag of the waves that it makes, and what keeps
// it to its course. Pure.
#pragma once
#include <memory>
#include <vector>

#include "ocean/bodies/hull_forces.h"

namespace seascape {

// Of a hull about its centre of mass, as it floats upright; made when it is loaded (some tens of milliseconds), used in
// every step.
class HullCourse {
 public:
  // `waterline_m`: the height of the still water in the hull's axes (FloatingUpright).
  HullCourse(const HullMesh& mesh, double waterline_m, const HullMedia& media);

  // N, of the waves behind it at a speed ahead or astern (m/s, through the water): Michell's integral for a thin ship
  // (1898) over all of its triangles. Broad hulls make lower waves than it says. A transom runs dry and makes none.
  double wave_drag_n(double speed_mps) const;

  // The forces of a step at a motion through the water (world axes, about the centre of mass): the waves' drag, and the
  // lift of the hull and its keel as a wing of very small aspect ratio (Jones 1946, with the breadth's part of Clarke,
  // Gedling and Hine 1983), shared out along the hull by its lateral area. `wet`: the share of the water that it
  // displaces at rest. `bottom_kg_m`: what of the lift its bottom has already (PlaningBottom).
  Vector6 forces(const BodyPose& pose, const Vector6& through_water, double wet, double bottom_kg_m = 0.0) const;

  double length_m() const { return length_m_; }

 private:
  std::vector<double> drag_n_;  // at equal steps of the speed
  double step_mps_ = 1.0, length_m_ = 0.0;
  double lift_ = 0.0;                           // N over the product of the speeds ahead and to the side, (m/s)^2
  double lever_m_ = 0.0, lever_squared_ = 0.0;  // the mean of the lateral area's places ahead of the centre, and of
                                                // their squares
};

}  // namespace seascape
