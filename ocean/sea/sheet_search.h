// The search for all sheets of a surface that stand over a place, as water_side() does it.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>

#include "ocean/sea/water_side.h"

namespace seascape {

// Where a vertical line meets the surface.
struct SheetCrossing {
  double height_m;
  int sign;  // 1; -1 where the surface is turned over
};

inline constexpr std::size_t most_sheet_corners = 17;  // that are displaced together

// Rest positions on a lattice about the place, in squares that are quartered as long as what lies in them may stand
// over the place, and then in two triangles each.
template <class Displace>
class SheetSearch {
 public:
  static constexpr int first_squares = int(most_sheet_corners) - 1, deepest = 10;

  // Rest positions up to `reach_m` away, along x and along z, down to squares of `least_m`; `spread`: how far within a
  // square water may stand beside its corners' bounds, of its side. `displace(rests, displacements)`: of as many rest
  // positions as there are displacements (m).
  SheetSearch(const Displace& displace, const glm::dvec2& place, double reach_m, double least_m, double spread)
      : displace_(displace), place_(place), spread_(spread) {
    int halvings = 0;
    for (double side = 2.0 * reach_m / first_squares; side > least_m && halvings < deepest; side *= 0.5) ++halvings;
    const int side = 1 << halvings;
    step_m_ = 2.0 * reach_m / (first_squares * side);
    first_ = place - reach_m;
    std::array<Corner, most_sheet_corners> row, next;
    for (int z = 0; z <= first_squares; ++z, row = next) {
      for (int x = 0; x <= first_squares; ++x) next[std::size_t(x)].at = {x * side, z * side};
      find(next);
      if (z > 0)
        for (std::size_t x = 0; x < first_squares; ++x) square({row[x], row[x + 1], next[x], next[x + 1]}, side);
    }
    std::sort(crossings_.begin(), crossings_.begin() + count_,
              [](const SheetCrossing& a, const SheetCrossing& b) { return a.height_m < b.height_m; });
  }

  int count() const { return count_; }
  const SheetCrossing& operator[](int n) const { return crossings_[std::size_t(n)]; }
  bool whole() const {
    int sum = 0;
    for (int n = 0; n < count_; ++n) sum += crossings_[std::size_t(n)].sign;
    return !too_many_ && sum == 1;
  }

 private:
  struct Corner {
    glm::ivec2 at;   // on the lattice
    glm::dvec2 off;  // where it stands, from the place
    double height_m;
  };

  // Where corners stand: the same numbers for whichever square asks.
  void find(std::span<Corner> corners) const {
    std::array<glm::dvec2, most_sheet_corners> rests;
    std::array<glm::dvec3, most_sheet_corners> shifts;
    for (std::size_t n = 0; n < corners.size(); ++n) rests[n] = first_ + step_m_ * glm::dvec2(corners[n].at);
    displace_(std::span<const glm::dvec2>(rests.data(), corners.size()), std::span(shifts.data(), corners.size()));
    for (std::size_t n = 0; n < corners.size(); ++n) {
      corners[n].off = rests[n] + glm::dvec2(shifts[n].x, shifts[n].z) - place_;
      corners[n].height_m = shifts[n].y;
    }
  }

  // Corners in the order (x, z), (x + 1, z), (x, z + 1), (x + 1, z + 1).
  void square(const std::array<Corner, 4>& c, int side) {
    const glm::dvec2 low = glm::min(glm::min(c[0].off, c[1].off), glm::min(c[2].off, c[3].off));
    const glm::dvec2 high = glm::max(glm::max(c[0].off, c[1].off), glm::max(c[2].off, c[3].off));
    const double grown = side > 1 ? spread_ * side * step_m_ : 0.0;
    if (low.x > grown || low.y > grown || high.x < -grown || high.y < -grown) return;
    if (side == 1) {
      triangle(c[0], c[1], c[3]);
      triangle(c[0], c[3], c[2]);
      return;
    }
    const int half = side / 2;
    std::array<Corner, 5> between;
    auto& [south, west, middle, east, north] = between;
    south.at = c[0].at + glm::ivec2(half, 0), west.at = c[0].at + glm::ivec2(0, half), middle.at = c[0].at + half;
    east.at = c[1].at + glm::ivec2(0, half), north.at = c[2].at + glm::ivec2(half, 0);
    find(between);
    square({c[0], south, west, middle}, half);
    square({south, c[1], middle, east}, half);
    square({west, middle, c[2], north}, half);
    square({middle, east, north, c[3]}, half);
  }

  // Twice the area of the place and an edge: positive where it lies to the edge's left, in the sense of x towards z.
  // Two triangles that share the edge get opposite numbers, and none gets nothing, so that the place lies in one of
  // them.
  static double beside(const Corner& from, const Corner& to) {
    const bool turned = to.at.y < from.at.y || (to.at.y == from.at.y && to.at.x < from.at.x);
    const glm::dvec2 a = turned ? to.off : from.off, b = turned ? from.off : to.off;
    const double area = a.x * b.y - a.y * b.x, kept = area != 0.0 ? area : 1e-300;
    return turned ? -kept : kept;
  }

  void triangle(const Corner& a, const Corner& b, const Corner& c) {
    const double ab = beside(a, b), bc = beside(b, c), ca = beside(c, a);
    if (!((ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0))) return;
    if (count_ == int(crossings_.size())) {
      too_many_ = true;
      return;
    }
    crossings_[std::size_t(count_++)] = {(bc * a.height_m + ca * b.height_m + ab * c.height_m) / (ab + bc + ca),
                                         ab > 0.0 ? 1 : -1};
  }

  const Displace& displace_;
  glm::dvec2 place_, first_{0.0};
  double spread_, step_m_ = 0.0;
  std::array<SheetCrossing, 64> crossings_{};
  int count_ = 0;
  bool too_many_ = false;
};

// The side of a height, of sheets that make a whole.
template <class Displace>
WaterSide side_of(const SheetSearch<Displace>& sheets, double height_m) {
  WaterSide side;
  side.sheets = sheets.count();
  int winding = 0, first_above = 0;
  while (first_above < sheets.count() && !(height_m < sheets[first_above].height_m)) ++first_above;
  for (int n = first_above; n < sheets.count(); ++n) winding += sheets[n].sign;
  side.in_water = winding != 0;
  if (side.in_water) {  // upwards to the first sheet above which is air
    int n = first_above;
    for (; (winding -= sheets[n].sign) != 0; ++n) {
    }
    side.height_m = sheets[n].height_m;
  } else {  // downwards to the first below which is water
    int n = first_above - 1;
    for (; n > 0 && (winding + sheets[n].sign) == 0; --n) winding += sheets[n].sign;
    side.height_m = sheets[std::max(n, 0)].height_m;
  }
  return side;
}

}  // namespace seascape
