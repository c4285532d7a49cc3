#include "app/quality.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {

// Low and medium are profiles of a standalone headset: tile shape, tiles of waves in half floats. High and ultra are
// for PC VR. Resolution adds oversampling and whole short bands; it never changes a wave that is kept. All have the
// five cascades: without the last, water near the eye is a blur. Low's mesh may miss 8 pixels and asks for 5: of more
// it gains little time (seascape lab --curve frame; docs/accuracy.md). Ultra's may miss 1 and asks for 0.9: of the
// largest of 200 poses one in sixteen passed its pixel, by a tenth. Low has shadows, if coarse ones: without them the
// sun shines into a diving bell through its roof.
constexpr PresetRow rows[] = {
    // key                   low      medium   high       ultra
    {"waves.resolution", "256", "256", "256", "512"},
    {"waves.cascades", "5", "5", "5", "5"},
    {"waves.half_storage", "true", "true", "false", "false"},
    {"foam.resolution", "128", "128", "256", "256"},
    {"spray.most", "2000", "4000", "6000", "8000"},
    {"models.detail", "0.5", "0.5", "1", "1.5"},
    {"models.seen_in_water", "true", "true", "true", "true"},
    {"place.resolution", "128", "128", "256", "256"},
    {"lod.patch_quads", "16", "32", "64", "64"},
    {"lod.by", "pixel_error", "pixel_error", "pixel_error", "pixel_error"},
    {"lod.pixel_error", "5", "4", "2", "0.9"},
    {"lod.threshold", "2.0", "1.5", "1.2", "1.0"},
    {"lod.cull_scale", "1.2", "1.5", "1.8", "2.0"},
    {"water.anisotropy", "2", "4", "8", "16"},
    {"models.shadow_texels", "1024", "2048", "2048", "4096"},
    {"models.shadow_reach_m", "25", "25", "60", "80"},
    {"frame.shape", "tile", "tile", "auto", "auto"},
    {"msaa", "4", "4", "4", "4"},
};

constexpr std::array<std::string_view, 4> names{"low", "medium", "high", "ultra"};

}  // namespace

std::span<const PresetRow> preset_rows() { return rows; }

std::span<const std::string_view> preset_names() { return names; }

std::string_view resolve_preset(std::string_view preset, DeviceClass device) {
  if (preset != "auto") return preset;
  switch (device) {
    case DeviceClass::software:
      return "medium";
    case DeviceClass::integrated:
      return "high";
    case DeviceClass::discrete:
      return "ultra";
  }
  return "high";
}

void suit_device(Settings& settings, std::string_view preset, DeviceClass device) {
  Settings of_preset;
  apply_preset(of_preset, preset);
  if (device == DeviceClass::software && settings.render.msaa == of_preset.render.msaa) settings.render.msaa = 1;
}

void lower_samples(Settings& settings, std::string_view preset, DeviceClass device, int samples) {
  Settings of_preset;
  apply_preset(of_preset, preset);
  suit_device(of_preset, preset, device);
  if (settings.render.msaa == of_preset.render.msaa) settings.render.msaa = std::min(samples, settings.render.msaa);
}

std::size_t preset_index(std::string_view preset) {
  const auto found = std::find(names.begin(), names.end(), preset);
  if (found == names.end()) throw std::invalid_argument("no preset: " + std::string(preset));
  return std::size_t(found - names.begin());
}

std::string presets_with(std::initializer_list<std::pair<std::string_view, std::string_view>> values) {
  std::string found;
  for (const std::string_view preset : names) {
    Settings settings;
    apply_preset(settings, preset);
    const auto has = [&](const auto& value) {
      return value_text(settings, *find_setting(value.first)) == value.second;
    };
    if (std::all_of(values.begin(), values.end(), has)) found += (found.empty() ? "" : " ") + std::string(preset);
  }
  return found;
}

void apply_preset(Settings& settings, std::string_view preset) {
  std::string_view PresetRow::*column = nullptr;
  if (preset == "low") column = &PresetRow::low;
  if (preset == "medium") column = &PresetRow::medium;
  if (preset == "high" || preset == "auto") column = &PresetRow::high;
  if (preset == "ultra") column = &PresetRow::ultra;
  if (column == nullptr)
    throw Error("--preset", "unknown preset " + in_quotes(preset) + did_you_mean(preset, names),
                "take " + listed(names) + ", or auto", 2);
  Settings changed = settings;
  for (const PresetRow& row : rows) set_from_text(changed, row.key, row.*column, "preset " + std::string(preset));
  settings = changed;
}

}  // namespace seascape
