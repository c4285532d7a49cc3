#include "app/frame_times.h"

namespace seascape {

KnownOfFrames known_of(const Frame& frame, double period_ms) {
  return {.period_ms = period_ms, .timed_frame = frame.timed_frame(), .gpu_ms = frame.gpu_ms()};
}

HandedOver handed_over(Experience& experience, double cpu_ms, double end_ms, bool whole) {
  const Frame& frame = experience.frame();
  return {.number = frame.number(),
          .cpu_ms = cpu_ms,
          .end_ms = end_ms,
          .under_water = experience.under_water(),
          .whole = whole,
          .wind_mps = experience.sea()->changing() ? std::nullopt
                                                   : std::optional(experience.scene().settings.sea.wind_speed_mps)};
}

}  // namespace seascape
