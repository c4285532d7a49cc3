// How data that belong to places are kept, and what holds where no input is. Plain values, in SI units.
#pragma once
#include "ocean/places/lod_windows.h"

namespace seascape {

struct PlaceSettings {
  LodWindowSettings windows{.resolution = 256, .slices = 8, .texel_m = 0.25};
  double rate_hz = 10.0;         // how often what changes with time is taken anew
  double level_m = 0.0;          // the still water's height: a tide
  double sand = 1.0;             // how bright the bed's sand is: 1 of a coral beach
  double growth_m = 2.0;         // above the still water, where growth begins to cover the land; 0: none does
  bool clip_by_default = false;  // no water but where an input takes the clipping away
  double flow_to_deg = 0.0;      // a current everywhere: where it goes to, clockwise from -z seen from above
  double flow_mps = 0.0;         // and how fast
  double flow_period_s = 2.0;    // how long a pattern of waves is carried along before another takes its place
};

// Throws Error naming the setting.
void validate(const PlaceSettings& settings);

}  // namespace seascape
