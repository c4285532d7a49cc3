#include "ocean/sea/sea_change.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ocean/waves/spectrum.h"

namespace seascape {

bool grows_out_of(const SeaState& from, const SeaState& to) {
  return from.gravity_mps2 == to.gravity_mps2 && from.depth_m == to.depth_m && from.loop_s == to.loop_s;
}

SeaMaker::SeaMaker(const Ladder& ladder, const WaveQuality& quality)
    : ladder_(ladder), quality_(quality), thread_([this](std::stop_token stop) { work(std::move(stop)); }) {}

SeaMaker::~SeaMaker() = default;  // the thread is asked to stop and waited for

SeaStatistics statistics_in(const SeaState& sea, const WaveBins& bins, const WaveQuality& quality) {
  return sea_statistics(sea, keeps_all(quality, bins) ? bins : kept_bins(bins, quality));
}

void SeaMaker::ask(const SeaState& sea, const WaveQuality& drawn, MakePlace place) {
  validate(sea);
  const std::lock_guard lock(mutex_);
  wanted_ = sea;
  drawn_ = drawn;
  place_ = std::move(place);
  made_.reset();
  asked_.notify_one();
}

std::optional<MadeSea> SeaMaker::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(made_, std::nullopt);
}

void SeaMaker::work(std::stop_token stop) {
  // An arena of its own: the frame's thread, when it waits for its own pieces of work, must not pick up one of these.
  tbb::task_arena arena(1);
  for (;;) {
    SeaState sea;
    WaveQuality drawn;
    MakePlace place;
    {
      std::unique_lock lock(mutex_);
      if (!asked_.wait(lock, stop, [&] { return wanted_.has_value(); })) return;
      sea = *std::exchange(wanted_, std::nullopt);
      drawn = drawn_;
      place = std::exchange(place_, nullptr);
    }
    MadeSea made;
    arena.execute([&] {
      made.state = sea;
      made.bins = make_wave_bins(sea, quality_, ladder_);
      made.statistics = statistics_in(sea, made.bins, drawn);
      if (place) made.place = place(sea, made.bins);
    });
    const std::lock_guard lock(mutex_);
    if (!wanted_) made_ = std::move(made);
  }
}

SeaBlend::SeaBlend(MadeSea from, MadeSea to, std::int64_t begin_ticks, std::int64_t end_ticks, bool same_waves)
    : from_(std::move(from)), to_(std::move(to)), begin_(begin_ticks), end_(end_ticks), same_waves_(same_waves) {}

SeaBlend::Weights SeaBlend::weights(std::int64_t ticks) const {
  const double t = ticks >= end_ ? 1.0 : std::clamp(double(ticks - begin_) / double(end_ - begin_), 0.0, 1.0);
  const double s = t * t * (3.0 - 2.0 * t);  // neither jumps nor jerks
  if (same_waves_) return {1.0 - s, s, s};
  if (t >= 1.0) return {0.0, 1.0, 1.0};
  const double angle = 0.5 * std::numbers::pi * s;
  return {std::cos(angle), std::sin(angle), std::sin(angle) * std::sin(angle)};
}

void SeaBlend::amplitudes(std::int64_t ticks, WaveBins& bins) const {
  const Weights w = weights(ticks);
  const glm::vec2 from(static_cast<float>(w.from)), to(static_cast<float>(w.to));
  constexpr std::size_t piece = 1 << 13;
  const std::size_t count = bins.bins.size();
  tbb::parallel_for(std::size_t(0), (count + piece - 1) / piece, [&](std::size_t p) {
    for (std::size_t i = p * piece; i < std::min(count, (p + 1) * piece); ++i)
      bins.bins[i].amplitude = from * from_.bins.bins[i].amplitude + to * to_.bins.bins[i].amplitude;
  });
}

double SeaBlend::chop(std::int64_t ticks) const {
  return std::lerp(from_.state.chop, to_.state.chop, weights(ticks).variance);
}

SeaStatistics SeaBlend::statistics(std::int64_t ticks) const {
  const SeaStatistics &a = from_.statistics, &b = to_.statistics;
  const double v = weights(ticks).variance;
  SeaStatistics result;
  result.height_variance = std::lerp(a.height_variance, b.height_variance, v);
  result.slope_moments = glm::mix(a.slope_moments, b.slope_moments, v);
  result.tail_slope_moments = glm::mix(a.tail_slope_moments, b.tail_slope_moments, v);
  // The height is a sum of both seas' heights, and so no higher than the sum of both bounds.
  const Weights w = weights(ticks);
  result.largest_height_m = w.from * a.largest_height_m + w.to * b.largest_height_m;
  result.largest_shift_m = w.from * a.largest_shift_m + w.to * b.largest_shift_m;
  for (std::size_t n = 0; n < result.mesh_error.octave_m.size(); ++n)
    result.mesh_error.octave_m[n] = w.from * a.mesh_error.octave_m[n] + w.to * b.mesh_error.octave_m[n];
  for (std::size_t n = 0; n < result.near_motion.vertical_m.size(); ++n) {
    result.near_motion.vertical_m[n] = w.from * a.near_motion.vertical_m[n] + w.to * b.near_motion.vertical_m[n];
    result.near_motion.horizontal_m[n] = w.from * a.near_motion.horizontal_m[n] + w.to * b.near_motion.horizontal_m[n];
  }
  const auto unchopped = [](const MadeSea& sea) {
    return sea.state.chop > 0.0 ? sea.statistics.largest_shift_m / sea.state.chop : 0.0;
  };
  if (from_.state.chop > 0.0 && to_.state.chop > 0.0)
    result.largest_shift_m = chop(ticks) * (w.from * unchopped(from_) + w.to * unchopped(to_));
  return result;
}

}  // namespace seascape
