#include "app/cost_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "app/csv.h"
#include "app/svg.h"
#include "engine/text.h"

namespace seascape {

namespace {

constexpr double cell_width = 86.0, cell_height = 30.0, names_width = 130.0, title_height = 34.0, heads_height = 22.0,
                 gap = 26.0;

const CostCell* cell_of(const CostMatrix& matrix, const std::string& effect, const std::string& beside) {
  const auto found = std::find_if(matrix.cells.begin(), matrix.cells.end(),
                                  [&](const CostCell& c) { return c.effect == effect && c.beside == beside; });
  return found == matrix.cells.end() ? nullptr : &*found;
}

// From white to the blue of deep water, `share` from 0 to 1; of what is less than nothing to a sand's yellow.
std::string shade(double share) {
  const double s = std::clamp(std::abs(share), 0.0, 1.0);
  const double to[3] = {share < 0.0 ? 214.0 : 11.0, share < 0.0 ? 168.0 : 83.0, share < 0.0 ? 60.0 : 135.0};
  return fmt::format("#{:02x}{:02x}{:02x}", int(255.0 + s * (to[0] - 255.0)), int(255.0 + s * (to[1] - 255.0)),
                     int(255.0 + s * (to[2] - 255.0)));
}

// To 0.1 us.
std::string rounded(double ms) { return text_from(std::round(1e4 * ms) / 1e4); }

// One number of each cell, nothing where it cannot be told from none.
struct Map {
  std::string title;
  int digits;
  std::function<std::optional<double>(const Cost&)> value;
};

std::string text_at(double x, double y, const char* anchor, const std::string& text, const char* fill = "#1b2b34") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", x, y, anchor, fill,
                     html_escaped(text));
}

std::string heat_map(const CostMatrix& matrix, const Map& map, const std::vector<std::string>& columns, double top) {
  double most = 0.0;
  for (const CostCell& cell : matrix.cells) most = std::max(most, std::abs(map.value(cell.cost).value_or(0.0)));
  std::string text = text_at(0.0, top + 20.0, "start", map.title);
  for (std::size_t c = 0; c < columns.size(); ++c)
    text += text_at(names_width + cell_width * (double(c) + 0.5), top + title_height + 14.0, "middle", columns[c]);
  for (std::size_t r = 0; r < matrix.effects.size(); ++r) {
    const double y = top + title_height + heads_height + cell_height * double(r);
    text += text_at(names_width - 8.0, y + 20.0, "end", matrix.effects[r]);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const CostCell* cell = cell_of(matrix, matrix.effects[r], columns[c]);
      if (cell == nullptr) continue;
      const std::optional<double> value = map.value(cell->cost);
      const double share = most > 0.0 ? value.value_or(0.0) / most : 0.0, x = names_width + cell_width * double(c);
      text += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" stroke=\"#ffffff\"/>\n", x, y,
          cell_width, cell_height, shade(share));
      text +=
          text_at(x + 0.5 * cell_width, y + 20.0, "middle", value ? fmt::format("{:.{}f}", *value, map.digits) : "–",
                  std::abs(share) > 0.55 ? "#ffffff" : "#1b2b34");
    }
  }
  return text;
}

}  // namespace

std::string matrix_csv(const CostMatrix& matrix) {
  std::string text = "scene,preset,effect,beside,ms,ms_low,ms_high,bytes,passes,draws,dispatches,pipelines,words\n";
  for (const CostCell& cell : matrix.cells) {
    const Cost& c = cell.cost;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(matrix.scene), matrix.preset, cell.effect,
                        cell.beside, rounded(c.ms.middle), rounded(c.ms.low), rounded(c.ms.high), c.bytes, c.passes,
                        c.draws, c.dispatches, c.pipelines, c.words);
  }
  return text;
}

std::string matrix_svg(const CostMatrix& matrix) {
  std::vector<std::string> columns{beside_nothing};
  columns.insert(columns.end(), matrix.effects.begin(), matrix.effects.end());
  columns.emplace_back(beside_all_others);
  const Map maps[] = {
      {"Milliseconds a frame", 2,
       [](const Cost& c) {
         return c.ms.low > 0.0 || c.ms.high < 0.0 ? std::optional<double>(c.ms.middle) : std::nullopt;
       }},
      {"Device memory, MiB", 1,
       [](const Cost& c) { return std::optional<double>(double(c.bytes) / (1024.0 * 1024.0)); }},
      {"Dispatches a frame", 0, [](const Cost& c) { return std::optional<double>(double(c.dispatches)); }},
  };
  const double map_height = title_height + heads_height + cell_height * double(matrix.effects.size()) + gap;
  const double width = std::max(names_width + cell_width * double(columns.size()), 640.0), head = 56.0,
               height = head + map_height * double(std::size(maps));
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#ffffff\"/>\n",
      width, height, width, height);
  text += text_at(0.0, 18.0, "start",
                  fmt::format("What an effect (row) adds to a frame beside another (column): {} at {}", matrix.scene,
                              matrix.preset));
  text +=
      text_at(0.0, 38.0, "start",
              fmt::format("{}, {} x {} pixels, {} view{}, {} frames of either in turn; – : no difference could be told",
                          matrix.device, matrix.width, matrix.height, matrix.views, matrix.views == 1 ? "" : "s",
                          matrix.frames),
              "#5b6b74");
  double top = head;
  for (const Map& map : maps) {
    text += heat_map(matrix, map, columns, top);
    top += map_height;
  }
  return text + "</svg>\n";
}

}  // namespace seascape
