// On which side of the water a point is where levels, land, currents, dynamic waves or clip count.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ocean/sea/place_query_simd.h"
#include "ocean/sea/place_sea.h"
#include "ocean/sea/sheet_search.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {

// As water_side.cpp has them.
constexpr double least_reach_m = 1e-7, farthest_m = 1e11;

// No more than by this the water goes up or down and sideways from where it rests, how much its shift changes in a
// metre, and how wide the finest texels are that it is read from.
struct Reach {
  double height_m = 0.0, shift_m = 0.0, shear = 0.0, finest_m = 1e9;
};

Reach reach_of(const WaveField& field, const PlacePlan& plan, double most_share, const PlaceSea::Beside& beside) {
  const SeaStatistics& waves = field.statistics();
  Reach reach{waves.largest_height_m, waves.largest_shift_m,
              field.state().chop * std::sqrt(waves.slope_moments.x + waves.slope_moments.y)};
  for (const auto& source : field.others()) {
    reach.height_m += source->statistics().largest_height_m;
    reach.shift_m += source->statistics().largest_shift_m;
  }
  for (const WaveField::Place& place : field.places()) reach.finest_m = std::min(reach.finest_m, place.texel_m);
  // Two patterns of a current are each at most sqrt(2) times as high in their sum (flow_height).
  const double share = most_share * (plan.flow ? std::sqrt(2.0) : 1.0);
  reach.shear *= share;
  // These bounds hold but for one wave in a million.
  reach.height_m *= 1.5 * share;
  reach.shift_m *= 1.5 * share;
  const auto add = [&](const auto* levels) {
    for (int i = 0; levels != nullptr && i < levels->levels(); ++i) {
      if (levels->still(i)) continue;
      const DynamicSurface::Extent extent = levels->extent(i);
      reach.height_m += extent.height_m;
      reach.shift_m += extent.shift_m;
      reach.shear += std::sqrt(extent.slope_moments.x + extent.slope_moments.y);
      reach.finest_m = std::min(reach.finest_m, levels->texel_m(i));
    }
  };
  add(beside.dynamic);
  add(beside.wakes);
  if (plan.pages != nullptr) reach.finest_m = std::min(reach.finest_m, plan.reading.fine_texel_m());
  return reach;
}

// Between what heights the still water and the ground stand that a square around a place reads: exact, for nothing
// between texels is above or below them. Not looked for in squares of more than 400 texels a side.
struct Stand {
  double least_m = 0.0, most_m = 0.0;
};
constexpr double most_side = 400.0;

Stand stand_of(const PlacePlan& plan, glm::dvec2 place, double reach_m) {
  Stand stand;
  if (plan.pages == nullptr) return stand;
  constexpr double anywhere_m = std::numeric_limits<double>::infinity();
  if (!(2.0 * reach_m < most_side * plan.reading.fine_texel_m())) return {-anywhere_m, anywhere_m};
  bool any = false;
  PlacePages::Own own;
  for (int coarser = 0; coarser <= (plan.reading.read.coarser > 0.0f ? 1 : 0); ++coarser) {
    const double texel_m = std::ldexp(plan.reading.fine_texel_m(), coarser);
    const glm::dvec2 from = glm::floor((place - reach_m) / texel_m - 0.5), to = (place + reach_m) / texel_m + 0.5;
    std::uint32_t slot = 0;
    for (double z = from.y; z <= to.y; ++z)
      for (double x = from.x; x <= to.x; ++x) {
        const float* const water =
            plan.pages->cell(std::int64_t(x), std::int64_t(z), texel_m, plan.place_time_s, slot, own).first;
        const int level_at = plan.numbers.at[PlaceNumbers::level], bed_at = plan.numbers.at[PlaceNumbers::bed];
        const double level = level_at < 0 ? 0.0 : double(water[level_at]),
                     bed = plan.bed ? double(water[bed_at]) : level;
        const double least = plan.dries ? std::min(level, bed) : level, most = std::max(level, bed);
        stand = any ? Stand{std::min(stand.least_m, least), std::max(stand.most_m, most)} : Stand{least, most};
        any = true;
      }
  }
  return stand;
}

}  // namespace

WaterSide PlaceSea::side(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& at_m,
                         const Beside& beside) const {
  const glm::dvec2 place(at_m.x, at_m.z);
  WaterSide side;
  if (!std::isfinite(at_m.x + at_m.y + at_m.z)) {
    side.certain = false;
    return side;
  }
  if (clipped(at_m, double(tiles.ticks()) / double(gpu::ticks_per_second),
              {.texel_m = beside.finest_m, .volumes = beside.volumes})) {
    side.height_m = at_m.y;  // air, with no surface of its own
    return side;
  }
  bool dynamic = beside.wakes != nullptr;
  for (int i = 0; beside.dynamic != nullptr && i < beside.dynamic->levels(); ++i)
    dynamic = dynamic || !beside.dynamic->still(i);
  if (!moves() && !dynamic) return water_side(field, tiles, at_m);

  const auto by_query = [&](int sheets, bool certain) {
    QueryAnswer answer;
    query(field, tiles, {&place, 1}, {&answer, 1}, {.most_iterations = 30}, beside);
    side = {at_m.y < answer.height_m, answer.height_m, sheets, certain};
    return answer.converged;
  };
  PlacePlan plan = this->plan(field, tiles, {}, beside);
  plan.waves.velocity = false;
  const Reach reach = reach_of(field, plan, most_share(), beside);
  if (std::abs(place.x) + std::abs(place.y) > farthest_m) {
    by_query(1, false);
    return side;
  }
  const Stand stand = stand_of(plan, place, reach.shift_m);
  if (at_m.y >= stand.most_m + reach.height_m || at_m.y < stand.least_m - reach.height_m) {
    side.in_water = at_m.y < stand.least_m;
    side.height_m = side.in_water ? stand.least_m : stand.most_m;
    return side;
  }
  if (!(reach.shift_m > least_reach_m)) {
    by_query(1, true);
    return side;
  }
  plan.waves.most_iterations = 0;  // of rest positions: where the search of a query begins
  const auto displace = [&](std::span<const glm::dvec2> rests, std::span<glm::dvec3> to) {
    std::array<QueryAnswer, most_sheet_corners> answers;
    answer_placed_points(plan, rests.data(), nullptr, answers.data(), to.size());
    for (std::size_t n = 0; n < to.size(); ++n) to[n] = answers[n].displacement;
  };
  const double first_spread = 0.5 + 2.0 * reach.shear;
  for (double spread = first_spread; spread < 8.0 * first_spread; spread *= 2.0) {
    const SheetSearch search(displace, place, reach.shift_m, 0.5 * reach.finest_m, spread);
    if (!search.whole()) continue;
    // Of one sheet the query knows the height exactly.
    if (search.count() > 1 || !by_query(1, true)) side = side_of(search, at_m.y);
    return side;
  }
  by_query(1, false);
  return side;
}

}  // namespace seascape
