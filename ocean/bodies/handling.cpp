#include "ocean/bodies/handling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace seascape {
namespace {

constexpr double no_thrust = 0.878;  // J

double between(std::span<const std::array<double, 3>> rows, std::size_t column, double at) {
  if (at <= rows.front()[0]) return rows.front()[column];
  for (std::size_t n = 1; n < rows.size(); ++n)
    if (at <= rows[n][0]) {
      const double t = (at - rows[n - 1][0]) / (rows[n][0] - rows[n - 1][0]);
      return rows[n - 1][column] + t * (rows[n][column] - rows[n - 1][column]);
    }
  return rows.back()[column];
}

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

PropellerForce propeller(const PropellerSettings& settings, double speed, double n) {
  constexpr std::array<std::array<double, 3>, 6> curves{{{0.0, .3385, .0403},
                                                         {0.2, .2824, .0348},
                                                         {0.4, .2114, .0278},
                                                         {0.6, .1286, .0193},
                                                         {0.8, .0374, .0090},
                                                         {no_thrust, 0.0, .0045}}};
  if (!(std::isfinite(speed) && std::isfinite(n))) return {};
  const double d = settings.diameter_m, water = settings.density_kg_m3 * d * d;
  if (n > 0.0 && speed >= 0.0 && speed <= no_thrust * n * d) {
    const double j = speed / (n * d);
    return {between(curves, 1, j) * water * d * d * n * n, between(curves, 2, j) * water * d * d * d * n * n};
  }
  // Thrust per rho d^4 n^2 falls to nothing at J = 0.878 as the curves' last part does. The blades' speed at 0.7 of the
  // radius gives both forces a measure that is never nothing where anything moves (four quadrant coefficients after van
  // Lammeren 1969), and the curves' values are met at either end.
  const double blade = 0.7 * std::numbers::pi * n * d, angle = std::atan2(speed, blade);
  const double measure = water * (speed * speed + blade * blade), ahead = std::atan2(no_thrust, 0.7 * std::numbers::pi);
  const double bollard = 1.0 / (0.49 * std::numbers::pi * std::numbers::pi);
  // Between the angles at which the curves end, by sines: dragged through the water, then turning astern, and ahead
  // while the boat makes sternway.
  struct Quadrant {
    double angle, thrust, torque;
  };
  const double pi = std::numbers::pi;
  const double end = 0.0045 * bollard / (1.0 + std::pow(std::tan(ahead), 2.0));
  const std::array<Quadrant, 8> rows{{{-pi, -0.7 * .3385 * bollard, -.0403 * bollard},
                                      {-pi + ahead, 0.0, -end},
                                      {-0.5 * pi, 0.35, 0.0},
                                      {0.0, .3385 * bollard, .0403 * bollard},
                                      {ahead, 0.0, end},
                                      {0.5 * pi, -0.35, -0.02},
                                      {0.75 * pi, -0.30, -0.04},
                                      {pi, -0.7 * .3385 * bollard, -.0403 * bollard}}};
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (angle <= rows[i].angle || i + 1 == rows.size()) {
      const double t = std::clamp((angle - rows[i - 1].angle) / (rows[i].angle - rows[i - 1].angle), 0.0, 1.0);
      return {measure * (rows[i - 1].thrust + t * (rows[i].thrust - rows[i - 1].thrust)),
              measure * d * (rows[i - 1].torque + t * (rows[i].torque - rows[i - 1].torque))};
    }
  return {};
}

double rudder_coefficient(double aspect, double angle) {
  const double s = std::sin(angle), off = std::atan2(std::abs(s), std::abs(std::cos(angle)));  // from the flow's line
  const double stalls = smooth_step(25.0 * std::numbers::pi / 180.0, 35.0 * std::numbers::pi / 180.0, off);
  return ((1.0 - stalls) * 6.13 * aspect / (aspect + 2.25) + stalls * 1.2) * s;
}

double rudder_force(double area, double aspect, double angle, double flow, double density) {
  return 0.5 * density * area * flow * flow * rudder_coefficient(aspect, angle);
}

glm::dvec2 sail_coefficients(bool jib, double angle) {
  constexpr std::array<std::array<double, 3>, 8> main{{{0.0, 0.0, 0.02},
                                                       {12.0, 1.25, .015},
                                                       {28.0, 1.43, .026},
                                                       {60.0, 1.38, .113},
                                                       {90.0, 1.27, .383},
                                                       {120.0, .93, .97},
                                                       {150.0, .41, 1.2},
                                                       {180.0, -.11, 1.34}}};
  constexpr std::array<std::array<double, 3>, 6> head{{{0.0, 0.0, 0.03},
                                                       {15.0, 1.10, .032},
                                                       {27.0, 1.50, .037},
                                                       {60.0, 1.25, .35},
                                                       {100.0, .40, .73},
                                                       {180.0, 0.0, 0.9}}};
  const double degrees = std::abs(angle) * 180.0 / std::numbers::pi;
  if (jib) return {between(head, 1, degrees), between(head, 2, degrees)};
  return {between(main, 1, degrees), between(main, 2, degrees)};
}

SailForce sail(const SailSettings& settings, double from, double speed, double sheet) {
  from = std::remainder(from, 2.0 * std::numbers::pi);
  const double angle = std::abs(from), lee = from >= 0.0 ? -1.0 : 1.0;  // to port where the wind is over starboard
  const double degree = std::numbers::pi / 180.0;
  // Where the sheet lets the boom go, the wind takes it no further than its own line.
  const double lets = (1.0 - std::clamp(sheet, 0.0, 1.0)) * settings.most_boom_rad, boom = std::min(lets, angle);
  const double attack = angle - boom;
  // Trimmed well it stands at 10 degrees to the wind close hauled, and at 90 before it.
  const double wants = std::max(10.0 * degree, angle - settings.most_boom_rad);
  SailForce out;
  out.boom_rad = lee * boom;
  out.luffing = 1.0 - smooth_step(2.0 * degree, 8.0 * degree, attack);
  const glm::dvec2 best = sail_coefficients(settings.jib, angle);
  const double over = std::max(attack - wants, 0.0), stalled = smooth_step(8.0 * degree, 30.0 * degree, over);
  const double lift = best.x * (1.0 - out.luffing) * (1.0 - 0.6 * stalled);
  const double drag =
      best.y * (1.0 - out.luffing) + 0.08 * out.luffing + stalled * 0.8 * std::pow(std::sin(attack), 2.0);
  const double pressure = 0.5 * settings.density_kg_m3 * settings.area_m2 * speed * speed;
  out.force_n = pressure * glm::dvec2(lift * std::sin(angle) - drag * std::cos(angle),
                                      lee * (lift * std::cos(angle) + drag * std::sin(angle)));
  return out;
}

glm::dvec3 oar_force(double area, const glm::dvec3& normal, const glm::dvec3& slip, double density) {
  const double speed = glm::length(slip), through = glm::dot(slip, normal);  // speed sin a
  return -density * area * speed * through * normal;                         // half rho A v^2 2 sin a
}

}  // namespace seascape
