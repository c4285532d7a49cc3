#include <algorithm>
#include <cmath>

#include "ocean/places/wake_surface.h"
#include "ocean/sea/sea_view.h"

namespace seascape {

namespace {
constexpr double steepest = 2.0;  // slope that steps reckon with

// Height of a ray's point above the surface there.
class RayWalk {
 public:
  RayWalk(const SeaView& view, const glm::dvec3& origin, const glm::dvec3& along, double footprint_m)
      : view_(view), origin_(origin), along_(along), footprint_m_(footprint_m) {}
  double above_m(double distance_m) {
    const glm::dvec3 at = origin_ + distance_m * along_;
    const QueryAnswer before = water_;
    water_ = view_.query(
        {at.x, at.z}, {.footprint_m = footprint_m_, .previous = {&before, asked_ ? std::size_t{1} : std::size_t{0}}});
    asked_ = true;
    return at.y - water_.height_m;
  }
  const QueryAnswer& water() const { return water_; }

 private:
  const SeaView& view_;
  glm::dvec3 origin_, along_;
  double footprint_m_;
  QueryAnswer water_;
  bool asked_ = false;
};
}  // namespace

SeaBounds SeaView::bounds() const {
  const SeaStatistics& waves = field().statistics();
  SeaBounds result{waves.largest_height_m, waves.largest_shift_m};
  for (const auto& source : field().others()) {
    result.height_m += source->statistics().largest_height_m;
    result.shift_m += source->statistics().largest_shift_m;
  }
  const double share = places().most_share();
  result.height_m *= share;
  result.shift_m *= share;
  for (int i = 0; dynamic() != nullptr && i < dynamic()->levels(); ++i) {
    const DynamicSurface::Extent extent = dynamic()->extent(i);
    result.height_m += extent.height_m;
    result.shift_m += extent.shift_m;
  }
  for (int i = 0; wakes() != nullptr && i < wakes()->levels(); ++i) {
    result.height_m += wakes()->extent(i).height_m;
    result.shift_m += wakes()->extent(i).shift_m;
  }
  return result;
}

RayAnswer SeaView::ray(const glm::dvec3& origin, const glm::dvec3& direction, const RayOptions& options) const {
  RayAnswer result;
  const double length = glm::length(direction), most = std::max(options.most_m, 0.0);
  if (!(length > 0.0) || !std::isfinite(length) || !std::isfinite(origin.x + origin.y + origin.z)) return result;
  const glm::dvec3 along = direction / length;
  const double across = std::hypot(along.x, along.z), falls = std::abs(along.y) + steepest * across;
  double at = 0.0;
  if (!places().rises()) {
    // Between the lowest trough and the highest crest there is something to meet.
    const double highest = 1.5 * bounds().height_m + 0.1;
    const double outside = std::abs(origin.y) - highest;
    if (outside > 0.0) {
      const bool nears = along.y != 0.0 && (along.y < 0.0) == (origin.y > 0.0);
      at = nears ? outside / std::abs(along.y) : most;
    }
  }
  RayWalk walk(*this, origin, along, options.footprint_m);
  at = std::min(at, most);
  double above = walk.above_m(at);
  while (at < most) {
    const double step = std::max({std::abs(above) / falls, 0.05, at / 5000.0});
    const double next = std::min(at + step, most), then = walk.above_m(next);
    if ((then > 0.0) != (above > 0.0)) {
      double low = at, high = next;
      while (high - low > std::max(1e-4, 1e-7 * high)) {
        const double middle = 0.5 * (low + high);
        ((walk.above_m(middle) > 0.0) == (above > 0.0) ? low : high) = middle;
      }
      result.distance_m = 0.5 * (low + high);
      walk.above_m(result.distance_m);
      result.water = walk.water();
      result.hit = !result.water.clipped;
      if (result.hit) return result;
    }
    at = next;
    above = then;
  }
  result.distance_m = most;
  result.water = walk.water();
  return result;
}

}  // namespace seascape
