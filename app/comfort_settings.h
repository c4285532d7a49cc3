// What a person may set of comfort in motion. Plain values, which app/comfort.h acts by; the defaults are the gentle
// ones.
#pragma once

namespace seascape {

// carried: while something carries the camera.
enum class HorizonLine { none, carried, always };

struct ComfortSettings {
  bool on = true;  // false: none of the others acts
  bool vignette = true;
  double vignette_deg = 90.0;       // most did not notice 90, closed slowly (Fernandes and Feiner 2016)
  double vignette_soft_deg = 20.0;  // of the edge outside it
  double vignette_mps = 3.0;        // a jog; at a walk, 1.4 m/s, the vignette is still outside the picture
  double vignette_deg_per_s = 60.0;
  double vignette_s = 1.0;
  int snap_turn_deg = 30;
  double turn_deg_per_s = 60.0;
  double horizon_lock = 1.0;
  // The share of people who fall ill goes as the acceleration (the motion sickness dose value, ISO 2631-1): half of it
  // is half as many, and the deck stays within half a wave's amplitude of the feet.
  double heave = 0.5;
  double roll = 0.0;
  double small_waves_s = 2.0;  // shorter waves do not sicken, which those of 2 to 10 s do, but jitter
  HorizonLine horizon_line = HorizonLine::carried;
  bool clear_lens = false;  // each eye has drops and an edge of the water of its own, which not everybody bears
};

}  // namespace seascape
