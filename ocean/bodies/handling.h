// What drives and steers a boat: propeller, rudder, sails and oars as functions of the flow at them. Pure.
#pragma once
#include <glm/glm.hpp>

namespace seascape {

struct PropellerSettings {
  double diameter_m = 0.45;
  double density_kg_m3 = 1025.0;
};
struct PropellerForce {
  double thrust_n = 0.0, torque_nm = 0.0;
};
// Of a Wageningen B4-55 with P/D 0.8 in all four quadrants: `speed_mps` is that of the water through it, forwards
// positive, `turns_per_s` likewise. Ahead, up to where thrust vanishes at J = 0.878, the series' open water curves;
// elsewhere, where the values are estimates, by the angle of attack of its blades at 0.7 of the radius, which meets
// them there. Finite and continuous for any numbers, at rest too, where nothing turns. Torque opposes the turning or,
// dragged through the water, drives it.
PropellerForce propeller(const PropellerSettings& settings, double speed_mps, double turns_per_s);

// The lift coefficient of a rudder's normal force, 6.13 A / (A + 2.25) sin a (Fujii), of an aspect ratio A, up to a
// stall from 25 to 35 degrees, beyond which it is a plate's 1.2 sin a. For any angle, from astern too.
double rudder_coefficient(double aspect_ratio, double angle_rad);
// N, across the rudder, towards the side that it is turned to.
double rudder_force(double area_m2, double aspect_ratio, double angle_rad, double flow_mps, double density_kg_m3);

// The wind that a boat feels: `true_mps` to where it blows, less her own velocity (x, z), m/s.
inline glm::dvec2 apparent_wind(const glm::dvec2& true_mps, const glm::dvec2& boat_mps) { return true_mps - boat_mps; }

struct SailSettings {
  double area_m2 = 20.0;
  bool jib = false;            // else a main
  double most_boom_rad = 1.5;  // out, sheet eased
  double density_kg_m3 = 1.2;
};
struct SailForce {
  glm::dvec2 force_n{0.0};  // ahead, to starboard
  double boom_rad = 0.0;    // from the centre line, to starboard positive
  double luffing = 0.0;     // 0 drawing to 1 flogging
};
// Lift and drag coefficients of a sail at an angle of the apparent wind (ORC's, as in Python-VPP; those of a
// main at 150 degrees and of a jib at 180 are estimates), trimmed well.
glm::dvec2 sail_coefficients(bool jib, double angle_rad);
// `from_rad`: where the apparent wind comes from, 0 from ahead, positive over the starboard side. `sheet`: 0 eased to 1
// hard in. A sail that is sheeted to less than the wind takes lies along it and flogs; one that is sheeted to more than
// it wants stalls. How soon it does either is an estimate.
SailForce sail(const SailSettings& settings, double from_rad, double speed_mps, double sheet);

// N, on a plate that is drawn through the water, against its way: Cn = 2 sin a of the angle between blade and flow.
glm::dvec3 oar_force(double area_m2, const glm::dvec3& blade_normal, const glm::dvec3& slip_mps, double density_kg_m3);

}  // namespace seascape
