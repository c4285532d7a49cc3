#include "app/adaptive/rate_keeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace seascape {

RateKeeper::RateKeeper(std::vector<Lever> levers, const LeverLevels& start)
    : controller_(std::move(levers), {}, {}, start), quality_(drawn_quality(controller_.levers(), start)) {
  timings_.reserve(4);
  foreseen_.reserve(4);
}

const Decision& RateKeeper::decide(const KnownOfFrames& known, const AdaptiveSettings& settings) {
  ++frame_;
  const double period_ms = settings.target_hz > 0.0 ? 1000.0 / settings.target_hz : known.period_ms;
  on_ = settings.on && period_ms > 0.0;
  AdaptiveSettings used = settings;
  used.on = on_;
  used.target_hz = 0.0;
  controller_.set(used);
  const Drawn& timed = drawn_[known.timed_frame % drawn_.size()];
  if (known.timed_frame != timed_ && timed.number == known.timed_frame && timed.frame > first_frames)
    take(timed, known.gpu_ms);
  timed_ = known.timed_frame;
  constexpr double least_share = 0.3;
  FrameInput input;
  input.frame = frame_;
  input.period_ms = on_ ? period_ms : 1.0;
  input.deadline_ms = std::max(input.period_ms - serial_ms_, least_share * input.period_ms);
  input.interval_ms = known.interval_ms;
  input.focused = known.focused;
  input.timings = timings_;
  input.foreseen = foreseen_;
  const Decision& decision = controller_.decide(input);
  timings_.clear();
  foreseen_.clear();
  quality_ = on_ ? drawn_quality(controller_.levers(), decision.levels) : DrawnQuality{};
  return decision;
}

// A display that waits for the GPU before it gives a frame back has nothing overlap: software drivers do so in windows.
void RateKeeper::take(const Drawn& timed, double gpu_ms) {
  timings_.push_back({timed.frame, gpu_ms, 0.0, timed.levels, 1.0});
  constexpr double waits = 0.5, gain = 0.1;
  const bool waited = timed.end_ms > waits * gpu_ms;
  const double serial_ms = waited ? std::max(timed.cpu_ms + timed.end_ms - gpu_ms, 0.0) : 0.0;
  serial_ms_ += gain * (serial_ms - serial_ms_);
}

void RateKeeper::drawn(const HandedOver& frame) {
  const LeverLevels levels = on_ && !frame.whole ? controller_.last().levels : controller_.loaded();
  drawn_[frame.number % drawn_.size()] = {frame.number, frame_, levels, frame.cpu_ms, frame.end_ms};
  if (frame_ > first_frames) timings_.push_back({frame_, 0.0, frame.cpu_ms, levels, 1.0});
  meet(frame.under_water, frame.wind_mps);
}

// Going under, coming up and another sea at once change the load in one frame; by how much is known from the time
// before. While a sea becomes another wave by wave its load comes by degrees, and is measured as it does.
void RateKeeper::meet(bool under_water, const std::optional<double>& wind_mps) {
  Water next{under_water, water_ ? water_->force : 0};
  // Beaufort's number of a wind v is (v / 0.836)^(2/3) (World Meteorological Organization 1970).
  if (wind_mps) next.force = int(std::clamp(std::cbrt(std::pow(*wind_mps / 0.836, 2.0)) + 0.5, 0.0, forces - 1.0));
  const bool settled = wind_mps.has_value(), crosses = water_ && *water_ != next && settled == settled_;
  if (crosses || (water_ && settled_ && !settled)) {
    const auto remembered = [&](const CostEstimator& cost, Loads& loads) {
      if (!cost.known()) return 1.0;
      const double now = cost.log_load(frame_);
      if (settled_) loads[std::size_t(water_->under)][std::size_t(water_->force)] = now;
      const std::optional<double>& then = loads[std::size_t(next.under)][std::size_t(next.force)];
      return crosses && then ? std::exp(*then - now) : 1.0;
    };
    const double gpu = remembered(controller_.gpu(), gpu_load_), cpu = remembered(controller_.cpu(), cpu_load_);
    const ForeseenKind kind = water_->under == next.under ? ForeseenKind::storm
                              : next.under                ? ForeseenKind::going_under
                                                          : ForeseenKind::surfacing;
    if (gpu != 1.0 || cpu != 1.0) foreseen_.push_back({kind, frame_, gpu, cpu});
  }
  water_ = next, settled_ = settled;
}

std::optional<LoadedWith> RateKeeper::for_scene(double gpu_ratio, double cpu_ratio) {
  if (!on_) return std::nullopt;
  return loaded_with(controller_.levers(), controller_.best_for_scene(gpu_ratio, cpu_ratio));
}

std::string RateKeeper::text() const {
  const Decision& d = controller_.last();
  if (!on_) return "quality: as the preset has it";
  std::string text = fmt::format("quality {:.2f}, picture {:.2f}", d.quality, quality_.scale);
  if (d.predicted_ms > 0.0)
    text += fmt::format(", {} {:.1f} of {:.1f} ms", d.of == CostOf::gpu ? "GPU" : "CPU", d.predicted_ms, d.budget_ms);
  return text + ": " + std::string(name_of(d.reason));
}

}  // namespace seascape
