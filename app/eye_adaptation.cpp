#include "app/eye_adaptation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seascape {

double adaptation_stops(const LightInWater& light, double share) {
  if (!(light.depth_m > 0.0)) return 0.0;
  constexpr double most_stops = 10.0, full_m = 1.0;
  const glm::dvec3 luminance(0.2126, 0.7152, 0.0722);  // of linear sRGB
  const glm::dvec3 left = std::numbers::pi * light.sent_up * glm::exp(-light.fading * light.depth_m);
  const double lost = std::clamp(-std::log2(std::max(glm::dot(luminance, left), 1e-9)), 0.0, most_stops);
  const double in_full = std::min(light.depth_m / full_m, 1.0);
  return share * lost * in_full * in_full * (3.0 - 2.0 * in_full);
}

}  // namespace seascape
