// How the sea answers to what moves on it: the settings of the effect dynamic_waves. Plain values, in SI units.
#pragma once
#include "ocean/places/lod_windows.h"

namespace seascape {

struct DynamicWavesSettings {
  LodWindowSettings windows{
      .resolution = 128, .slices = 6, .texel_m = 0.125};  // resolution: a power of two from 64 to 1024
  double rate_hz = 60.0;                                  // steps a second, 10 to 1000, whatever is drawn
  double damping_per_s = 0.05;                            // amplitudes fall by exp(-damping t / 2)
  double gravity_mps2 = 9.81;
  double depth_m = 1e6;     // until set_depth()
  double idle_m = 1e-4;     // lower than this everywhere, and not pushed, waves come to rest; 0: never
  double sharpening = 1.0;  // horizontal displacement, 0 to 2, 1 as linear waves have it
  int most_steps = 8;       // of an advance; more time than that is divided among as many longer steps
};

// Throws Error naming the setting.
void validate(const DynamicWavesSettings& settings);

}  // namespace seascape
