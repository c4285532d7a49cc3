#include "app/adaptive/loading_levers.h"

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {

constexpr std::string_view preset = "preset", samples = "samples";

}  // namespace

std::vector<Lever> loading_levers(const LoadingRange& range) {
  std::vector<Lever> levers;
  Lever presets;
  presets.name = preset;
  presets.moves = LeverMoves::at_loading;
  presets.gpu_share = presets.cpu_share = 1.0;  // they change all of a frame
  const double finest_ms = range.preset_ms[range.finest_preset], finest_error = range.preset_error[range.finest_preset];
  double work = 1.0, error = 0.0;
  for (std::size_t p = range.finest_preset + 1; p-- > 0;) {
    work = std::min(work, range.preset_ms[p] / finest_ms);
    error = std::max(error, range.preset_error[p] - finest_error);
    presets.steps.push_back({double(p), work, error});
  }
  levers.push_back(std::move(presets));
  if (range.samples > 1) {
    // Of the frame's GPU time: an H100 takes 0.26 of it with one sample instead of four (docs/performance.md).
    Lever of_samples;
    of_samples.name = samples;
    of_samples.moves = LeverMoves::at_loading;
    of_samples.gpu_share = 0.98;
    for (int count = range.samples; count >= 1; count /= 2) {
      constexpr double one_sample_error = 0.026;
      const double lost = std::log2(double(range.samples) / count) / std::log2(double(range.samples));
      of_samples.steps.push_back({double(count), double(count) / range.samples, one_sample_error * lost});
    }
    levers.push_back(std::move(of_samples));
  }
  return levers;
}

void set_loaded(std::span<const Lever> levers, const LoadedWith& with, LeverLevels& levels) {
  for (std::size_t i = 0; i < levers.size(); ++i) {
    if (levers[i].name != preset && levers[i].name != samples) continue;
    const double value = levers[i].name == preset ? double(with.preset) : double(with.samples);
    const auto off = [&](const LeverStep& step) { return std::abs(step.value - value); };
    const auto nearest = std::min_element(levers[i].steps.begin(), levers[i].steps.end(),
                                          [&](const LeverStep& a, const LeverStep& b) { return off(a) < off(b); });
    levels[i] = std::uint8_t(nearest - levers[i].steps.begin());
  }
}

std::optional<LoadedWith> loaded_with(std::span<const Lever> levers, const LeverLevels& levels) {
  std::optional<LoadedWith> with;
  for (std::size_t i = 0; i < levers.size(); ++i) {
    const double value = levers[i].steps[levels[i]].value;
    if (levers[i].name == preset) {
      if (!with) with.emplace();
      with->preset = std::size_t(value);
    } else if (levers[i].name == samples) {
      if (!with) with.emplace();
      with->samples = int(value);
    }
  }
  return with;
}

}  // namespace seascape
