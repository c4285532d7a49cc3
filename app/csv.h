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

// Reads points: the header "x,z", then one point a line, metres, within 1e7 of the origin. Lines may end in CR LF, a
// byte-order mark and spaces around a value are passed over, and so are empty lines at the end. Throws
// Error("WHERE:LINE",
// ...) for a wrong header, a wrong number of columns, what is not a finite number, an empty line in between, no points
// at all, more than 10 million.
std::vector<glm::dvec2> parse_points(std::string_view text, const std::string& where);

// Adds "a,b,c\n", each number as the shortest text that reads back the same.
void append_csv_row(std::string& text, std::span<const double> values);

// A text cell: in quotes where it holds a comma, a quote or a line break (RFC 4180).
std::string csv_cell(std::string_view text);

}  // namespace seascape
