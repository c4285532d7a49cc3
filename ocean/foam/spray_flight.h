// How a droplet flies: drag towards the air around it, and its weight; exact for any time while its drag does not
// change.
#pragma once
#include <glm/glm.hpp>

namespace seascape {

inline constexpr double air_viscosity = 1.81e-5, air_density = 1.2,
                        sea_water_density = 1025.0;  // Pa s, kg/m3, of 15 to 20 degrees

// The time in s in which a sphere of sea water of this diameter comes to the air's velocity, at a slip of `slip_mps`
// against it: rho d^2 / (18 mu f) with f = 1 + 0.15 Re^0.687 (Schiller and Naumann 1933), and from Re = 1000 on
// Newton's constant drag coefficient of 0.44. Small drops fall by it as Gunn and Kinzer's did (Atlas et al. 1973);
// those of 2 mm and more, which flatten, too fast.
double relaxation_s(double diameter_m, double slip_mps);
// The steady speed of its fall through air at rest.
double terminal_speed(double diameter_m, double gravity_mps2);

struct Flight {
  glm::dvec3 way{0.0};       // since the beginning, m
  glm::dvec3 velocity{0.0};  // m/s
};
// After `time_s` (0 or more) of dv/dt = (air - v) / relaxation - g: exact, so that no step is too long; an infinite
// relaxation is flight without drag.
Flight fly(const glm::dvec3& velocity_mps, const glm::dvec3& air_mps, double relaxation_s, double gravity_mps2,
           double time_s);

// The wind at a height over the water, of that at 10 m (U10): logarithmic (Charnock 1955 with 0.0144, and the drag
// coefficient of Garratt 1977). No less than the height of the roughness, where it is 0.
struct WindProfile {
  double friction_mps = 0.0;  // u*
  double roughness_m = 1e-4;
  explicit WindProfile(double wind_mps, double gravity_mps2);
  double at(double height_m) const;
};

}  // namespace seascape
