// What steepness and depth let stand of the waves that a sea's settings ask for.
#pragma once
#include <array>
#include <optional>

#include "ocean/waves/sea_state.h"
#include "ocean/waves/wave_particle_settings.h"

namespace seascape {

// The significant height that water bears, over its depth: waves in a surf zone are in root mean square 0.42 of the
// depth high (Thornton and Guza 1982, 1983), and the significant height is sqrt(2) of that.
inline constexpr double most_height_of_depth = 0.42 * 1.4142135623730951;

// A sea that water bears, and what it has of the waves asked for.
struct LimitedSea {
  struct Waves {
    double asked_m = 0.0, drawn_m = 0.0;  // significant heights; alike where nothing limits them
    bool too_steep = false, too_high = false;
  };
  SeaState sea;
  std::optional<WaveParticleSettings> particles;
  // Of the wind sea, of each train of swell, and of the particles.
  static constexpr int wind = 0, first_swell = 1, of_particles = 4;
  std::array<Waves, 5> waves{};
};

// Steepness: a wave breaks at H / L = 0.142 tanh(k h) (Miche 1944), where the water of its crest, with the orbits of
// linear theory, is drawn together by k A coth(k h) = 0.142 pi in any depth. One wave in ten may be that steep: heights
// follow Rayleigh's law (Longuet-Higgins 1952), and so the deviation of that gradient may be 0.142 pi / sqrt(2 ln 10).
// A wind sea in deep water is no steeper than its spectrum and stays as it is. Swell has the variance that the wind sea
// leaves, and particles what the swell leaves; an eighth of all at least. Waves shorter than 0.1 m do not count, and
// neither does chop. Depth: the significant height of each, and of all together, is at most most_height_of_depth times
// the depth. A sea within these limits comes back to the bit. Throws Error as validate() does.
LimitedSea limited_sea(const SeaState& sea, const std::optional<WaveParticleSettings>& particles = std::nullopt);

}  // namespace seascape
