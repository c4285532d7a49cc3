// What the wind has made of the sea: the inputs of its spectrum. Plain values, in SI units.
#pragma once
#include <cstdint>

namespace seascape {

// The long waves of the wind sea (frequency_spectrum.h, elfouhaily.h); the short ones are Elfouhaily's in all of them.
enum class WaveSpectrum { pierson_moskowitz, jonswap, tma, elfouhaily };
// Over which directions the wind sea's long waves spread (spreading.h).
enum class WaveSpreading { cosine_power, hasselmann, donelan_banner, elfouhaily };

// Deeper than any sea and, for every wave up to 3 km, deep water to the last bit.
inline constexpr double deep_water_m = 10000.0;

struct SeaState {
  double wind_speed_mps = 10.0;  // at 10 m height (U10); 0 gives a flat sea
  double wind_to_deg = 30.0;     // the direction the wind blows TO, degrees clockwise from -z seen from above
  double fetch_m = 300e3;        // how far the wind has blown over open water
  WaveSpectrum spectrum = WaveSpectrum::jonswap;
  WaveSpreading spreading = WaveSpreading::donelan_banner;
  double swell_elongation =
      0.0;  // 0 as the spreading function has it, to 1: longer, more parallel crests (Horvath 2015)
  double depth_m = deep_water_m;  // of still water everywhere; 0 or less is dry land and has no waves
  double peak_enhancement = 3.3;  // JONSWAP's gamma, 1 (Pierson-Moskowitz) to 7
  double swell_height_m = 0.0;    // significant height of a swell train from elsewhere, 0 for none
  double swell_period_s = 12.0;   // its peak period
  double swell_to_deg = 80.0;     // the direction it travels to
  double swell2_height_m = 0.0, swell2_period_s = 9.0, swell2_to_deg = 320.0;  // a second and a third train
  double swell3_height_m = 0.0, swell3_period_s = 16.0, swell3_to_deg = 200.0;
  double chop = 1.0;                    // horizontal displacement, 0 none, 1 as linear theory has it, up to 2
  double small_wave_suppression = 0.0;  // 0 none to 1: damps waves shorter than about 2 m, for comfort in a headset
  double gravity_mps2 = 9.81;
  // Of the heights of the wind sea that the spectrum has: what depth lets stand (sea_limits.h).
  double wind_height_share = 1.0;
  double loop_s = 0.0;     // 0: never repeats; T: waves of whole turns in T seconds, so that the sea repeats exactly
  std::uint32_t seed = 1;  // another seed, another sea of the same statistics; independent of quality

  bool operator==(const SeaState&) const = default;
};

inline constexpr int longest_tile_samples = 512;

// How finely the sea is computed; it never changes a wave that it keeps.
struct WaveQuality {
  int resolution =
      256;           // samples a side of each cascade's tile but the first (ladder.h), a power of two from 16 to 512
  int cascades = 4;  // how many cascades of the ladder are kept, longest waves first, 1 to 5
  bool half_storage = false;  // store the tiles on the GPU as 16-bit floats
};

}  // namespace seascape
