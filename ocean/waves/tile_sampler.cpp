// Sampling the sea's tiles at a rest position: the C++ twin of sea() in the shaders.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

namespace {
// Where a sample falls between the texels of one level.
struct Corner {
  std::size_t at[4];
  float weight[4];
};

Corner corner(const WaveTiles& tiles, int level, glm::dvec2 coordinates) {
  const int size = tiles.resolution() >> level, stride = tiles.stride(level);
  const double x = coordinates.x * size - 0.5, z = coordinates.y * size - 0.5;
  const double floor_x = std::floor(x), floor_z = std::floor(z);
  const float fx = float(x - floor_x), fz = float(z - floor_z);
  // Coordinates are in [0, 2), so these are small; & wraps negative ones too.
  const int x0 = int(floor_x) & (size - 1), z0 = int(floor_z) & (size - 1);
  const int x1 = (x0 + 1) & (size - 1), z1 = (z0 + 1) & (size - 1);
  return {{std::size_t(z0) * stride + x0, std::size_t(z0) * stride + x1, std::size_t(z1) * stride + x0, std::size_t(z1) * stride + x1},
          {(1.0f - fx) * (1.0f - fz), fx * (1.0f - fz), (1.0f - fx) * fz, fx * fz}};
}

glm::vec4 blend(const glm::vec4* texels, const Corner& c) {
  return c.weight[0] * texels[c.at[0]] + c.weight[1] * texels[c.at[1]] + c.weight[2] * texels[c.at[2]] + c.weight[3] * texels[c.at[3]];
}

// A trilinear sample's place: two levels and how far between.
struct Spot {
  int cascade, level;
  float between;
  Corner fine, coarse;
};

glm::vec4 sample(const WaveTiles& tiles, const Spot& spot, WavePlane plane) {
  const glm::vec4 fine = blend(tiles.texels(spot.cascade, plane, spot.level), spot.fine);
  if (spot.between == 0.0f) return fine;
  const glm::vec4 coarse = blend(tiles.texels(spot.cascade, plane, spot.level + 1), spot.coarse);
  return fine + spot.between * (coarse - fine);
}
}  // namespace

// Calls visit(spot) for each cascade that the footprint resolves and visit.whole(cascade) for each that it does not.
template <class Visit>
void WaveField::visit_cascades(const WaveTiles& tiles, glm::dvec2 rest, double footprint_m, Visit visit) const {
  assert(tiles.cascades() == quality_.cascades && tiles.resolution() == quality_.resolution);
  const int last = tiles.levels() - 1;
  for (int i = 0; i < quality_.cascades; ++i) {
    const Place& place = places_[i];
    const double lod = footprint_m > place.texel_m ? std::log2(footprint_m / place.texel_m) : 0.0;
    if (lod >= last) {
      visit.whole(i);
      continue;
    }
    // In double, so that a sample a thousand kilometres out is as exact as one at the origin.
    const double u = (place.cosine * rest.x + place.sine * rest.y) * place.inverse_side;
    const double v = (-place.sine * rest.x + place.cosine * rest.y) * place.inverse_side;
    const double half_texel = 0.5 / quality_.resolution;
    const glm::dvec2 coordinates{u - std::floor(u) + half_texel, v - std::floor(v) + half_texel};
    Spot spot{};
    spot.cascade = i;
    spot.level = int(lod);
    spot.between = float(lod - spot.level);
    spot.fine = corner(tiles, spot.level, coordinates);
    if (spot.between > 0.0f) spot.coarse = corner(tiles, spot.level + 1, coordinates);
    visit(spot);
  }
}

SeaSample WaveField::sea(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const {
  struct Sum {
    const WaveTiles& tiles;
    SeaSample& to;
    void operator()(const Spot& spot) {
      const glm::dvec4 shift(sample(tiles, spot, WavePlane::shift)), slope(sample(tiles, spot, WavePlane::slope)),
          moments(sample(tiles, spot, WavePlane::moments));
      to.displacement += glm::dvec3(shift);
      to.height_gradient += glm::dvec2(slope);
      to.shift_gradient += glm::dvec3(slope.z, slope.w, shift.w);
      const double divergence = slope.z + slope.w;
      to.slope_moments += glm::dvec3(std::max(moments.x - slope.x * slope.x, 0.0), std::max(moments.y - slope.y * slope.y, 0.0),
                                     moments.z - slope.x * slope.y);
      to.divergence_moment += std::max(moments.w - divergence * divergence, 0.0);
    }
    void whole(int cascade) {
      const glm::dvec4 moments(*tiles.texels(cascade, WavePlane::moments, tiles.levels() - 1));
      to.slope_moments += glm::dvec3(moments);
      to.divergence_moment += moments.w;
    }
  };
  SeaSample result;
  visit_cascades(tiles, rest_xz_m, footprint_m, Sum{tiles, result});
  result.slope_moments += statistics_.tail_slope_moments;
  return result;
}

namespace {
// Sums x, y, z of one plane.
struct PlaneSum {
  const WaveTiles& tiles;
  WavePlane plane;
  glm::dvec3& to;
  void operator()(const Spot& spot) { to += glm::dvec3(sample(tiles, spot, plane)); }
  void whole(int) {}
};
}  // namespace

glm::dvec3 WaveField::displacement(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const {
  glm::dvec3 result(0.0);
  visit_cascades(tiles, rest_xz_m, footprint_m, PlaneSum{tiles, WavePlane::shift, result});
  return result;
}

glm::dvec3 WaveField::velocity(const WaveTiles& tiles, glm::dvec2 rest_xz_m, double footprint_m) const {
  assert(tiles.has_velocity());
  glm::dvec3 result(0.0);
  visit_cascades(tiles, rest_xz_m, footprint_m, PlaneSum{tiles, WavePlane::velocity, result});
  return result;
}

double SeaSample::jacobian() const {
  return (1.0 + shift_gradient.x) * (1.0 + shift_gradient.y) - shift_gradient.z * shift_gradient.z;
}

glm::dvec2 SeaSample::slope() const {
  // (I + grad D) is symmetric. Where it is singular the slope is without bound: the sign of the fold is kept and the
  // size held, so that a normal made of it lies in the surface's steepest direction.
  const double j = jacobian(), held = std::copysign(std::max(std::abs(j), 1e-3), j);
  return glm::dvec2((1.0 + shift_gradient.y) * height_gradient.x - shift_gradient.z * height_gradient.y,
                    (1.0 + shift_gradient.x) * height_gradient.y - shift_gradient.z * height_gradient.x) / held;
}

}  // namespace seascape
