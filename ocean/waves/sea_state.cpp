// Which inputs of a sea and of its quality are accepted.
#include "ocean/waves/sea_state.h"

#include <cmath>
#include <numbers>
#include <string>

#include "engine/error.h"
#include "engine/text.h"
#include "ocean/waves/spectrum.h"

namespace seascape {

namespace {
void require(double value, double least, double most, const char* key) {
  if (value >= least && value <= most) return;  // false for NaN
  throw Error(key, text_from(value) + " is not in the range " + text_from(least) + " to " + text_from(most),
              "give a finite number in that range");
}

// An enum that came from elsewhere than the table of settings, by a cast.
template <class Enum>
void require_choice(Enum value, Enum last, const char* key, const char* names) {
  if (int(value) >= 0 && value <= last) return;
  throw Error(key, "choice " + std::to_string(int(value)) + " is not one of " + names, "give one of them");
}
}  // namespace

void validate(const SeaState& sea) {
  require(sea.wind_speed_mps, 0.0, 100.0, "waves.wind_speed_mps");
  require(sea.wind_to_deg, -3600.0, 3600.0, "waves.wind_to_deg");
  require(sea.fetch_m, 0.0, 1e12, "waves.fetch_m");
  require_choice(sea.spectrum, WaveSpectrum::elfouhaily, "waves.spectrum",
                 "pierson_moskowitz, jonswap, tma and elfouhaily");
  require_choice(sea.spreading, WaveSpreading::elfouhaily, "waves.spreading",
                 "cosine_power, hasselmann, donelan_banner and elfouhaily");
  require(sea.swell_elongation, 0.0, 1.0, "waves.swell_elongation");
  require(sea.depth_m, -1e6, 1e6, "waves.depth_m");
  require(sea.peak_enhancement, 1.0, 20.0, "waves.peak_enhancement");
  require(sea.swell_height_m, 0.0, 50.0, "waves.swell_height_m");
  require(sea.swell_period_s, 0.5, 60.0, "waves.swell_period_s");
  require(sea.swell_to_deg, -3600.0, 3600.0, "waves.swell_to_deg");
  require(sea.swell2_height_m, 0.0, 50.0, "waves.swell2_height_m");
  require(sea.swell2_period_s, 0.5, 60.0, "waves.swell2_period_s");
  require(sea.swell2_to_deg, -3600.0, 3600.0, "waves.swell2_to_deg");
  require(sea.swell3_height_m, 0.0, 50.0, "waves.swell3_height_m");
  require(sea.swell3_period_s, 0.5, 60.0, "waves.swell3_period_s");
  require(sea.swell3_to_deg, -3600.0, 3600.0, "waves.swell3_to_deg");
  require(sea.chop, 0.0, 2.0, "waves.chop");
  require(sea.small_wave_suppression, 0.0, 1.0, "waves.small_wave_suppression");
  require(sea.gravity_mps2, 0.01, 1000.0, "waves.gravity_mps2");
  require(sea.wind_height_share, 0.0, 1.0, "waves.wind_height_share");
  require(sea.loop_s, 0.0, 86400.0, "waves.loop_s");
}

void validate(const WaveQuality& quality) {
  const int n = quality.resolution;
  if (n < 16 || n > 512 || (n & (n - 1)) != 0)
    throw Error("waves.resolution", std::to_string(n) + " is not a power of two from 16 to 512",
                "give 16, 32, 64, 128, 256 or 512");
  if (quality.cascades < 1 || quality.cascades > 5)
    throw Error("waves.cascades", std::to_string(quality.cascades) + " is not in the range 1 to 5",
                "give a whole number in that range");
}

glm::dvec2 direction_xz(double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {std::sin(a), -std::cos(a)};
}

}  // namespace seascape
