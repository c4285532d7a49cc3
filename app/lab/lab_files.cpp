#include "app/lab/lab_files.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

#include "app/csv.h"
#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {

constexpr std::string_view header =
    "curve,knob,value,sea,time_us,time_p5_us,time_p95_us,error,error_unit,preset,settings,samples,mode,seed,cpu,device,"
    "driver,build,date";
constexpr std::size_t columns = 19;

// The cells of the line that begins at `at`, which goes on past its end (RFC 4180).
std::vector<std::string> next_row(std::string_view text, std::size_t& at, const std::string& where) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted) {
      if (c != '"')
        cells.back() += c;
      else if (at + 1 < text.size() && text[at + 1] == '"')
        cells.back() += text[at++];
      else
        quoted = false;
    } else if (c == '"' && cells.back().empty()) {
      quoted = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      break;
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  if (quoted) throw Error(where, "a quoted cell does not end", "remove the file, or let seascape lab write it anew");
  at = std::min(at + 1, text.size());
  return cells;
}

double number_from(const std::string& cell, const char* name, double least, const std::string& where) {
  const auto value = real_from(cell);
  if (!value || !std::isfinite(*value) || *value < least)
    throw Error(
        where,
        fmt::format("{} is {}, not a finite number{}", name, in_quotes(cell), least == 0.0 ? " of 0 or more" : ""),
        "remove the file, or let seascape lab write it anew");
  return *value;
}

}  // namespace

std::string curves_csv(const std::vector<LabPoint>& points, const LabOrigin& origin) {
  std::string text(header);
  text += '\n';
  const Machine& m = origin.machine;
  const std::string end =
      fmt::format("{},{},{},{},{},{},{}\n", origin.quick ? "quick" : "full", m.seed, csv_cell(m.cpu),
                  csv_cell(m.device), csv_cell(m.driver), csv_cell(m.build), csv_cell(m.date));
  for (const LabPoint& p : points)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{},{}", csv_cell(p.curve),
                   csv_cell(p.knob), text_from(p.value), csv_cell(p.sea), text_from(p.time_us.median),
                   text_from(p.time_us.p5), text_from(p.time_us.p95), text_from(p.error.value), csv_cell(p.error.unit),
                   csv_cell(p.preset), csv_cell(p.settings), p.time_us.count, end);
  return text;
}

LabRows parse_curves_csv(std::string_view text, const std::string& where) {
  LabRows rows;
  std::size_t at = 0;
  for (int line = 1; at < text.size(); ++line) {
    const std::string here = where + ":" + std::to_string(line);
    const std::size_t begin = at;
    const std::vector<std::string> cells = next_row(text, at, here);
    if (line == 1) {
      std::string_view first = text.substr(begin, text.find_first_of("\r\n", begin) - begin);
      if (first != header)
        throw Error(here, "the header is not that of curves.csv", "remove the file, or let seascape lab write it anew");
      continue;
    }
    if (cells.size() != columns)
      throw Error(here, fmt::format("{} cells where there are {}", cells.size(), columns),
                  "remove the file, or let seascape lab write it anew");
    LabPoint p;
    p.curve = cells[0], p.knob = cells[1], p.sea = cells[3], p.error.unit = cells[8], p.preset = cells[9],
    p.settings = cells[10];
    p.value = number_from(cells[2], "value", -1e300, here);
    p.time_us.median = number_from(cells[4], "time_us", 0.0, here);
    p.time_us.p5 = number_from(cells[5], "time_p5_us", 0.0, here);
    p.time_us.p95 = number_from(cells[6], "time_p95_us", 0.0, here);
    p.error.value = number_from(cells[7], "error", 0.0, here);
    p.time_us.count = std::size_t(std::min(number_from(cells[11], "samples", 0.0, here), 1e9));
    if (cells[12] != "quick" && cells[12] != "full")
      throw Error(here, "mode is " + in_quotes(cells[12]), "it is quick or full");
    if (rows.points.empty()) {
      rows.origin.quick = cells[12] == "quick";
      Machine& m = rows.origin.machine;
      m.seed = std::uint64_t(std::min(number_from(cells[13], "seed", 0.0, here), 4294967295.0));
      m.cpu = cells[14], m.device = cells[15], m.driver = cells[16], m.build = cells[17], m.date = cells[18];
    }
    rows.points.push_back(std::move(p));
  }
  if (text.empty()) throw Error(where, "the file is empty", "remove it, or let seascape lab write it anew");
  return rows;
}

bool same_origin(const LabOrigin& a, const LabOrigin& b) {
  return a.quick == b.quick && a.machine.seed == b.machine.seed && a.machine.cpu == b.machine.cpu &&
         a.machine.device == b.machine.device && a.machine.driver == b.machine.driver &&
         a.machine.build == b.machine.build;
}

}  // namespace seascape
