#include "ocean/mesh/horizon.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/skirt.h"

namespace seascape {

double horizon_distance(double eye_height_m, double wave_height_m, bool earth_curvature) {
  const auto tangent = [](double height) {
    return std::sqrt(2.0 * static_cast<double>(gpu::earth_radius_m) * height + height * height);
  };
  // The eye may stand over a trough, which is as good as standing higher.
  const double eye = std::max(eye_height_m, 0.0) + wave_height_m;
  const double curved = 1.3 * (tangent(eye) + tangent(wave_height_m));
  constexpr double flat_distance_per_height = 6000.0;  // 1 / tan(0.01 degrees) is 5,730
  return earth_curvature ? curved : std::max(curved, flat_distance_per_height * eye);
}

}  // namespace seascape
