// Tables of numbers as comma-separated text, the same in every locale.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seascape {

constexpr std::size_t most_csv_rows = 10'000'000;

// Reads a table of lengths and directions: the header with these columns ("x,z"), then a line of as many numbers a row,
// within 1e7. Lines may end in CR LF, a byte-order mark and spaces around a value are passed over, and so are empty
// lines at the end. Gives row after row. Throws Error("WHERE:LINE", ...) for a wrong header, a wrong number of columns,
// what is not a finite number, an empty line in between, no rows at all, more than 10 million.
std::vector<double> parse_table(std::string_view text, const std::string& where,
                                std::span<const std::string_view> columns);

// The same of points: x and z, m.
std::vector<glm::dvec2> parse_points(std::string_view text, const std::string& where);

// Adds "a,b,c\n", each number as the shortest text that reads back the same.
void append_csv_row(std::string& text, std::span<const double> values);

// A text cell: in quotes where it holds a comma, a quote or a line break (RFC 4180).
std::string csv_cell(std::string_view text);

// The cells of a line that is made of such; a quote that is not closed takes the rest of the line.
std::vector<std::string> csv_cells(std::string_view line);

}  // namespace seascape
