#include "ocean/foam/spray_flight.h"

#include <algorithm>
#include <cmath>

namespace seascape {

double relaxation_s(double diameter, double slip) {
  const double reynolds = air_density * slip * diameter / air_viscosity;
  const double factor = reynolds < 1000.0 ? 1.0 + 0.15 * std::pow(reynolds, 0.687) : 0.44 / 24.0 * reynolds;
  return sea_water_density * diameter * diameter / (18.0 * air_viscosity * factor);
}

double terminal_speed(double diameter, double gravity) {
  double low = 0.0, high = 100.0;  // v = g relaxation(v), of which the right side falls as v grows
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (gravity * relaxation_s(diameter, middle) > middle ? low : high) = middle;
  }
  return low;
}

Flight fly(const glm::dvec3& v, const glm::dvec3& air, double relaxation, double gravity, double t) {
  const double q = t / relaxation, kept = std::exp(-q);
  // Of few relaxation times their differences, which cancel, by their series.
  const bool few = q < 1e-3;
  const double carried = few ? t * (1.0 - q / 2.0 + q * q / 6.0) : relaxation * -std::expm1(-q);
  const double dropped = few ? t * t * (0.5 - q / 6.0 + q * q / 24.0) : relaxation * (t - carried);
  return {v * carried + air * (t - carried) - glm::dvec3(0.0, gravity * dropped, 0.0),
          kept * v + (1.0 - kept) * air - glm::dvec3(0.0, gravity * carried, 0.0)};
}

WindProfile::WindProfile(double wind, double gravity) {
  if (!(wind > 0.0)) return;
  friction_mps = wind * std::sqrt((0.75 + 0.067 * wind) * 1e-3);
  roughness_m = std::max(0.0144 * friction_mps * friction_mps / gravity, 1e-4);
}

double WindProfile::at(double height) const {
  constexpr double karman = 0.4;
  return friction_mps / karman * std::log(std::max(height / roughness_m, 1.0));
}

}  // namespace seascape
