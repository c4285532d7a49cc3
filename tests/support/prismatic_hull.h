// A hull whose bottom is the same wedge from end to end, as model basins tow it to find how hulls plane.
#pragma once
#include <cmath>

#include "ocean/bodies/hull.h"

namespace seascape::test {

// Along z about the origin, the keel at y = 0; angles in radians.
inline HullMesh prismatic_hull(double length_m, double beam_m, double deadrise, double side_m, int parts = 24) {
  HullMesh soup;
  const double half = 0.5 * beam_m, chine = half * std::tan(deadrise);
  const auto point = [&](int i, int k) {
    const double z = length_m * (double(i) / parts - 0.5);
    const glm::dvec3 ring[5] = {
        {-half, chine + side_m, z}, {-half, chine, z}, {0.0, 0.0, z}, {half, chine, z}, {half, chine + side_m, z}};
    return ring[k % 5];
  };
  const auto triangle = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto n = std::uint32_t(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), {a, b, c});
    soup.triangles.push_back({n, n + 1, n + 2});
  };
  for (int i = 0; i < parts; ++i)
    for (int k = 0; k < 5; ++k) {
      triangle(point(i, k), point(i + 1, k + 1), point(i + 1, k));
      triangle(point(i, k), point(i, k + 1), point(i + 1, k + 1));
    }
  for (int k = 1; k < 4; ++k) {
    triangle(point(0, 0), point(0, k + 1), point(0, k));
    triangle(point(parts, 0), point(parts, k), point(parts, k + 1));
  }
  return welded(soup);
}

}  // namespace seascape::test
