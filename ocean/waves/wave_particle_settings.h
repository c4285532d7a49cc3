// How wave particles ruffle the water: the settings of the effect wave_particles. Plain values, in SI units.
#pragma once
#include <cstdint>

namespace seascape {

struct WaveParticleSettings {
  int count = 800;         // particles on the tile
  double tile_m = 8.0;     // side of the tile's largest laying, after which it repeats
  double radius_m = 0.25;  // of a particle: 16 x 16 texels of the tile are 2 x 2 radii
  double height_m = 0.02;  // significant height of all layings together: four standard deviations; 0 gives none
  double speed_mps = 0.0;  // of every particle of the largest laying; 0: of a deep-water wave two radii long
  double chop = 1.0;       // horizontal displacement, 0 none, 1 as Yuksel's particles have it at their crests
  int scales = 3;          // how many sizes the tile is laid down in, 1 to 3
  std::uint32_t seed = 1;  // another seed, other particles of the same statistics
};

// Throws Error naming the setting, its value and its range; a particle has 4 to 64 of the tile's 256 texels for a
// radius.
void validate(const WaveParticleSettings& settings);

}  // namespace seascape
