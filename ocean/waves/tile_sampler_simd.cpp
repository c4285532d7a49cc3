#include "ocean/waves/tile_sampler_simd.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/waves/tile_sampler_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/waves/tile_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

// Where samples of several tiles fall between the texels of one level of each.
struct Corners {
  std::int32_t upper[WaveField::most_places], lower[WaveField::most_places], mask[WaveField::most_places];
  alignas(16) float weight[4 * WaveField::most_places];
};

// Of place `n` in level `number` of its tile.
HWY_INLINE void find_corner(const WaveTiles& tiles, const WaveField::Place& place, int number,
                            const InTile<hn::FixedTag<double, 1>>& at, int n, Corners& to) {
  const WaveTileLayout::Level& level = tiles.layout().level(place.tile, number);
  const hn::FixedTag<double, 1> d;
  const hn::FixedTag<float, 1> df;
  const hn::FixedTag<std::int32_t, 1> di;
  const auto before =
      texel_before(d, at, hn::Set(d, level.size), hn::Set(d, first_texel(number, level.size, place.offset)));
  to.mask[n] = level.size - 1;
  const auto four =
      four_texels(df, hn::Set(di, to.mask[n]), hn::Set(di, level.stride),
                  Spot<hn::FixedTag<float, 1>>{before.x, before.z, before.part_x, before.part_z}, hn::Set(df, 1.0f));
  to.upper[n] = hn::GetLane(four.upper);
  to.lower[n] = hn::GetLane(four.lower);
  const hn::Vec<hn::FixedTag<float, 1>> weights[] = {four.left_above, four.right_above, four.left_below,
                                                     four.right_below};
  for (int i = 0; i < 4; ++i) to.weight[4 * n + i] = hn::GetLane(weights[i]);
}

HWY_INLINE hn::Vec<hn::FixedTag<float, 4>> blend(const glm::vec4* texels, const Corners& corners, int n) {
  hn::Vec<Texels> four[parts];
  read_texels(&texels->x, corners.upper[n], corners.lower[n], corners.mask[n], four);
  for (int i = 0; i < parts; ++i) four[i] = hn::Mul(weights_of(corners.weight + 4 * n, i), four[i]);
  return add_texels(four);
}

// A trilinear sample's place: two levels and how far between.
struct LevelSpot {
  int number, tile, level;  // number: among the corners
  float between, share;
  double size;  // of the laying
  const Corners &fine, &coarse;
};

HWY_INLINE glm::dvec4 sample(const WaveTiles& tiles, const LevelSpot& spot, WavePlane plane) {
  const hn::FixedTag<float, 4> d;
  auto value = blend(tiles.texels(spot.tile, plane, spot.level), spot.fine, spot.number);
  if (spot.between > 0.0f) {
    const auto coarse = blend(tiles.texels(spot.tile, plane, spot.level + 1), spot.coarse, spot.number);
    value = hn::Add(value, hn::Mul(hn::Set(d, spot.between), hn::Sub(coarse, value)));
  }
  alignas(16) float result[4];
  hn::Store(value, d, result);
  return {result[0], result[1], result[2], result[3]};  // of the tile; how much of it counts is spot.share
}

// Sums x, y, z of one plane.
struct PlaneSum {
  const WaveTiles& tiles;
  WavePlane plane;
  glm::dvec3& to;
  HWY_INLINE void resolved(const LevelSpot& spot) {
    to += double(spot.share) * spot.size * glm::dvec3(sample(tiles, spot, plane));
  }
  void unresolved(std::size_t, int) {}
};

// Sums everything.
struct SeaSum {
  const WaveTiles& tiles;
  SeaSample& to;
  const PatternWarp::Local* warp;  // of the first place; null: it lies straight
  HWY_INLINE void resolved(const LevelSpot& spot) {
    const double share = spot.share;
    const glm::dvec4 shift = share * sample(tiles, spot, WavePlane::shift),
                     slope = share * sample(tiles, spot, WavePlane::slope);
    const glm::dvec4 all(*tiles.texels(spot.tile, WavePlane::moments, tiles.levels(spot.tile) - 1));
    const glm::dvec4 moments = glm::mix(all, sample(tiles, spot, WavePlane::moments), share);
    to.displacement += spot.size * glm::dvec3(shift);
    const glm::dvec3 below(std::max(moments.x - slope.x * slope.x, 0.0), std::max(moments.y - slope.y * slope.y, 0.0),
                           moments.z - slope.x * slope.y);
    if (warp != nullptr && spot.number == 0) {
      add_warped(slope, shift.w);
      to.slope_moments += warp->of_moments(below);
    } else {
      to.height_gradient += glm::dvec2(slope);
      to.shift_gradient += glm::dvec3(slope.z, slope.w, shift.w);
      to.slope_moments += below;
    }
    const double divergence = slope.z + slope.w;
    to.divergence_moment += std::max(moments.w - divergence * divergence, 0.0);
  }
  void unresolved(std::size_t number, int tile) {
    const glm::dvec4 moments(*tiles.texels(tile, WavePlane::moments, tiles.levels(tile) - 1));
    to.slope_moments += warp != nullptr && number == 0 ? warp->of_moments(glm::dvec3(moments)) : glm::dvec3(moments);
    to.divergence_moment += moments.w;
  }
  // The two halves of a warped pattern's shear differ by less than its strain times the shift's, and have their mean.
  void add_warped(const glm::dvec4& slope, double shear) {
    const glm::dvec2 of_x = warp->of({slope.z, shear}), of_z = warp->of({shear, slope.w});
    to.height_gradient += warp->of(glm::dvec2(slope));
    to.shift_gradient += glm::dvec3(of_x.x, of_z.y, 0.5 * (of_x.y + of_z.x));
  }
};
// Calls visit.resolved(spot) for each place that the footprint resolves and visit.unresolved(number, tile) for each
// other.
template <class Visit>
HWY_INLINE void visit_places(const SampledPlaces& places, Visit visit) {
  if (places.places.empty()) return;
  const WaveTiles& tiles = places.tiles;
  const WaveField::Filter& filter = places.filter;
  Corners fine, coarse;
  const auto resolved = [&](std::size_t n) {
    return filter.level[n] < tiles.levels(places.places[n].tile) - 1 && filter.share[n] > 0.0f;
  };
  // All places before the first is read: what is written number by number is read as a whole.
  for (std::size_t n = 0; n < places.places.size(); ++n) {
    if (!resolved(n)) continue;
    const hn::FixedTag<double, 1> d;
    const WaveField::Place& place = places.places[n];
    glm::dvec2 from = places.rest_m;
    if (n == 0 && places.warped) from += places.warp.shift_m;
    const auto at = in_tile(d, hn::Set(d, place.cosine), hn::Set(d, place.sine), hn::Set(d, place.inverse_side),
                            hn::Set(d, from.x), hn::Set(d, from.y));
    const int level = filter.level[n];
    find_corner(tiles, place, level, at, int(n), fine);
    if (filter.between[n] > 0.0f) find_corner(tiles, place, level + 1, at, int(n), coarse);
  }
  for (std::size_t n = 0; n < places.places.size(); ++n) {
    const WaveField::Place& place = places.places[n];
    if (!resolved(n))
      visit.unresolved(n, place.tile);
    else
      visit.resolved(
          {int(n), place.tile, filter.level[n], filter.between[n], filter.share[n], place.size, fine, coarse});
  }
}

}  // namespace

void sum_sea(const SampledPlaces& places, SeaSample& to) {
  visit_places(places, SeaSum{places.tiles, to, places.warped ? &places.warp : nullptr});
}
void sum_plane(const SampledPlaces& places, WavePlane plane, glm::dvec3& to) {
  visit_places(places, PlaneSum{places.tiles, plane, to});
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(sum_sea);
HWY_EXPORT(sum_plane);

void add_sea(const SampledPlaces& places, SeaSample& to) { HWY_DYNAMIC_DISPATCH(sum_sea)(places, to); }
void add_plane(const SampledPlaces& places, WavePlane plane, glm::dvec3& to) {
  HWY_DYNAMIC_DISPATCH(sum_plane)(places, plane, to);
}

}  // namespace seascape
#endif
