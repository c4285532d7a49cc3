#include "ocean/bodies/blade_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seascape {

double wetted_blade(double depth_m, double breadth_m) {
  return breadth_m > 0.0 ? std::clamp(depth_m / breadth_m + 0.5, 0.0, 1.0) : depth_m > 0.0 ? 1.0 : 0.0;
}

void add_blade_sources(const Blade& blade, double surface_m, double least_length_m, std::vector<WaveSource>& sources) {
  const double depth = surface_m - blade.at_m.y, through = glm::dot(blade.slip_mps, blade.normal),
               flow = std::abs(through) * blade.area_m2 * wetted_blade(depth, blade.breadth_m);
  if (!(flow > 0.0)) return;
  const glm::dvec3 pushed = (through > 0.0 ? 0.5 : -0.5) * blade.breadth_m * blade.normal;
  const glm::dvec2 at(blade.at_m.x, blade.at_m.z), before(pushed.x, pushed.z),
      velocity(blade.velocity_mps.x, blade.velocity_mps.z);
  const double length = std::max(least_length_m, blade.breadth_m), rise = flow * std::numbers::pi / (length * length);
  for (const double side : {1.0, -1.0})
    sources.push_back({at + side * before, velocity, length, 0.0, side * rise, std::max(depth - side * pushed.y, 0.0)});
}

}  // namespace seascape
