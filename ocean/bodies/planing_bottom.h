// The added mass of a hull's stations, and the lift that it gives a hull that goes ahead and ends at a transom: what
// carries a planing boat. Pure.
#pragma once
#include <array>
#include <vector>

#include "ocean/bodies/hull_forces.h"

namespace seascape {

// Strip theory of planing (Zarnick 1978): a hull's stations pass through the water one after the other, and each, at s
// behind the leading end and with a normal velocity w, presses it down with D(m w)/Dt, D/Dt = d/dt + U d/ds. A
// station's added mass m is that of its wetted breadth b (von Karman 1929), rho pi b^2 / 8, where the water piles up to
// pi/2 of the depth (Wagner 1932), times K = 1 - deadrise / 75 degrees, the share of Wagner's force that
// Dobrovol'skaya's exact solution has (1969). The flow leaves a hull at its chine, where it becomes steeper than 60
// degrees.
//
// Of U d(m w)/ds the sum over all stations does work: half of the wake's and half of the spray's, w U dm w / 2 each.
// That part is a drag here, symmetric and not negative; the rest does none, and drift() has it (rigid_body.h). Where a
// hull tapers off the water gives back what it took (Kirchhoff's equations); a share `sheds` of it does not come back,
// the last station's of the widest's.
class PlaningBottom {
  static constexpr int stations = 20, inner_cells = 6, cells = 8;

 public:
  PlaningBottom() = default;  // of no hull: no forces
  // `mesh` about the centre of mass, in the body's axes.
  explicit PlaningBottom(const HullMesh& mesh);

  // The stations' masses a step ago, by station and side, kg/m.
  struct Before {
    std::array<std::array<double, 2>, stations> mass_kg_m{};
    bool known = false;
  };
  // About the centre of mass.
  struct Lift {
    Matrix6 added, grown;  // now, and of that what has come since, where the bottom goes down; in the body's axes
    Matrix6 resists;       // world axes, symmetric, not negative
    Vector6 carried;       // what `resists` gives for the water's velocity
    double sheds = 0.0;
    double sideways_kg_m = 0.0;  // of what is left behind, sideways: over speed ahead and drift a lift
    Matrix6 passing;  // half of what stations pass on as they go by, skew: drift() has it, in the body's axes
  };
  Lift lift(const BodyPose& pose, const Vector6& velocity, const WaterPatch& water, const HullMedia& media, double dt_s,
            Before& before) const;
  // Added mass of a drift, in sway, yaw and roll, body's axes: rho pi T^2 / 2 a length of each station's draught T
  // below the still water at `waterline_m` (Jones 1946; Newman 1977, section 7.2).
  Matrix6 sideways(double waterline_m, double density_kg_m3) const;
  // What waves of the hull's own heave and pitch take, N s/m ..., body's axes: rho g^2 A^2 / w^3 a length, with waves
  // A = 2 sin(k B / 2) exp(-k T) high over its motion (Jensen, Mansour and Olsen 2004, equation 4), k = w^2 / g.
  // Breadth B and draught T are a station's at rest, w the frequency at which the hull heaves on `stiffness_n_m`.
  Matrix6 radiates(double waterline_m, double stiffness_n_m, double mass_kg, const HullMedia& media) const;
  bool empty() const { return stations_.empty(); }

 private:
  struct Cell {
    double inner_m, outer_m;  // heights of its ends over the keel
    double x_m, width_m;      // of its inner end from the middle, to its side
    double slope, deadrise;   // tangent of the angle, and the angle
    bool before_chine;        // of the part that water piles up on
  };
  struct Side {
    std::array<Cell, cells> bottom;
    int count = 0;
  };
  struct Station {
    glm::dvec3 keel_m{0.0};
    std::array<Side, 2> sides;  // to port, to starboard
  };
  struct Half {
    double mass_kg_m = 0.0, width_m = 0.0, slope = 0.0;  // the slope: the tangent of its deadrise
  };
  struct Outline;
  struct StationSums;
  static Side side_of(const Outline& outline, double to_side, double keel_m);
  // Of a density of 1; cosine and sine of the heel.
  static Half half_of(const Side& side, double to_side, double depth_m, double heel_rad, double cosine, double sine);
  std::vector<Station> stations_;
  double spacing_m_ = 0.0;
};

}  // namespace seascape
