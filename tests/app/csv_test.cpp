// Points in and results out, as CSV.
#include "app/csv.h"

#include <gtest/gtest.h>

#include "engine/error.h"
#include "engine/text.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {

std::string fault_of(std::string_view text) {
  try {
    parse_points(text, "p.csv");
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 1);
    return error.what();
  }
  return "accepted";
}

// Control: reading z from the first cell fails here.
TEST(Csv, ReadsPoints) {
  const auto points = parse_points("x,z\n0,0\n-1.5,2e3\n1e-7,-9999999.5\n", "p.csv");
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[1], glm::dvec2(-1.5, 2000.0));
  EXPECT_EQ(points[2], glm::dvec2(1e-7, -9999999.5));
}

TEST(Csv, SpreadsheetsHabitsAreTakenAsTheyCome) {
  const auto points = parse_points("\xEF\xBB\xBFx, z\r\n 1 ,\t2\r\n3,4", "p.csv");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0], glm::dvec2(1, 2));
  EXPECT_EQ(points[1], glm::dvec2(3, 4));
  EXPECT_EQ(parse_points("x,z\n1,2\n\n\n", "p.csv").size(), 1u);
}

// Control: counting lines from 0 fails here.
TEST(Csv, FaultsNameFileLineValueAndRemedy) {
  const std::pair<std::string_view, const char*> cases[] = {
      {"", "p.csv:1: the header is ''; begin the file with the line x,z"},
      {"x,y\n1,2\n", "p.csv:1: the header is 'x,y'; begin the file with the line x,z"},
      {"1,2\n", "p.csv:1: the header is '1,2'; begin the file with the line x,z"},
      {"x,z,w\n", "p.csv:1: the header is 'x,z,w'; begin the file with the line x,z"},
      {"x,z\n", "p.csv:1: no points after the header; add a line with x,z for each point"},
      {"x,z\n1,2\n3\n", "p.csv:3: '3' does not have two columns; write x,z: two numbers and one comma"},
      {"x,z\n1,2,3\n", "p.csv:2: '1,2,3' does not have two columns; write x,z: two numbers and one comma"},
      {"x,z\n1;2\n", "p.csv:2: '1;2' does not have two columns; write x,z: two numbers and one comma"},
      {"x,z\n1,two\n", "p.csv:2: z: 'two' is not a number; give a number from -10000000 to 10000000 m"},
      {"x,z\nnan,2\n", "p.csv:2: x: 'nan' is not a number; give a number from -10000000 to 10000000 m"},
      {"x,z\n1,inf\n", "p.csv:2: z: 'inf' is not a number; give a number from -10000000 to 10000000 m"},
      {"x,z\n1,\n", "p.csv:2: z: '' is not a number; give a number from -10000000 to 10000000 m"},
      {"x,z\n1e8,0\n", "p.csv:2: x: '1e8' is out of range; give a number from -10000000 to 10000000 m"},
      {"x,z\n1,2\n\n3,4\n", "p.csv:3: an empty line among the points; remove it"},
      {std::string_view("x,z\n1,\0\n", 8),
       "p.csv:2: z: '\\x00' is not a number; give a number from -10000000 to 10000000 m"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(fault_of(text), message);
}

// Control: a limit of one row more fails here.
TEST(Csv, TooManyPointsAreRefused) {
  if (test::sanitized) GTEST_SKIP() << "ten million rows";
  std::string text = "x,z\n";
  for (std::size_t i = 0; i < most_csv_rows; ++i) text += "0,0\n";
  EXPECT_EQ(parse_points(text, "p.csv").size(), most_csv_rows);
  text += "0,0\n";
  EXPECT_EQ(fault_of(text), "p.csv:10000002: more than 10000000 points; split the file");
}

// Control: std::to_string in append_csv_row fails here.
TEST(Csv, RowsReadBackTheSame) {
  const double values[] = {0.1, -1.0 / 3.0, 1e-300, 12345678.9, 0.0};
  std::string row;
  append_csv_row(row, values);
  EXPECT_EQ(row.back(), '\n');
  std::size_t at = 0;
  for (const double value : values) {
    const std::size_t end = row.find_first_of(",\n", at);
    EXPECT_EQ(real_from(std::string_view(row).substr(at, end - at)), value);
    at = end + 1;
  }
  EXPECT_EQ(at, row.size());
}

TEST(Csv, TextCellsAreQuotedWhereNeeded) {
  EXPECT_EQ(csv_cell("storm"), "storm");
  EXPECT_EQ(csv_cell("a,\"b\"\n"), "\"a,\"\"b\"\"\n\"");
}

}  // namespace
}  // namespace seascape
