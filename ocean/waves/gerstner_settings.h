// Sets of Gerstner waves: the settings of the effect gerstner. Plain values, in SI units.
#pragma once
#include <array>
#include <cstdint>

namespace seascape {

// Waves that belong together: one, or a few an octave of wavelengths from the longest down, each as steep as the
// others.
struct GerstnerSet {
  double height_m = 0.0;       // significant height of all of them: four standard deviations; 0: the set is not there
  double wavelength_m = 60.0;  // of the longest
  double to_deg = 0.0;         // where they go to, clockwise from -z seen from above
  double spread_deg = 0.0;     // their directions lie evenly within so much, half of it to either side
  int octaves = 0;             // 0: one wave; else wavelengths down to wavelength_m / 2^octaves
  int waves = 8;               // an octave
  double reverse = 0.0;        // of each wave's amplitude, what comes the other way: 1 gives waves that stand
  bool shore = false;  // it runs along the scene's curves alone (ocean/places/shore_lines.h), to_deg counted from
                       // straight towards the shore
};

struct GerstnerSettings {
  static constexpr int sets = 2;
  GerstnerSet set1{.height_m = 1.5}, set2;
  double chop = 1.0;       // horizontal displacement: 0 none, 1 as Gerstner's circles have it
  std::uint32_t seed = 1;  // another seed, other phases, wavelengths and directions of the same sets
};

// Throws Error naming the setting, its value and its range, as the effect does for the water it is made for.
void validate(const GerstnerSettings& settings);

}  // namespace seascape
