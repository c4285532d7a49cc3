// The dynamic waves as a scene has them: driven by the sea's time and its viewer, rained on, and ready to be drawn.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ocean/inputs/inputs.h"
#include "ocean/places/dynamic_sea_settings.h"
#include "ocean/places/dynamic_surface.h"

namespace seascape {

// Steps fall on whole multiples of 1 / rate of the sea's time, and what pushes is a function of time and place: however
// a span is cut into frames, the same steps are taken (but where a frame is longer than most_steps of them). Time that
// runs backwards or jumps by more than longest_s begins anew, with calm water settle_s before, so that a moment looks
// alike wherever the frames began: by what has not been damped away or left the windows by then.
class DynamicSea {
 public:
  static constexpr double longest_s = 5.0;
  // `pressure`: inputs of dynamic_waves, heads on the water as they are in the middle of a step; null for none. Throws
  // as validate() does.
  explicit DynamicSea(const DynamicSeaSettings& settings, std::shared_ptr<const Inputs> pressure = nullptr);

  // The waves as they are at a time of the sea, in s, around a viewer (m). Gives whether surface() has changed. A time
  // or a place that is no number changes nothing.
  bool update(double time_s, const glm::dvec3& viewer_m);
  const DynamicSurface& surface() const { return surface_; }
  const DynamicWaves& waves() const { return waves_; }
  // What went wrong since the last call, once (DynamicWaves::take_fault).
  std::optional<std::string> take_fault() { return waves_.take_fault(); }

 private:
  void advance(std::int64_t ticks);
  DynamicSeaSettings settings_;
  std::shared_ptr<const Inputs> pressure_;  // null: none
  LodViewer viewer_;
  DynamicWaves waves_;
  DynamicSurface surface_;
  std::vector<WaveSource> sources_;
  std::int64_t tick_ = 0;
  bool begun_ = false;
};

}  // namespace seascape
