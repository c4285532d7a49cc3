// What adaptive quality is told of the frames that are drawn.
#pragma once
#include "app/adaptive/rate_keeper.h"
#include "app/experience.h"

namespace seascape {

// Before a frame: the newest GPU time that is known. `period_ms`: of the display.
KnownOfFrames known_of(const Frame& frame, double period_ms);
// After one (HandedOver).
HandedOver handed_over(Experience& experience, double cpu_ms, double end_ms, bool whole = false);

}  // namespace seascape
