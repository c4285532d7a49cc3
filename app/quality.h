// The quality presets as rows of values, and the one that suits a device.
#pragma once
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "app/settings.h"

namespace seascape {

// One quality setting and its value in each preset, from low to ultra, as --set takes it.
struct PresetRow {
  std::string_view key, low, medium, high, ultra;
};

std::span<const PresetRow> preset_rows();
// "low", "medium", "high", "ultra".
std::span<const std::string_view> preset_names();

enum class DeviceClass { software, integrated, discrete };

// What `auto` means on such a device; any other name is returned as it is.
std::string_view resolve_preset(std::string_view preset, DeviceClass device);

// What a preset is otherwise on such a device: on a software driver it takes one sample a pixel, with which the sea is
// lit once a pixel (frame.lighting) in less than half the time; but a scene that asks for another number than the
// preset's keeps it.
void suit_device(Settings& settings, std::string_view preset, DeviceClass device);

// Fewer samples a pixel than the preset has on such a device; but a scene that asks for another number keeps it.
void lower_samples(Settings& settings, std::string_view preset, DeviceClass device, int samples);

// 0 low to 3 ultra. Throws std::invalid_argument for another name.
std::size_t preset_index(std::string_view preset);

// The presets, with spaces between their names, that have all of these values (as --set takes them).
std::string presets_with(std::initializer_list<std::pair<std::string_view, std::string_view>> values);

// Sets every quality setting from the preset's column. "auto" where no device is known (query, validate) is "high".
// Throws Error (exit code 2) for another name.
void apply_preset(Settings& settings, std::string_view preset);

}  // namespace seascape
