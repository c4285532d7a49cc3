// The sum of what several places of tiles have at one rest position, vectorised: WaveField asks for it.
#pragma once
#include <glm/glm.hpp>
#include <span>

#include "ocean/waves/wave_field.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

struct SampledPlaces {
  const WaveTiles& tiles;
  std::span<const WaveField::Place> places;
  glm::dvec2 rest_m;
  bool warped;  // the first place, by this
  PatternWarp::Local warp;
  const WaveField::Filter& filter;
};

// Where the first texel of a level stands whose side has `size` texels, counted from a whole tile before, so that all
// texels' numbers are positive. Texel j of level 0 stands at j / size of the side, and those of the next levels in the
// middle of what they average; `offset`: of the tile's laying, in sides.
inline double first_texel(int level, int size, double offset) {
  static_assert(longest_tile_samples < 1 << 10);
  constexpr double half_of[] = {0.5,      0.5 / 2,  0.5 / 4,   0.5 / 8,   0.5 / 16,
                                0.5 / 32, 0.5 / 64, 0.5 / 128, 0.5 / 256, 0.5 / 512};  // of a texel, in level 0's
  return size - 0.5 + half_of[level] + offset * size;
}

void add_sea(const SampledPlaces& places, SeaSample& to);
// Of x, y and z of one plane.
void add_plane(const SampledPlaces& places, WavePlane plane, glm::dvec3& to);

}  // namespace seascape
