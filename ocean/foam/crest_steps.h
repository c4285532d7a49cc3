// Foam and spray stepped beside each other, in order of their times, so that the crests they ask for are made once, and
// those of the next steps spread over the frames before them.
#pragma once
#include "ocean/foam/foam_sea.h"
#include "ocean/foam/spray.h"

namespace seascape {

// Has both at a time of the sea (s) around a viewer (m); either may be null.
inline void step_together(FoamSea* foam, Spray* spray, double time_s, const glm::dvec3& viewer_m) {
  if (foam != nullptr) foam->begin(time_s, viewer_m);
  if (spray != nullptr) spray->begin(time_s, viewer_m);
  for (;;) {
    const std::optional<double> of_foam = foam != nullptr ? foam->next_s() : std::nullopt,
                                of_spray = spray != nullptr ? spray->next_s() : std::nullopt;
    if (!of_foam && !of_spray) break;
    const bool both = of_foam && of_spray && *of_foam == *of_spray;
    if (of_foam && (both || !of_spray || *of_foam < *of_spray)) foam->step();
    if (of_spray && (both || !of_foam || *of_spray < *of_foam)) spray->step();
  }
  if (foam != nullptr) foam->prepare(time_s);
  if (spray != nullptr) spray->prepare(time_s);
}

}  // namespace seascape
