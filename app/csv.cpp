#include "app/csv.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {

constexpr double farthest_m = 1e7;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Takes the next line off `rest`, without its end.
std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return trimmed(line);
}

// Splits a line into as many cells as there are; false where it has another number of them.
bool split(std::string_view line, std::span<std::string_view> cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == cells.size())) return false;
    cells[i] = trimmed(line.substr(0, comma));
    line = comma == std::string_view::npos ? std::string_view() : line.substr(comma + 1);
  }
  return true;
}

double coordinate(std::string_view cell, std::string_view column, const std::string& place) {
  const auto number = real_from(cell);
  if (!number || std::abs(*number) > farthest_m)
    throw Error(place,
                std::string(column) + ": " + in_quotes(cell) + (number ? " is out of range" : " is not a number"),
                std::string("give a number from -10000000 to 10000000") + (column.size() == 1 ? " m" : ""));
  return *number;
}

}  // namespace

std::vector<double> parse_table(std::string_view text, const std::string& where,
                                std::span<const std::string_view> columns) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  std::size_t line_number = 1, rows = 0;
  const auto place = [&] { return where + ":" + std::to_string(line_number); };
  std::string names;
  for (const std::string_view column : columns) names += (names.empty() ? "" : ",") + std::string(column);
  const std::string many = columns.size() == 2 ? "two" : std::to_string(columns.size());
  std::vector<std::string_view> cells(columns.size());
  const std::string_view header = next_line(text);
  if (!split(header, cells) || !std::equal(cells.begin(), cells.end(), columns.begin()))
    throw Error(place(), "the header is " + in_quotes(header), "begin the file with the line " + names);
  std::vector<double> numbers;
  std::size_t empty_line = 0;  // the first of the empty lines just before this one
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    ++line_number;
    if (line.empty()) {
      if (empty_line == 0) empty_line = line_number;
      continue;
    }
    if (empty_line != 0)
      throw Error(where + ":" + std::to_string(empty_line), "an empty line among the points", "remove it");
    if (!split(line, cells))
      throw Error(place(), in_quotes(line) + " does not have " + many + " columns",
                  "write " + names + ": " + many + " numbers and " +
                      (columns.size() == 2 ? "one comma" : std::to_string(columns.size() - 1) + " commas"));
    if (rows++ == most_csv_rows)
      throw Error(place(), "more than " + std::to_string(most_csv_rows) + " points", "split the file");
    const std::string here = place();
    for (std::size_t i = 0; i < cells.size(); ++i) numbers.push_back(coordinate(cells[i], columns[i], here));
  }
  if (rows == 0) throw Error(place(), "no points after the header", "add a line with " + names + " for each point");
  return numbers;
}

std::vector<glm::dvec2> parse_points(std::string_view text, const std::string& where) {
  constexpr std::array<std::string_view, 2> columns{"x", "z"};
  const std::vector<double> numbers = parse_table(text, where, columns);
  std::vector<glm::dvec2> points(numbers.size() / 2);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {numbers[2 * i], numbers[2 * i + 1]};
  return points;
}

void append_csv_row(std::string& text, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += ',';
    text += text_from(values[i]);
  }
  text += '\n';
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + "\"";
}

std::vector<std::string> csv_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace seascape
