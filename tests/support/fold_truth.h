// What is water and what is air about a surface that folds over itself. Nothing here includes or repeats a line of the
// code it judges.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace truth {

struct Sheet {
  double y;
  int sign;  // 1 where the surface lies as at rest, -1 where it is turned over
};

// In the water: the sheets above do not cancel out.
inline bool in_water(const std::vector<Sheet>& sheets, double y) {
  int winding = 0;
  for (const Sheet& sheet : sheets) winding += sheet.y > y ? sheet.sign : 0;
  return winding != 0;
}

// A trochoid (Gerstner 1804): x = s - b sin(k s), y = a cos(k s), folded where b k > 1. Its sheets over x, each
// bisected between extremes of x.
inline std::vector<Sheet> trochoid_sheets(double a, double b, double k, double x) {
  std::vector<Sheet> sheets;
  const auto at = [&](double s) { return s - b * std::sin(k * s) - x; };
  constexpr int pieces = 3000;
  const double reach = 1.1 * b + 1e-9;
  for (int i = 0; i < pieces; ++i) {
    double low = x - reach + 2.0 * reach * i / pieces, high = x - reach + 2.0 * reach * (i + 1) / pieces;
    const bool rises = at(low) < 0.0;
    if (rises == (at(high) < 0.0)) continue;
    for (int n = 0; n < 60; ++n) ((at(0.5 * (low + high)) < 0.0) == rises ? low : high) = 0.5 * (low + high);
    sheets.push_back({a * std::cos(k * low), rises ? 1 : -1});
  }
  return sheets;
}

struct Point3 {
  double x, y, z;
};

// The sheets over (x, z) of any surface: where `stands` has the rest positions about there, `reach` away at most, on a
// raster of `step`, as triangles in the plane.
inline std::vector<Sheet> raster_sheets(const std::function<Point3(double, double)>& stands, double x, double z,
                                        double reach, double step) {
  std::vector<Sheet> sheets;
  const int n = int(std::ceil(2.0 * reach / step)) + 1;
  std::vector<Point3> row(std::size_t(n), Point3{}), next(std::size_t(n), Point3{});
  const auto triangle = [&](const Point3& a, const Point3& b, const Point3& c) {
    const double ab = (a.x - x) * (b.z - z) - (a.z - z) * (b.x - x), bc = (b.x - x) * (c.z - z) - (b.z - z) * (c.x - x),
                 ca = (c.x - x) * (a.z - z) - (c.z - z) * (a.x - x);
    if ((ab >= 0.0) != (bc >= 0.0) || (bc >= 0.0) != (ca >= 0.0)) return;
    sheets.push_back({(bc * a.y + ca * b.y + ab * c.y) / (ab + bc + ca), ab >= 0.0 ? 1 : -1});
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) next[std::size_t(i)] = stands(x - reach + step * i, z - reach + step * j);
    for (std::size_t i = 0; j > 0 && i + 1 < std::size_t(n); ++i) {
      triangle(row[i], row[i + 1], next[i + 1]);
      triangle(row[i], next[i + 1], next[i]);
    }
    std::swap(row, next);
  }
  return sheets;
}

}  // namespace truth
