#include "ocean/sea/water_side.h"

#include <algorithm>
#include <cmath>

#include "ocean/sea/query.h"
#include "ocean/sea/sheet_search.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {

// Less than a float's last place of a metre; and where doubles still lie closer than a tenth of a millimetre.
constexpr double least_reach_m = 1e-7, farthest_m = 1e11;

WaterSide by_query(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& at_m) {
  const glm::dvec2 place(at_m.x, at_m.z);
  QueryAnswer answer;
  query(field, tiles, {&place, 1}, {&answer, 1}, {.most_iterations = 30});
  return {at_m.y < answer.height_m, answer.height_m, 1, false};
}

}  // namespace

WaterSide water_side(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& at_m) {
  WaterSide side;
  if (!std::isfinite(at_m.x + at_m.y + at_m.z)) {
    side.certain = false;
    return side;
  }
  const SeaStatistics& sea = field.statistics();
  double height_m = sea.largest_height_m, reach_m = sea.largest_shift_m, finest_m = 1e9;
  for (const auto& source : field.others()) {
    height_m += source->statistics().largest_height_m;
    reach_m += source->statistics().largest_shift_m;
  }
  for (const WaveField::Place& place : field.places()) finest_m = std::min(finest_m, place.texel_m);
  // Both bounds hold but for one wave in a million.
  height_m *= 1.5;
  reach_m *= 1.5;
  const glm::dvec2 place(at_m.x, at_m.z);
  if (std::abs(at_m.y) >= height_m) {
    side.in_water = at_m.y < 0.0;
    return side;
  }
  // Water that moves straight up and down, or by less than a lattice could tell, stands over its place at rest.
  if (!(reach_m > least_reach_m)) {
    side.height_m = field.displacement(tiles, place, 0.0).y;
    side.in_water = at_m.y < side.height_m;
    return side;
  }
  if (std::abs(place.x) + std::abs(place.y) > farthest_m) return by_query(field, tiles, at_m);
  // Between corners the water is straight but for waves shorter than the square; the slope of their shift is chop times
  // that of their height.
  const double shear = field.state().chop * std::sqrt(sea.slope_moments.x + sea.slope_moments.y);
  const auto displace = [&, filter = field.filter(0.0)](std::span<const glm::dvec2> rests, std::span<glm::dvec3> to) {
    for (std::size_t n = 0; n < to.size(); ++n) to[n] = field.displacement(tiles, rests[n], filter);
  };
  for (double spread = 0.5 + 2.0 * shear; spread < 8.0 * (0.5 + 2.0 * shear); spread *= 2.0) {
    const SheetSearch search(displace, place, reach_m, 0.5 * finest_m, spread);
    if (search.whole()) return side_of(search, at_m.y);
  }
  return by_query(field, tiles, at_m);
}

}  // namespace seascape
