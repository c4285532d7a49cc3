#include "app/loading_range.h"

namespace seascape {

namespace {

// A device that tells no times of its GPU has whole frames alone.
const PresetCost* times_of(const PresetCosts& costs) {
  const PresetCost* gpu = row_of(costs, gpu_row);
  return gpu != nullptr ? gpu : row_of(costs, frame_row);
}

}  // namespace

std::optional<LoadingRange> loading_range(std::span<const PresetCosts> costs, std::string_view scene,
                                          const Calibration& calibration, double megapixels, std::size_t finest_preset,
                                          int samples) {
  const PresetCosts* of_scene = costs_of(costs, scene);
  if (of_scene == nullptr) of_scene = costs_of(costs, "open_sea");
  if (of_scene == nullptr) return std::nullopt;
  const PresetCost *times = times_of(*of_scene), *errors = row_of(*of_scene, error_row);
  if (times == nullptr || errors == nullptr) return std::nullopt;
  LoadingRange range{finest_preset, times->of, errors->of, samples};
  bool calibrated = true;
  for (std::size_t p = 0; p <= finest_preset; ++p) calibrated = calibrated && calibration.presets[p].has_value();
  for (std::size_t p = 0; p <= finest_preset; ++p) {
    if (calibrated) range.preset_ms[p] = calibration.presets[p]->at(megapixels);
    if (!(range.preset_ms[p] > 0.0)) return std::nullopt;
  }
  return range;
}

double scene_ratio(std::span<const PresetCosts> costs, std::string_view from, std::string_view to, std::size_t preset) {
  const PresetCosts *a = costs_of(costs, from), *b = costs_of(costs, to);
  if (a == nullptr || b == nullptr) return 1.0;
  const PresetCost *before = times_of(*a), *after = times_of(*b);
  if (before == nullptr || after == nullptr || !(before->of[preset] > 0.0) || !(after->of[preset] > 0.0)) return 1.0;
  return after->of[preset] / before->of[preset];
}

}  // namespace seascape
