// Sampling the sea's tiles at a rest position: the C++ twin of sea() in the shaders.
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "ocean/waves/tile_sampler_simd.h"
#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"
#include "shaders/shared/surface_slope.h"

namespace seascape {

WaveField::Filter WaveField::filter(double footprint_m) const {
  if (!(footprint_m > 0.0)) footprint_m = 0.0;  // what is no number, or below 0
  Filter result{};
  if (footprint_m == 0.0) {
    std::fill_n(result.share.begin(), places_.size(), 1.0f);
    return result;
  }
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

SampledPlaces WaveField::sampled(const WaveTiles& tiles, glm::dvec2 rest_m, const Filter& filter) const {
  assert(tiles.cascades() == quality_.cascades && tiles.layout().resolution == quality_.resolution);
  const bool warped = bool(warp_);
  return {tiles, places(), rest_m, warped, warped ? warp_.at(rest_m) : PatternWarp::Local{}, filter};
}

SeaSample WaveField::sea(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const {
  SeaSample result;
  add_sea(sampled(tiles, rest_xz_m, filter), result);
  result.slope_moments += statistics_.tail_slope_moments;
  return result;
}

glm::dvec3 WaveField::displacement(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const {
  glm::dvec3 result(0.0);
  add_plane(sampled(tiles, rest_xz_m, filter), WavePlane::shift, result);
  return result;
}

glm::dvec3 WaveField::velocity(const WaveTiles& tiles, glm::dvec2 rest_xz_m, const Filter& filter) const {
  assert(tiles.has_velocity());
  glm::dvec3 result(0.0);
  add_plane(sampled(tiles, rest_xz_m, filter), WavePlane::velocity, result);
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
