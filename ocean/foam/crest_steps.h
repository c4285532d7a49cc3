// Foam and spray stepped beside each other, in order of their times, so that the crests they ask for are made once, and
// those of the next steps spread over the frames before them.
#pragma once
#include "engine/stages.h"
#include "ocean/foam/foam_sea.h"
#include "ocean/foam/spray.h"

namespace seascape {

// Has both at a time of the sea (s) around a viewer (m); either may be null. Their times are stages of their names.
inline void step_together(FoamSea* foam, Spray* spray, double time_s, const glm::dvec3& viewer_m, Stages& stages) {
  const auto of_foam_do = [&](const auto& work) {
    if (foam != nullptr) stages.time("foam", [&] { work(*foam); });
  };
  const auto of_spray_do = [&](const auto& work) {
    if (spray != nullptr) stages.time("spray", [&] { work(*spray); });
  };
  of_foam_do([&](FoamSea& f) { f.begin(time_s, viewer_m); });
  of_spray_do([&](Spray& s) { s.begin(time_s, viewer_m); });
  for (;;) {
    const std::optional<double> of_foam = foam != nullptr ? foam->next_s() : std::nullopt,
                                of_spray = spray != nullptr ? spray->next_s() : std::nullopt;
    if (!of_foam && !of_spray) break;
    const bool both = of_foam && of_spray && *of_foam == *of_spray;
    if (of_foam && (both || !of_spray || *of_foam < *of_spray)) of_foam_do([](FoamSea& f) { f.step(); });
    if (of_spray && (both || !of_foam || *of_spray < *of_foam)) of_spray_do([](Spray& s) { s.step(); });
  }
  of_foam_do([&](FoamSea& f) { f.prepare(time_s); });
  of_spray_do([&](Spray& s) { s.prepare(time_s); });
}

}  // namespace seascape
