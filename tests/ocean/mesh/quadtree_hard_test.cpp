// The quadtree's hard cases: 19 to 22, 15 and altitude. Everything is counted in whole numbers.
#include "ocean/mesh/quadtree.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <unordered_set>
#include <vector>

#include "tests/ocean/mesh/lod_support.h"

namespace seascape {
namespace {
using namespace lod_test;

// The leaves as squares of the root's grid of their own size. Faults: squares off their grid or that lie in another or
// twice (overlaps); root not filled by squares that do not overlap (holes: by whole finest cells); leaves beside the
// middle of whose side, or either half of it, lies no leaf of half, the same or twice the size (unbalanced); edge bits
// that do not say whether that one is larger. All of it from corner and stride alone, in whole numbers: what a raster
// of the finest cells would show.
struct TilingFaults {
  std::int64_t holes = 0;
  int overlaps = 0, unbalanced = 0, wrong_edges = 0;
  bool operator==(const TilingFaults&) const = default;
};

TilingFaults tiling_faults(const SurfaceSelection& s) {
  constexpr int quads = gpu::patch_quads;
  TilingFaults faults;
  const int root = s.half_size * 2;
  const glm::ivec2 least = s.mesh.tree_centre - s.half_size;
  std::unordered_set<std::uint64_t> leaves;
  // The square of `size` that holds a point, as a key: sizes are powers of two from 8 on, so that the lowest bit tells
  // them.
  const auto key = [](int x, int z, int size) {
    const auto at = [size](int v) { return static_cast<std::uint64_t>((v & ~(size - 1)) | (size >> 1)); };
    return at(x) << 32 | at(z);
  };
  std::int64_t area = 0;
  for (const auto& p : s.patches) {
    if (is_skirt(p)) continue;
    const int size = p.stride * quads;
    const glm::ivec2 at = p.corner - least;
    const bool on_grid = std::has_single_bit(static_cast<unsigned>(p.stride)) && at % size == glm::ivec2(0) &&
                         at.x >= 0 && at.y >= 0 && at.x + size <= root && at.y + size <= root;
    if (!on_grid || !leaves.insert(key(at.x, at.y, size)).second) ++faults.overlaps;
    area += static_cast<std::int64_t>(size) * size;
  }
  faults.holes = static_cast<std::int64_t>(root) * root - area;  // where nothing overlaps
  // The size of the leaf at a cell, of the sizes asked only; 0: none of them.
  const auto leaf_at = [&](int x, int z, int from, int to) {
    for (int size = from; size <= to; size *= 2)
      if (leaves.contains(key(x, z, size))) return size;
    return 0;
  };
  for (const auto& p : s.patches) {
    if (is_skirt(p)) continue;
    const int size = p.stride * quads, half = size / 2;
    const glm::ivec2 at = p.corner - least;
    if (leaf_at(at.x, at.y, size * 2, root) != 0) ++faults.overlaps;
    const struct {
      unsigned bit;
      glm::ivec2 first, along;  // a cell beside the near end of the side, and from there to the half after it
    } sides[] = {{gpu::patch_east, at + glm::ivec2(size, 0), {0, half}},
                 {gpu::patch_north, at + glm::ivec2(0, size), {half, 0}},
                 {gpu::patch_west, at - glm::ivec2(1, 0), {0, half}},
                 {gpu::patch_south, at - glm::ivec2(0, 1), {half, 0}}};
    for (const auto& side : sides)
      for (int n = 0; n < 2; ++n) {
        const glm::ivec2 c = side.first + side.along * n;
        const bool outside = c.x < 0 || c.y < 0 || c.x >= root || c.y >= root;
        const int neighbour = outside ? size : leaf_at(c.x, c.y, std::max(half, quads), std::min(size * 2, root));
        if (neighbour == 0) ++faults.unbalanced;
        // Where vertices slide there are no edge bits.
        if ((neighbour > size && s.mesh.morph.last_stride == 0) != ((p.flags & side.bit) != 0u)) ++faults.wrong_edges;
      }
  }
  return faults;
}

void expect_watertight(const SurfaceSelection& s, const std::string& what) {
  const Topology t = topology_of(s);
  EXPECT_EQ(t.open_edges, 0) << what;
  EXPECT_EQ(t.crowded_edges, 0) << what;
  EXPECT_EQ(t.folded, 0) << what;
  const double area = 8.0 * s.half_size * static_cast<double>(s.half_size);
  EXPECT_NEAR(t.twice_area, area, 1e-9 * area) << what;
}

constexpr std::array<double, 6> sizes{256.0, 777.7, 1024.0, 2000.0, 4096.0, 8192.0};

// Hard case 21 and the 2:1 balance, over presets, sizes and 60 viewpoints each (24 cases, 1,440 selections).
// Controls seen: balance() left out or blind to +x (unbalanced), coarser_edges() returning 0 (wrong edges); and below,
// a dropped patch is a hole.
TEST(QuadtreeHard, hard_21_ocean_sizes_tile_the_root_once_and_balanced) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const Preset& preset : presets)
    for (const double size : sizes) {
      Quadtree tree(settings_of(preset, size));
      for (int n = 0; n < 60; ++n) {
        const glm::dvec3 eye(unit(random) * 3000.0, std::pow(10.0, 1.8 + 2.5 * unit(random)), unit(random) * 3000.0);
        ASSERT_EQ(tiling_faults(tree.select(everything_from(eye), {0.8, 0.6})), TilingFaults{})
            << preset.name << ' ' << size << " at " << eye.x << ' ' << eye.y << ' ' << eye.z;
      }
    }
}

// Every depth and the extreme thresholds, where the split nodes spread farthest.
TEST(QuadtreeHard, EveryDepthAndThresholdIsBalanced) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int levels = 1; levels <= Quadtree::max_square_levels; ++levels)
    for (const double threshold : {0.5, 1.0, 4.0}) {
      LodSettings settings;
      settings.levels = levels;
      settings.threshold = threshold;
      settings.patch_quads = 16;
      Quadtree tree(settings);
      ASSERT_EQ(tree.levels(), levels + 2);  // of patches, four a side in a square of 16 quads
      for (int n = 0; n < (levels > 9 ? 2 : 20); ++n)
        ASSERT_EQ(tiling_faults(tree.select(everything_from({unit(random) * 900.0, 1.0, unit(random) * 900.0}), {})),
                  TilingFaults{})
            << levels << ' ' << threshold;
    }
}

// No leaf is coarser than the threshold asks for. Control seen: find_splits looking one cell too few to one side.
TEST(QuadtreeHard, EveryLeafIsAsFineAsTheThresholdAsks) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const Preset& preset : presets)
    for (const double size : {256.0, 4096.0}) {
      Quadtree tree(by_threshold(settings_of(preset, size)));
      for (int n = 0; n < 20; ++n) {
        const glm::dvec3 eye(unit(random) * 900.0, std::pow(10.0, 1.8 + 2.5 * unit(random)), unit(random) * 900.0);
        const SurfaceSelection& s = tree.select(everything_from(eye), {0.5, 0.5});
        const double gap_y = std::max(eye.y - 0.5, 0.0);
        for (const auto& p : s.patches) {
          if (is_skirt(p) || p.stride == 1) continue;
          const int side = p.stride * gpu::patch_quads;
          const glm::dvec2 gap(glm::max(glm::max(p.corner, -(p.corner + side)), glm::ivec2(0)));
          const double distance = std::hypot(gap.x * s.unit_m, gap.y * s.unit_m, gap_y);
          // Unless all that the water moves there is less than what such a mesh would miss.
          const double spacing = spacing_over_distance(tree.settings()) * distance;
          if (0.5 <= Quadtree::error_over_spacing * spacing) continue;
          ASSERT_LE(p.stride * s.unit_m, spacing * 1.000001) << preset.name << ' ' << size;
        }
      }
    }
}

TEST(QuadtreeHard, TheTilingSeesADroppedPatch) {
  LodSettings settings;
  settings.drop_patch = 3;
  EXPECT_GT(tiling_faults(Quadtree(settings).select(everything_from({0.0, 1.7, 0.0}), {})).holes, 0);
}

// The complete mesh, skirt included: every edge belongs to exactly two triangles that run along it in opposite
// directions, or is on the skirt's outer border. Controls seen: coarser_edges() returning 0 (open edges), the strips of
// one side run the other way (crowded edges), and a dropped patch, next test.
TEST(QuadtreeHard, TheWholeMeshIsWatertight) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const Preset& preset : presets)
    for (const double size : {256.0, 1024.0, 8192.0}) {
      Quadtree tree(settings_of(preset, size));
      for (int n = 0; n < (preset.patch_quads == 64 ? 2 : 6); ++n) {
        const glm::dvec3 eye(unit(random) * 3000.0, std::pow(10.0, 1.8 + 2.5 * unit(random)), unit(random) * 3000.0);
        expect_watertight(tree.select(everything_from(eye), {}), preset.name);
      }
    }
}

TEST(QuadtreeHard, ADroppedPatchOrStripOpensTheMesh) {
  LodSettings settings = settings_of(presets[0], 1024.0);
  const int patches = static_cast<int>(Quadtree(settings).select(everything_from({3.0, 1.7, 5.0}), {}).patches.size());
  for (int drop = 0; drop < patches; ++drop) {
    settings.drop_patch = drop;
    EXPECT_GE(topology_of(Quadtree(settings).select(everything_from({3.0, 1.7, 5.0}), {})).open_edges,
              3 * gpu::patch_quads)
        << drop;
  }
}

// Where two sides meet, the corner's vertices are the same numbers on the same ray, row for row; row 0 is the patch's.
// Positions are computed as the vertex shader computes them. Control seen: row 0 with scale 1.0001 fails the joint.
TEST(QuadtreeHard, SkirtJoinsItsPatchesAndItselfBitForBit) {
  for (const Preset& preset : presets) {
    Quadtree tree(settings_of(preset, 4096.0));
    const SurfaceSelection& s = tree.select(everything_from({123.4, 1.7, -987.6}), {});
    constexpr int n = gpu::patch_quads;
    std::map<std::pair<int, int>, int> border;  // border vertices of the tree's patches
    for (const auto& p : s.patches)
      if (!is_skirt(p))
        for (int j = 0; j <= n; ++j)
          for (int i = 0; i <= n; ++i) {
            const glm::ivec2 c = gpu::patch_coordinate(p, i, j);
            const glm::ivec2 d = glm::abs(c - s.mesh.tree_centre);
            if (std::max(d.x, d.y) == s.half_size) border[{c.x, c.y}] = 0;
          }
    std::map<std::array<int, 3>, glm::vec2> places;  // by border vertex and row: also where bands meet
    std::map<std::array<int, 3>, int> columns;       // by border vertex and band
    int joints = 0, corners = 0;
    for (const auto& p : s.patches) {
      if (!is_skirt(p)) continue;
      for (int i = 0; i <= n; ++i) {
        const glm::ivec2 c = gpu::patch_coordinate(p, i, 0);
        ASSERT_TRUE(border.contains({c.x, c.y}));
        ++border[{c.x, c.y}];
        for (int j = 0; j <= n; ++j) {
          const int row = gpu::patch_skirt_row(p, j);
          const glm::vec2 place = gpu::patch_vertex(p, i, j, s.mesh);
          if (row == 0) {
            EXPECT_EQ(place, glm::vec2(c));
          }
          EXPECT_EQ(places.try_emplace({c.x, c.y, row}, place).first->second, place);
        }
        if (++columns[{c.x, c.y, gpu::patch_skirt_row(p, 0)}] == 1) continue;
        ++joints;
        if (std::abs(c.x - s.mesh.tree_centre.x) == std::abs(c.y - s.mesh.tree_centre.y)) ++corners;
      }
    }
    for (const auto& [c, uses] : border) EXPECT_GE(uses, 1) << c.first << ' ' << c.second;
    EXPECT_EQ(joints, s.skirt_strips);  // a ring of strips has as many joints as strips
    EXPECT_EQ(corners, 4 * s.mesh.skirt_rows / n);
  }
}

// The skirt faces up on all four sides. Control seen: one side's direction of i turned round.
TEST(QuadtreeHard, SkirtTrianglesFaceUp) {
  for (const Preset& preset : presets) {
    Quadtree tree(settings_of(preset, 1024.0));
    const SurfaceSelection& s = tree.select(everything_from({5.0, 1.7, 6.0}), {});
    const std::vector<std::uint16_t> indices = patch_indices(gpu::patch_quads);
    std::array<int, 4> strips{};
    for (const auto& p : s.patches) {
      if (!is_skirt(p)) continue;
      ++strips[side_of(p)];
      for (std::size_t t = 0; t < indices.size(); t += 3) {
        std::array<glm::dvec2, 3> v;
        for (std::size_t c = 0; c < 3; ++c)
          v[c] = gpu::patch_vertex(p, indices[t + c] % (gpu::patch_quads + 1), indices[t + c] / (gpu::patch_quads + 1),
                                   s.mesh);
        const glm::dvec2 a = v[1] - v[0], b = v[2] - v[0];
        ASSERT_GT(a.y * b.x - a.x * b.y, 0.0) << preset.name << " side " << side_of(p);
      }
    }
    for (const int count : strips) EXPECT_GE(count, 1);
  }
}

// Hard case 19: the viewer exactly on corners of the tree, of every level: 2:1 balance, no hole, no patch twice.
// Controls: those of hard_21 above, and TheTilingSeesADroppedPatch.
TEST(QuadtreeHard, hard_19_quadtree_corner) {
  for (const Preset& preset : presets) {
    Quadtree tree(settings_of(preset, 1024.0));
    for (int level = 0; level <= tree.levels(); ++level)
      for (const glm::dvec2 at : {glm::dvec2(0.0), glm::dvec2(1.0, 0.0), glm::dvec2(1.0, 1.0), glm::dvec2(-3.0, 2.0)}) {
        const double node = 1024.0 / (1 << level);
        const SurfaceSelection& s = tree.select(everything_from({at.x * node, 1.7, at.y * node}), {});
        ASSERT_EQ(tiling_faults(s), TilingFaults{}) << preset.name << " level " << level;
        if (preset.patch_quads == 16) expect_watertight(s, preset.name);
      }
  }
}

// Hard case 20: a viewer that trembles by 1e-6 m about a corner or halfway between two snapped centres of the tree.
// Control seen: floor instead of the nearest grid point; and in the test, a tremble of 0.3 m.
TEST(QuadtreeHard, hard_20_jitter) {
  const auto flips = [](const Preset& preset, double amplitude_m) {
    Quadtree tree(settings_of(preset, 4096.0));
    std::mt19937 random(20);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int changed = 0;
    for (const double place : {0.0, 8.0, 16.0, 32.0, 64.0, 128.0, -8.0, 1e6}) {
      const SurfaceSelection first = tree.select(everything_from({place, 1.7, place}), {0.8, 0.6});
      for (int n = 0; n < 50; ++n) {
        const glm::dvec3 off(unit(random), unit(random), unit(random));
        const SurfaceSelection& s =
            tree.select(everything_from(glm::dvec3(place, 1.7, place) + off * amplitude_m), {0.8, 0.6});
        bool same = s.patches.size() == first.patches.size() && s.grid_origin_m == first.grid_origin_m;
        for (std::size_t p = 0; same && p < s.patches.size(); ++p)
          same = s.patches[p].corner == first.patches[p].corner && s.patches[p].stride == first.patches[p].stride &&
                 s.patches[p].flags == first.patches[p].flags;
        changed += same ? 0 : 1;
      }
    }
    return changed;
  };
  for (const Preset& preset : presets) {
    EXPECT_EQ(flips(preset, 1e-6), 0) << preset.name;
    EXPECT_GT(flips(preset, 0.3), 0) << preset.name;
  }
}

// Hard case 15 for the mesh: far from the world's origin the same list, and vertices relative to the viewer to 1e-6 m.
// Control seen: the grid's origin in floats.
TEST(QuadtreeHard, hard_15_a_million_metres_from_the_origin) {
  Quadtree tree{LodSettings{}};
  const glm::dvec3 near(12.34, 1.7, -56.78), far = near + glm::dvec3(1048576.0, 0.0, -2097152.0);
  const SurfaceSelection a = tree.select(everything_from(near), {}), b = tree.select(everything_from(far), {});
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t p = 0; p < a.patches.size(); ++p) {
    ASSERT_EQ(a.patches[p].corner, b.patches[p].corner);
    ASSERT_EQ(a.patches[p].flags, b.patches[p].flags);
  }
  const glm::dvec2 fraction_a = glm::dvec2(near.x, near.z) - a.grid_origin_m,
                   fraction_b = glm::dvec2(far.x, far.z) - b.grid_origin_m;
  EXPECT_LT(glm::length(fraction_a - fraction_b), 1e-6);
  EXPECT_LE(std::abs(fraction_a.x), 0.5 * a.unit_m);
}

// Under water, at 20 km, in a storm: finite, tiled, watertight, and the skirt beyond the horizon.
TEST(QuadtreeHard, AltitudeAndUnderWater) {
  for (const Preset& preset : presets)
    for (const double height : {-200.0, -3.0, 0.0, 0.2, 100.0, 1e4, 2e4}) {
      Quadtree tree(settings_of(preset, 4096.0));
      const SurfaceSelection& s = tree.select(everything_from({1e6, height, -1e6}), {12.0, 15.0});
      ASSERT_EQ(tiling_faults(s), TilingFaults{}) << preset.name << ' ' << height;
      if (preset.patch_quads == 16) expect_watertight(s, preset.name);
      EXPECT_TRUE(std::isfinite(s.mesh.skirt_to_horizon));
      EXPECT_LT(s.patches.size(), 20000u);
    }
}

// Hard case 22: along every bearing the highest point of the mesh, curved as the drawing curves it, lies within a pixel
// of the analytic dip acos(R / (R + h)): 0.06 degrees a pixel for low and medium (a headset's), 0.01 for high and
// ultra. Highest: among vertices, between which edges are straight; azimuths in steps of 1/16 of a quad. Waves off.
// Control seen: horizon_distance halved.
TEST(QuadtreeHard, hard_22_horizon_reach) {
  const double radius = static_cast<double>(gpu::earth_radius_m);
  for (const Preset& preset : presets)
    for (const double height : {1.7, 100.0, 1e4})
      for (const double multiplier : {1.0, 10.0, 20.0}) {
        LodSettings settings = settings_of(preset, 4096.0);
        settings.skirt_multiplier = multiplier;
        Quadtree tree(settings);
        const SurfaceSelection& s = tree.select(everything_from({17.0, height, 29.0}), {2.0, 0.0});
        const glm::dvec2 fraction = glm::dvec2(17.0, 29.0) - s.grid_origin_m;
        const double dip = std::acos(radius / (radius + height));
        const double pixel = glm::radians(preset.patch_quads == 64 ? 0.01 : 0.06);
        double worst = 0.0, reach = 1e12;
        constexpr int n = gpu::patch_quads;
        const auto place = [&](const gpu::PatchInstance& p, int i, int j) {
          const glm::dvec2 v = glm::dvec2(gpu::patch_vertex(p, i, j, s.mesh)) * s.unit_m - fraction;
          return glm::dvec3(v.x, -height - glm::dot(v, v) / (2.0 * radius), v.y);
        };
        for (const auto& p : s.patches) {
          if (!is_skirt(p) || gpu::patch_skirt_row(p, 0) != 0) continue;
          for (int i = 0; i < n; ++i)
            for (int part = 0; part < 16; ++part) {
              // The rows' edges cross this bearing at the same share of each, because they are scaled copies.
              double highest = -1e9;
              for (int row = 0; row <= s.mesh.skirt_rows; ++row) {
                gpu::PatchInstance band = p;
                const int of = std::min(row / n, s.mesh.skirt_rows / n - 1);
                band.flags |= static_cast<unsigned>(of) << gpu::patch_skirt_band_shift;
                const glm::dvec3 v =
                    glm::mix(place(band, i, row - of * n), place(band, i + 1, row - of * n), part / 16.0);
                highest = std::max(highest, std::atan2(v.y, std::hypot(v.x, v.z)));
                if (row == s.mesh.skirt_rows) reach = std::min(reach, std::hypot(v.x, v.z));
              }
              worst = std::max(worst, std::abs(highest + dip));
            }
        }
        EXPECT_LE(worst, pixel) << preset.name << ' ' << height << " m, multiplier " << multiplier << ": "
                                << worst / pixel << " pixels";
        EXPECT_GE(reach, s.horizon_m * 0.9999);
        EXPECT_GE(s.horizon_m, 1.2 * std::sqrt(2.0 * radius * height + height * height));
      }
}

}  // namespace
}  // namespace seascape
