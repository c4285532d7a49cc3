// The matrix of what effects cost, as CSV and as a picture.
#include "app/cost_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace seascape {
namespace {

CostMatrix sample() {
  CostMatrix m;
  m.scene = "a, \"b\" & <c>";
  m.preset = "low";
  m.device = "a device";
  m.width = 64;
  m.height = 36;
  m.views = 1;
  m.frames = 7;
  m.effects = {"waves", "foam"};
  m.cells = {{"waves", beside_nothing, {{1.5, 2.25, 3.0}, 3 << 20, 1, 0, 9, 2, 1000}},
             {"foam", beside_nothing, {{1.6, 2.5, 3.5}, 3 << 20, 1, 0, 9, 2, 1200}},
             {"foam", "waves", {{-0.1, 0.05, 0.2}, 0, 0, 0, 0, 0, 200}},
             {"waves", beside_all_others, {{-3.0, -2.0, -1.0}, -(1 << 20), 0, 0, 0, 0, 0}}};
  return m;
}

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// Control seen: a bound in the middle's place.
TEST(CostMatrix, IsARowACell) {
  EXPECT_EQ(matrix_csv(sample()),
            "scene,preset,effect,beside,ms,ms_low,ms_high,bytes,passes,draws,dispatches,pipelines,words\n"
            "\"a, \"\"b\"\" & <c>\",low,waves,nothing,2.25,1.5,3,3145728,1,0,9,2,1000\n"
            "\"a, \"\"b\"\" & <c>\",low,foam,nothing,2.5,1.6,3.5,3145728,1,0,9,2,1200\n"
            "\"a, \"\"b\"\" & <c>\",low,foam,waves,0.05,-0.1,0.2,0,0,0,0,0,200\n"
            "\"a, \"\"b\"\" & <c>\",low,waves,all others,-2,-3,-1,-1048576,0,0,0,0,0\n");
}

// Three maps of a cell each, well-formed, with names escaped; what cannot be told from nothing is no number. Controls
// seen: the name not escaped; the interval not asked.
TEST(CostMatrix, IsAPictureOfThreeMaps) {
  const std::string svg = matrix_svg(sample());
  EXPECT_EQ(svg.find("<c>"), std::string::npos);
  EXPECT_EQ(count(svg, "<rect "), 1 + 3 * 4);
  EXPECT_EQ(count(svg, "<text "), count(svg, "</text>"));
  EXPECT_EQ(count(svg, ">–</text>"), 1) << "foam beside waves";
  EXPECT_EQ(count(svg, ">2.25</text>"), 1);
  EXPECT_EQ(count(svg, ">-2.00</text>"), 1);
  EXPECT_EQ(count(svg, ">3.0</text>"), 2);
  EXPECT_EQ(count(svg, ">9</text>"), 2);
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
}

// Without effects, or without costs, there is nothing to divide by.
TEST(CostMatrix, MayBeEmpty) {
  CostMatrix m = sample();
  m.cells.clear();
  EXPECT_EQ(matrix_svg(m).find("nan"), std::string::npos);
  m.effects.clear();
  EXPECT_EQ(matrix_svg(m).find("nan"), std::string::npos);
  m = sample();
  for (CostCell& cell : m.cells) cell.cost = {};
  EXPECT_EQ(matrix_svg(m).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace seascape
