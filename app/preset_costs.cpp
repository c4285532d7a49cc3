#include "app/preset_costs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/csv.h"
#include "app/quality.h"
#include "app/scene.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/text.h"

namespace seascape {

namespace {

constexpr std::string_view header = "scene,device,date,width,height,views,frames,what,unit,low,medium,high,ultra";
constexpr std::size_t columns = 13, first_figure = 9;

// Three significant figures, and whole numbers as they are.
std::string figure_text(double value) {
  if (value >= 1000.0 || value == std::floor(value)) return fmt::format("{:.0f}", value);
  return fmt::format("{:.3g}", value);
}

std::string line_of(std::string_view what, const std::array<std::string, 4>& of) {
  return fmt::format("{:<43} {:>11} {:>11} {:>11} {:>11}\n", what, of[0], of[1], of[2], of[3]);
}

}  // namespace

std::string preset_costs_csv(std::span<const PresetCosts> all) {
  std::string text = fmt::format("{}\n", header);
  for (const PresetCosts& costs : all)
    for (const PresetCost& row : costs.rows) {
      text +=
          fmt::format("{},{},{},{},{},{},{},{},{}", csv_cell(costs.scene), csv_cell(costs.device), csv_cell(costs.date),
                      costs.width, costs.height, costs.views, costs.frames, csv_cell(row.what), csv_cell(row.unit));
      for (const double value : row.of) text += fmt::format(",{:.6g}", value);
      text += "\n";
    }
  return text;
}

std::vector<PresetCosts> parse_preset_costs(std::string_view text, const std::string& where) {
  const std::string remedy = "give a file that seascape plan --presets wrote, or a name that is free";
  std::vector<PresetCosts> all;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text = text.substr(std::min(end + 1, text.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const std::string place = fmt::format("{}:{}", where, number);
    if (number == 1) {
      if (line != header) throw Error(place, "has not the columns of presets' costs", remedy);
      continue;
    }
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != columns)
      throw Error(place, fmt::format("has {} cells and not {}", cells.size(), columns), remedy);
    const auto value = [&](std::size_t i, double most) {
      const std::optional<double> read = real_from(cells[i]);
      if (!read || !(*read >= 0.0 && *read <= most))
        throw Error(place, fmt::format("{} is not a number from 0 to {:g}", in_quotes(cells[i]), most), remedy);
      return *read;
    };
    if (all.empty() || all.back().scene != cells[0]) {
      if (costs_of(all, cells[0]) != nullptr)
        throw Error(place, in_quotes(cells[0]) + " has rows in two places", "keep those of one");
      all.push_back({cells[0],
                     cells[1],
                     cells[2],
                     int(value(3, 16384.0)),
                     int(value(4, 16384.0)),
                     int(value(5, 2.0)),
                     int(value(6, 1e6)),
                     {}});
    }
    PresetCost row{cells[7], cells[8], {}};
    for (std::size_t p = 0; p < row.of.size(); ++p) row.of[p] = value(first_figure + p, 1e15);
    all.back().rows.push_back(std::move(row));
  }
  return all;
}

std::vector<PresetCosts> shipped_preset_costs() {
  const std::filesystem::path file = content_directory() / "presets.csv";
  if (!std::filesystem::exists(file)) return {};
  return parse_preset_costs(read_text(file), file.string());
}

const PresetCosts* costs_of(std::span<const PresetCosts> all, std::string_view scene) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const PresetCosts& one) { return one.scene == scene; });
  return found == all.end() ? nullptr : &*found;
}

const PresetCost* row_of(const PresetCosts& costs, std::string_view what) {
  const auto found =
      std::find_if(costs.rows.begin(), costs.rows.end(), [&](const PresetCost& row) { return row.what == what; });
  return found == costs.rows.end() ? nullptr : &*found;
}

void put(std::vector<PresetCosts>& all, PresetCosts costs) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const PresetCosts& one) { return one.scene == costs.scene; });
  if (found == all.end())
    all.push_back(std::move(costs));
  else
    *found = std::move(costs);
}

std::vector<PresetLine> setting_lines() {
  std::vector<PresetLine> lines;
  for (const PresetRow& row : preset_rows())
    lines.push_back({std::string(row.key),
                     {std::string(row.low), std::string(row.medium), std::string(row.high), std::string(row.ultra)}});
  return lines;
}

std::vector<PresetLine> cost_lines(const PresetCosts& costs) {
  std::vector<PresetLine> lines;
  for (const PresetCost& row : costs.rows) {
    PresetLine line{row.unit.empty() ? row.what : fmt::format("{}, {}", row.what, row.unit), {}};
    for (std::size_t p = 0; p < row.of.size(); ++p) line.of[p] = figure_text(row.of[p]);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string measured_how(const PresetCosts& costs) {
  return fmt::format("{}, {}x{} pixels an eye, {}, medians of {} frames, {}, {}", costs.scene, costs.width,
                     costs.height, costs.views == 1 ? "one picture" : "both eyes", costs.frames, costs.device,
                     costs.date);
}

std::string presets_document(std::span<const PresetCosts> all) {
  std::string text =
      "# Quality presets\n\n"
      "Written from the table in `app/quality.cpp` and from `content/presets.csv` by\n"
      "`SEASCAPE_WRITE_DOCS=1 ctest --preset release -R PresetCosts`; a test compares them. `seascape plan` and the "
      "panel\n"
      "print the same table. `seascape plan --scene S --presets content/presets.csv` measures the rows of a scene.\n\n"
      "The presets take turns, frame by frame, along the scene's path at 30 frames a second. On a software driver they "
      "have one\n"
      "sample a pixel. GPU rows are passes, CPU rows are stages of the processor. The error is the mean FLIP "
      "(Andersson "
      "et al.\n"
      "2020) of two views against ultra with 2 x 2 pixels for one and four samples in each. Moved are the bytes that "
      "attachments\n"
      "load and store and that copies move.\n";
  const auto begin = [&](const std::string& title) {
    text += fmt::format("\n## {}\n\n", title) + "| | low | medium | high | ultra |\n|---|---|---|---|---|\n";
  };
  const auto add = [&](const std::string& what, const PresetLine& line) {
    text += fmt::format("| {} | {} |\n", what, fmt::join(line.of, " | "));
  };
  begin("What they set");
  for (const PresetLine& line : setting_lines()) add(fmt::format("`{}`", line.what), line);
  for (const PresetCosts& scene : all) {
    begin(measured_how(scene));
    for (const PresetLine& line : cost_lines(scene)) add(line.what, line);
  }
  return text;
}

std::string preset_table(const PresetCosts* costs, std::string_view scene) {
  const std::span<const std::string_view> names = preset_names();
  std::string text =
      line_of("presets", {std::string(names[0]), std::string(names[1]), std::string(names[2]), std::string(names[3])});
  for (const PresetLine& line : setting_lines()) text += line_of(line.what, line.of);
  if (costs == nullptr)
    return text + fmt::format("no costs are known of {}; seascape plan --scene {} --presets FILE measures them\n",
                              scene, scene);
  text += measured_how(*costs) + ":\n";
  for (const PresetLine& line : cost_lines(*costs)) text += line_of(line.what, line.of);
  return text;
}

}  // namespace seascape
