#include "ocean/mesh/patch_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <set>

#include "engine/error.h"
#include "shaders/shared/near_line.h"
#include "shaders/shared/patch_vertex.h"

namespace seascape {
namespace {

// Vertices transformed per triangle by a first-in first-out cache.
double transforms_per_triangle(const std::vector<std::uint16_t>& indices, std::size_t cache_size) {
  std::deque<std::uint16_t> cache;
  int misses = 0;
  for (const std::uint16_t v : indices) {
    if (std::find(cache.begin(), cache.end(), v) != cache.end()) continue;
    ++misses;
    cache.push_back(v);
    if (cache.size() > cache_size) cache.pop_front();
  }
  return 3.0 * misses / static_cast<double>(indices.size());
}

// Controls seen: one triangle of a quad wound the other way, and the last column left out.
TEST(PatchMesh, CoversEveryQuadWithTwoTrianglesThatFaceUp) {
  for (const int n : {16, 32, 64}) {
    const std::vector<std::uint16_t> indices = patch_indices(n);
    ASSERT_EQ(indices.size(), static_cast<std::size_t>(6 * n * n));
    std::set<std::array<int, 3>> seen;  // quad and whether its lower or upper half
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      std::array<std::array<int, 2>, 3> v{};
      for (std::size_t c = 0; c < 3; ++c) v[c] = {indices[t + c] % (n + 1), indices[t + c] / (n + 1)};
      const int ax = v[1][0] - v[0][0], az = v[1][1] - v[0][1], bx = v[2][0] - v[0][0], bz = v[2][1] - v[0][1];
      EXPECT_EQ(az * bx - ax * bz, 1);  // y of the normal: up, twice the area of half a quad
      const int i = std::min({v[0][0], v[1][0], v[2][0]}), j = std::min({v[0][1], v[1][1], v[2][1]});
      const int sum = v[0][0] + v[1][0] + v[2][0] + v[0][1] + v[1][1] + v[2][1] - 3 * (i + j);
      EXPECT_TRUE(sum == 2 || sum == 4);  // every quad is cut from (i + 1, j) to (i, j + 1)
      seen.insert({i, j, sum});
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(2 * n * n));
  }
}

// Row by row without bands a 64-quad patch measures 1.0 and fails; the bound is 0.5 for an endless grid and cache.
TEST(PatchMesh, KeepsVerticesInASmallCache) {
  for (const int n : {16, 32, 64}) EXPECT_LT(transforms_per_triangle(patch_indices(n), 32), 0.6) << n;
}

// The 16 variants: only the odd vertices of a marked edge move, each onto the even one below it on that edge.
// Control seen: j + (j & 1) in patch_coordinate.
TEST(PatchVertex, SnapsOddVerticesOfMarkedEdgesDown) {
  constexpr int n = gpu::patch_quads, stride = 4;
  for (unsigned mask = 0; mask < 16; ++mask)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        glm::ivec2 want(i, j);
        if ((i == n && (mask & gpu::patch_east) != 0u) || (i == 0 && (mask & gpu::patch_west) != 0u))
          want.y = j / 2 * 2;
        if ((j == n && (mask & gpu::patch_north) != 0u) || (j == 0 && (mask & gpu::patch_south) != 0u))
          want.x = i / 2 * 2;
        const gpu::PatchInstance p{{-100, 36}, stride, mask | (3u << gpu::patch_level_shift)};
        EXPECT_EQ(gpu::patch_coordinate(p, i, j), glm::ivec2(-100, 36) + stride * want) << mask;
      }
}

TEST(PatchMesh, RefusesWhatUint16CannotIndex) {
  EXPECT_NO_THROW(patch_indices(255));
  EXPECT_THROW(patch_indices(256), Error);
  EXPECT_THROW(patch_indices(0), Error);
}

// What looks for triangles at near planes has the same. Control seen: quads cut the other way.
TEST(PatchMesh, TrianglesOfAPatchAreNumberedAsTheyAreDrawn) {
  const std::vector<std::uint16_t> indices = patch_indices(gpu::patch_quads);
  ASSERT_EQ(indices.size(), 3u * gpu::near_triangles);
  for (int t = 0; t < gpu::near_triangles; ++t)
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(gpu::near_corner_numbers(t)[corner], indices[std::size_t(3 * t + corner)]) << t;
}

}  // namespace
}  // namespace seascape
