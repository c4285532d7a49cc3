// A rigid body that takes water along: its 6 x 6 mass, and one step of its motion, stable for whatever is light, stiff
// or spins.
#pragma once
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "ocean/bodies/matrix6.h"

namespace seascape {

// In the body's axes about its centre of mass. Added mass is inertia of the water alone: it has no weight.
struct BodyMass {
  double mass_kg = 1.0;
  glm::dmat3 inertia_kg_m2{1.0};
  Matrix6 added;  // symmetric, not negative
};

struct BodyMotion {
  glm::dvec3 centre_m{0.0};                    // of mass, in the world
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // from its axes to the world's, of length 1
  Vector6 velocity;                            // world axes: of the centre of mass, m/s; spin, rad/s
};

// A matrix in the body's axes as the world's axes have it.
Matrix6 turned(const Matrix6& matrix, const glm::dmat3& to_world);
Matrix6 rigid_mass(const BodyMass& mass, const glm::dmat3& to_world);

// Carries the body on without forces, in water of this velocity: Kirchhoff's equations (1869; Lamb 1932, article 124)
// by the implicit midpoint, which keeps the energy v.M.v / 2 to rounding, for added masses that are no multiple of the
// rigid one too. `share` of the added mass goes along. Spins over 0.5 rad a step are cut to that.
//
// `shed`: of the added mass, with its share, what the body leaves behind at its end as it goes ahead along -z
// (PlaningBottom). That has inertia, but no moments of Kirchhoff's; instead there is the force -U `passing` v of a
// speed ahead U, of which the matrix is skew, so that it does no work.
struct ShedMass {
  Matrix6 added, passing;  // kg, kg m, kg m2; kg, kg m: the body's axes
  bool any = false;
};
void drift(BodyMotion& motion, const BodyMass& mass, double share, const glm::dvec3& water_mps, double dt_s,
           const ShedMass& shed = {});

// A step's forces: M dv/dt = force - resists v. The resistance is taken at the step's end, so that none is too stiff.
void kick(BodyMotion& motion, const BodyMass& mass, double share, const Vector6& force, const Matrix6& resists,
          double dt_s);

// What of the added mass has come into the water since, and takes momentum: (m + a) V stays, of the motion up and down,
// roll and pitch, while the body comes down on the water (von Karman 1929). A body that leaves keeps its velocity, and
// so does one that moves along the water: its own energy never grows.
void slam(BodyMotion& motion, const BodyMass& mass, double share_before, double share_now, const glm::dvec3& water_mps);

// The same of a part `grown` of the added mass that `mass` has already, in the body's axes.
void take_along(BodyMotion& motion, const BodyMass& mass, const Matrix6& grown, const glm::dvec3& water_mps);

// Kinetic energy of body and added mass, J.
double kinetic_energy(const BodyMotion& motion, const BodyMass& mass, double share);

}  // namespace seascape
