// A sea's settings as its truth (sea_truth.h) asks for them: JONSWAP or TMA spread as Donelan and Banner have it, and
// up to three swells.
#pragma once
#include <cassert>

#include "ocean/waves/sea_state.h"
#include "tests/support/sea_truth.h"

namespace seascape::test {

inline truth::SeaCauses causes_of(const SeaState& sea) {
  assert(sea.spectrum == WaveSpectrum::jonswap || sea.spectrum == WaveSpectrum::tma);
  assert(sea.spreading == WaveSpreading::donelan_banner && sea.swell_elongation == 0.0 &&
         sea.small_wave_suppression == 0.0);
  truth::SeaCauses causes;
  causes.u10 = sea.wind_speed_mps;
  causes.fetch = sea.fetch_m;
  causes.gamma = sea.peak_enhancement;
  causes.wind_to_deg = sea.wind_to_deg;
  causes.depth = sea.depth_m;
  causes.g = sea.gravity_mps2;
  causes.tma = sea.spectrum == WaveSpectrum::tma;
  const auto add = [&](double height, double period, double to_deg) {
    if (height > 0.0) causes.swell.push_back({height, period, to_deg});
  };
  add(sea.swell_height_m, sea.swell_period_s, sea.swell_to_deg);
  add(sea.swell2_height_m, sea.swell2_period_s, sea.swell2_to_deg);
  add(sea.swell3_height_m, sea.swell3_period_s, sea.swell3_to_deg);
  return causes;
}

}  // namespace seascape::test
