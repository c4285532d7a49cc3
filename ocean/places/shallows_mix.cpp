#include "ocean/places/shallows_mix.h"

#include <cmath>

namespace seascape {

PlaceWaves ShallowsMix::waves(glm::dvec2 place_m, double depth_m) const {
  PlaceWaves a = from->waves(place_m, depth_m);
  if (to == nullptr) return a;
  const PlaceWaves b = to->waves(place_m, depth_m);
  const float w = float(share);
  for (std::size_t i = 0; i < a.share.size(); ++i) a.share[i] = std::lerp(a.share[i], b.share[i], w);
  for (std::size_t i = 0; i < a.shift_m.size(); ++i) a.shift_m[i] = std::lerp(a.shift_m[i], b.shift_m[i], w);
  a.ripples = std::lerp(a.ripples, b.ripples, w);
  a.others = std::lerp(a.others, b.others, w);
  a.swash = std::lerp(a.swash, b.swash, w);
  return a;
}

double ShallowsMix::surf(glm::dvec2 place_m, double depth_m) const {
  const double a = from->surf(place_m, depth_m);
  return to == nullptr ? a : std::lerp(a, to->surf(place_m, depth_m), share);
}

Shallows::Placed ShallowsMix::placed(glm::dvec2 place_m, double depth_m) const {
  const Shallows::Placed a = from->placed(place_m, depth_m);
  if (to == nullptr) return a;
  const Shallows::Placed b = to->placed(place_m, depth_m);
  return {std::lerp(a.share, b.share, share), std::lerp(a.surf, b.surf, share)};
}

glm::dvec2 ShallowsMix::direction(int cascade) const {
  const glm::dvec2 a = from->direction(cascade);
  if (to == nullptr) return a;
  const glm::dvec2 b = to->direction(cascade);
  if (a == glm::dvec2(0.0) || b == glm::dvec2(0.0)) return a + b;  // what has none is not shifted
  const double angle = share * std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b)), c = std::cos(angle),
               s = std::sin(angle);
  return {c * a.x - s * a.y, s * a.x + c * a.y};
}

}  // namespace seascape
