// What is known of a scene before it is loaded: how long presets take in it, and what they lose.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "app/adaptive/loading_levers.h"
#include "app/calibration.h"
#include "app/preset_costs.h"

namespace seascape {

// Where all presets up to the finest are calibrated, times are this device's for a frame of so many megapixels; else
// they are those of the table, whose ratios serve another device too. Errors are the table's. A scene that the table
// lacks is taken for the open sea; nothing without that.
std::optional<LoadingRange> loading_range(std::span<const PresetCosts> costs, std::string_view scene,
                                          const Calibration& calibration, double megapixels, std::size_t finest_preset,
                                          int samples);

// How many times as long as in `from` frames take in `to`, at a preset; 1 where the table lacks one of them.
double scene_ratio(std::span<const PresetCosts> costs, std::string_view from, std::string_view to, std::size_t preset);

}  // namespace seascape
