// The levers that move while a scene loads, because they rebuild images and pipelines: the preset, and samples a pixel.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "app/adaptive/lever.h"

namespace seascape {

// What a scene may be loaded with. Presets by their number, 0 low to 3 ultra.
struct LoadingRange {
  std::size_t finest_preset = 0;                      // the most there is
  std::array<double, 4> preset_ms{}, preset_error{};  // of a frame; mean FLIP
  int samples = 1;                                    // of the finest preset; 1: there is nothing to lower
};

// What it is loaded with.
struct LoadedWith {
  std::size_t preset = 0;
  int samples = 1;
  bool operator==(const LoadedWith&) const = default;
};

// The lever "preset" from the finest down to low, and "samples" from the most down to 1. A preset that takes longer
// than a finer one, or has less error, counts as that one. Errors of samples are those of `seascape lab --curve
// levers`.
std::vector<Lever> loading_levers(const LoadingRange& range);
// The steps that are nearest to it, into the levels of `levers`.
void set_loaded(std::span<const Lever> levers, const LoadedWith& with, LeverLevels& levels);
// What a scene is loaded with at these levels; nothing where there are no such levers.
std::optional<LoadedWith> loaded_with(std::span<const Lever> levers, const LeverLevels& levels);

}  // namespace seascape
