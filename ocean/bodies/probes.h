// A hull as four upright columns: the cheap level, with the hull's own displacement, waterplane and stability.
#pragma once
#include <array>

#include "ocean/bodies/hull_forces.h"

namespace seascape {

// How a hull floats upright in still water, in its own axes about the centre of mass.
struct FloatingUpright {
  bool floats = false;       // else it sinks: waterline and areas are those of the hull all under water
  double waterline_m = 0.0;  // height of the still water
  double displaced_m3 = 0.0, waterplane_m2 = 0.0;
  double facing_down_m2 = 0.0;  // of the wetted hull, seen from below
  glm::dvec3 buoyancy_m{0.0};   // its centre
  glm::dvec2 flotation_m{0.0};  // the waterplane's middle (x, z)
  glm::dvec2 moments_m4{0.0};   // of the waterplane about its middle: of x^2, of z^2
};
// By bisection of the clipped hull, to 1e-12 of its height. `mesh` about the centre of mass.
FloatingUpright float_upright(const HullMesh& mesh, double mass_kg, const HullMedia& media);

// Displacement, metacentres and stiffness of the columns are those of the hull upright; of large angles they are not.
struct ProbeColumns {
  std::array<glm::dvec2, 4> places_m{};
  double area_m2 = 0.0;                                  // of each
  double foot_m = 0.0, height_m = 0.0, draught_m = 0.0;  // of each column; the draught at rest
  double lift_m = 0.0;                                   // of where its force acts, over the middle of its wet part
  double reach_m = 1.0;                                  // the hull's length
};
ProbeColumns columns_of(const HullMesh& mesh, const FloatingUpright& upright);

// Pressure, form drag and submerged volume of the columns, as HullClip gives them.
HullForces probe_forces(const ProbeColumns& columns, const BodyPose& pose, const Vector6& velocity,
                        const WaterPatch& water, const HullMedia& media, const HullDrag& drag);

}  // namespace seascape
