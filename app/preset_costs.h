// What the quality presets set and what they cost, in one table for docs, panel and plan. The costs are measured by
// `seascape plan --presets` and kept in content/presets.csv.
#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seascape {

// One figure of a scene, from low to ultra.
struct PresetCost {
  std::string what, unit;  // "GPU: surface", "ms"
  std::array<double, 4> of{};
};

// Rows that others look for.
inline constexpr std::string_view error_row = "error against the finest, mean FLIP", gpu_row = "GPU",
                                  frame_row = "frame, CPU and GPU one after the other";

// One scene, its presets measured in turn.
struct PresetCosts {
  std::string scene, device, date;
  int width = 0, height = 0;  // pixels of one eye
  int views = 1;
  int frames = 0;  // of each preset
  std::vector<PresetCost> rows;
};

// "scene,device,date,width,height,views,frames,what,unit,low,medium,high,ultra", a row a figure.
std::string preset_costs_csv(std::span<const PresetCosts> all);
// Reads what preset_costs_csv() writes. Throws Error("WHERE:LINE", ...).
std::vector<PresetCosts> parse_preset_costs(std::string_view text, const std::string& where);
// Of content/presets.csv; none where there is no such file. Throws Error where it is no such file.
std::vector<PresetCosts> shipped_preset_costs();

// Null where the scene was not measured.
const PresetCosts* costs_of(std::span<const PresetCosts> all, std::string_view scene);
// Null where it has no such row.
const PresetCost* row_of(const PresetCosts& costs, std::string_view what);
// Puts a scene's costs in place of its older ones, or after the others.
void put(std::vector<PresetCosts>& all, PresetCosts costs);

// A row of the table, as it is printed.
struct PresetLine {
  std::string what;  // a setting's key, or "GPU: surface, ms"
  std::array<std::string, 4> of;
};
std::vector<PresetLine> setting_lines();
std::vector<PresetLine> cost_lines(const PresetCosts& costs);
// "open_sea, 480x504 pixels an eye, 2 eyes, medians of 24 frames, llvmpipe, 2026-11-28".
std::string measured_how(const PresetCosts& costs);

// docs/presets.md: the settings, then the costs of each scene.
std::string presets_document(std::span<const PresetCosts> all);

// The whole table of a scene for a terminal. `costs`: null where the scene was not measured, which it then says.
std::string preset_table(const PresetCosts* costs, std::string_view scene);

}  // namespace seascape
