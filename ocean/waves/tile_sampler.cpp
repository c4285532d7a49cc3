// Sampling the sea's tiles at a rest position: the C++ twin of sea() in the shaders.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/surface_slope.h"

namespace seascape {

namespace {
namespace hn = hwy::HWY_NAMESPACE;
// A texel is one vector of four floats, which every instruction set has: no run-time dispatch is needed.
using Texel = hn::FixedTag<float, 4>;
using TexelVector = hn::Vec<Texel>;

// Where a sample falls between the texels of one level.
struct Corner {
  std::ptrdiff_t at[4];
  float weight[4];
};

Corner corner(const WaveTileLayout::Level& level, glm::dvec2 coordinates) {
  const int size = level.size;
  const std::ptrdiff_t stride = level.stride;
  // Coordinates are in [0, 2), so that a whole number added makes truncation the floor; & wraps.
  const double x = coordinates.x * size + (size - 0.5), z = coordinates.y * size + (size - 0.5);
  const int whole_x = int(x), whole_z = int(z);
  const float fx = float(x - whole_x), fz = float(z - whole_z);
  const int x0 = whole_x & (size - 1), z0 = whole_z & (size - 1);
  const int x1 = (x0 + 1) & (size - 1), z1 = (z0 + 1) & (size - 1);
  return {{z0 * stride + x0, z0 * stride + x1, z1 * stride + x0, z1 * stride + x1},
          {(1.0f - fx) * (1.0f - fz), fx * (1.0f - fz), (1.0f - fx) * fz, fx * fz}};
}

TexelVector blend(const glm::vec4* texels, const Corner& c) {
  const Texel d;
  const auto part = [&](int i) { return hn::Mul(hn::Set(d, c.weight[i]), hn::LoadU(d, &texels[c.at[i]].x)); };
  return hn::Add(hn::Add(part(0), part(1)), hn::Add(part(2), part(3)));
}

// A trilinear sample's place: two levels and how far between.
struct Spot {
  int tile, level;
  float between, share;
  double size;  // of the laying
  Corner fine, coarse;
};

glm::dvec4 sample(const WaveTiles& tiles, const Spot& spot, WavePlane plane) {
  const Texel d;
  TexelVector value = blend(tiles.texels(spot.tile, plane, spot.level), spot.fine);
  if (spot.between > 0.0f) {
    const TexelVector coarse = blend(tiles.texels(spot.tile, plane, spot.level + 1), spot.coarse);
    value = hn::Add(value, hn::Mul(hn::Set(d, spot.between), hn::Sub(coarse, value)));
  }
  glm::vec4 result;
  hn::StoreU(value, d, &result.x);
  return glm::dvec4(result);  // of the tile; how much of it counts is spot.share
}

// Sums x, y, z of one plane.
struct PlaneSum {
  const WaveTiles& tiles;
  WavePlane plane;
  glm::dvec3& to;
  void resolved(const Spot& spot) { to += double(spot.share) * spot.size * glm::dvec3(sample(tiles, spot, plane)); }
  void unresolved(int) {}
};

// Sums everything.
struct SeaSum {
  const WaveTiles& tiles;
  SeaSample& to;
  void resolved(const Spot& spot) {
    const double share = spot.share;
    const glm::dvec4 shift = share * sample(tiles, spot, WavePlane::shift),
                     slope = share * sample(tiles, spot, WavePlane::slope);
    const glm::dvec4 all(*tiles.texels(spot.tile, WavePlane::moments, tiles.levels(spot.tile) - 1));
    const glm::dvec4 moments = glm::mix(all, sample(tiles, spot, WavePlane::moments), share);
    to.displacement += spot.size * glm::dvec3(shift);
    to.height_gradient += glm::dvec2(slope);
    to.shift_gradient += glm::dvec3(slope.z, slope.w, shift.w);
    const double divergence = slope.z + slope.w;
    to.slope_moments += glm::dvec3(std::max(moments.x - slope.x * slope.x, 0.0),
                                   std::max(moments.y - slope.y * slope.y, 0.0), moments.z - slope.x * slope.y);
    to.divergence_moment += std::max(moments.w - divergence * divergence, 0.0);
  }
  void unresolved(int tile) {
    const glm::dvec4 moments(*tiles.texels(tile, WavePlane::moments, tiles.levels(tile) - 1));
    to.slope_moments += glm::dvec3(moments);
    to.divergence_moment += moments.w;
  }
};
}  // namespace

WaveField::Filter WaveField::filter(double footprint_m) const {
  if (!(footprint_m > 0.0)) footprint_m = 0.0;  // what is no number, or below 0
  Filter result{};
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const double texel = place.texel_m;
    const int last = std::countr_zero(unsigned(place.tile < quality_.cascades
                                                   ? plans_[std::size_t(place.tile)].n
                                                   : others_[std::size_t(place.tile - quality_.cascades)]->samples()));
    const double lod = footprint_m > texel ? std::min(std::log2(footprint_m / texel), double(last)) : 0.0;
    result.level[i] = int(lod);
    result.between[i] = float(lod - int(lod));
    result.share[i] = float(kept_share(place.longest_m, footprint_m));
  }
  return result;
}

// Calls visit.resolved(spot) for each place that the footprint resolves and visit.unresolved(tile) for each other.
template <class Visit>
void WaveField::visit_places(const WaveTiles& tiles, glm::dvec2 rest, const Filter& filter, bool curved,
                             Visit visit) const {
  assert(tiles.cascades() == quality_.cascades && tiles.layout().resolution == quality_.resolution);
  for (std::size_t i = curved ? laid_ : 0; i < (curved ? places_.size() : laid_); ++i) {
    const Place& place = places_[i];
    if (filter.level[i] >= tiles.levels(place.tile) - 1 || filter.share[i] <= 0.0f) {
      visit.unresolved(place.tile);
      continue;
    }
    const double first = 0.5 / tiles.samples(place.tile) + place.offset;
    // In double, so that a sample a thousand kilometres out is as exact as one at the origin.
    const double u = (place.cosine * rest.x + place.sine * rest.y) * place.inverse_side;
    const double v = (-place.sine * rest.x + place.cosine * rest.y) * place.inverse_side;
    const glm::dvec2 coordinates{u - std::floor(u) + first, v - std::floor(v) + first};
    Spot spot;
    spot.tile = place.tile;
    spot.size = place.size;
    spot.level = filter.level[i];
    spot.between = filter.between[i];
    spot.share = filter.share[i];
    spot.fine = corner(tiles.layout().level(place.tile, spot.level), coordinates);
    if (spot.between > 0.0f) spot.coarse = corner(tiles.layout().level(place.tile, spot.level + 1), coordinates);
    visit.resolved(spot);
  }
}

SeaSample WaveField::sea(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const {
  SeaSample result;
  visit_places(tiles, rest_xz_m, filter, false, SeaSum{tiles, result});
  result.slope_moments += statistics_.tail_slope_moments;
  return result;
}

glm::dvec3 WaveField::displacement(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const {
  glm::dvec3 result(0.0);
  visit_places(tiles, rest_xz_m, filter, false, PlaneSum{tiles, WavePlane::shift, result});
  return result;
}

glm::dvec3 WaveField::velocity(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const {
  assert(tiles.has_velocity());
  glm::dvec3 result(0.0);
  visit_places(tiles, rest_xz_m, filter, false, PlaneSum{tiles, WavePlane::velocity, result});
  return result;
}

SeaSample WaveField::sea_curved(const WaveTiles& tiles, glm::dvec2 bent_m, const Filter& filter) const {
  SeaSample result;
  visit_places(tiles, bent_m, filter, true, SeaSum{tiles, result});
  return result;
}
glm::dvec3 WaveField::displacement_curved(const WaveTiles& tiles, glm::dvec2 bent_m, const Filter& filter) const {
  glm::dvec3 result(0.0);
  visit_places(tiles, bent_m, filter, true, PlaneSum{tiles, WavePlane::shift, result});
  return result;
}
glm::dvec3 WaveField::velocity_curved(const WaveTiles& tiles, glm::dvec2 bent_m, const Filter& filter) const {
  assert(tiles.has_velocity());
  glm::dvec3 result(0.0);
  visit_places(tiles, bent_m, filter, true, PlaneSum{tiles, WavePlane::velocity, result});
  return result;
}

SeaSample WaveField::sea(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const {
  return sea(tiles, rest_xz_m, filter(footprint_m));
}
glm::dvec3 WaveField::displacement(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const {
  return displacement(tiles, rest_xz_m, filter(footprint_m));
}
glm::dvec3 WaveField::velocity(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const {
  return velocity(tiles, rest_xz_m, filter(footprint_m));
}

double SeaSample::jacobian() const {
  return gpu::surface_jacobian(shift_gradient.x, shift_gradient.y, shift_gradient.z, shift_gradient.z);
}

glm::dvec2 SeaSample::slope() const {
  return gpu::surface_slope(height_gradient.x, height_gradient.y, shift_gradient.x, shift_gradient.y, shift_gradient.z,
                            shift_gradient.z);
}

}  // namespace seascape
