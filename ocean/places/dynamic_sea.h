// The dynamic waves as a scene has them: driven by the sea's time and its viewer, rained on, and ready to be drawn.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ocean/inputs/inputs.h"
#include "ocean/places/dynamic_sea_settings.h"
#include "ocean/places/dynamic_surface.h"

namespace seascape {

// Steps fall on whole multiples of 1 / rate of the sea's time, and what pushes is a function of time and place: however
// a span is cut into frames, the same steps are taken. Time that runs backwards or jumps by more than longest_s begins
// anew, with calm water settle_s before, so that a moment looks alike wherever the frames began: by what has not been
// damped away or left the windows by then. Between steps the surface is that of the last one, carried on to the time
// asked: exact but for what pushes meanwhile.
class DynamicSea {
 public:
  static constexpr double longest_s = 5.0;
  // `pressure`: inputs of dynamic_waves, heads on the water as they are in the middle of a step; null for none. Throws
  // as validate() does.
  explicit DynamicSea(const DynamicSeaSettings& settings, std::shared_ptr<const Inputs> pressure = nullptr);

  // What pushes besides in a step, from `time_s - dt_s` to `time_s`: appended to the sources. Not asked of the steps
  // that settle.
  using Push = std::function<void(double time_s, double dt_s, std::vector<WaveSource>& sources)>;
  // Whether an update at this time begins anew.
  bool begins_anew(double time_s) const;
  // The waves as they are at a time of the sea, in s, around a viewer (m). Gives whether surface() has changed. A time
  // or a place that is no number changes nothing.
  bool update(double time_s, const glm::dvec3& viewer_m, const Push& push = nullptr);
  // From now on nothing begins anew: the waves that there are go on over a jump (jump_steps.h).
  void go_on() { goes_on_ = true; }
  // As of the last update; within one, as of the step before.
  const DynamicSurface& surface() { return *shared_surface(); }
  // The same to keep: it stays as it is, whatever steps follow.
  std::shared_ptr<const DynamicSurface> shared_surface();
  // Takes other settings of the same windows, gravity and depth; the waves that there are go on. After another rate the
  // steps fall on its multiples. Throws as validate() does, and stays as it was then.
  void apply(const DynamicSeaSettings& settings);
  // Whether surfaces, from the next on, know how fast they move.
  void know_velocity(bool known) { velocity_ = known; }
  // Counts up whenever surface() changes.
  std::uint64_t surface_version() const { return version_; }
  double rate_hz() const { return settings_.waves.rate_hz; }
  std::int64_t tick() const { return tick_; }  // of the last step
  const DynamicWaves& waves() const { return waves_; }
  // What went wrong since the last call, once (DynamicWaves::take_fault).
  std::optional<std::string> take_fault() { return waves_.take_fault(); }

 private:
  void step(const Push& push);
  DynamicSeaSettings settings_;
  std::shared_ptr<const Inputs> pressure_;  // null: none
  LodViewer viewer_;
  DynamicWaves waves_;
  std::vector<std::shared_ptr<DynamicSurface>> surfaces_;  // the current one, and those that somebody keeps
  std::size_t current_ = 0;
  bool stale_ = false;  // the current one is of another state than the waves
  bool velocity_ = false;
  double ahead_s_ = 0.0;
  std::uint64_t version_ = 1;
  std::vector<WaveSource> sources_;
  std::int64_t tick_ = 0;
  bool begun_ = false, goes_on_ = false;
};

}  // namespace seascape
