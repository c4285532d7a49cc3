// What the tests of the quadtree share: the four presets, viewpoints, and the whole mesh in whole numbers.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "ocean/mesh/patch_mesh.h"
#include "ocean/mesh/quadtree.h"
#include "shaders/shared/patch_vertex.h"

namespace seascape::lod_test {

struct Preset {
  const char* name;
  int patch_quads;
  double threshold, cull_scale;
  double pixel_error;  // coarser than the preset's, so that thousands of whole meshes are quickly looked through
};
inline constexpr std::array<Preset, 4> presets{{{"low", 16, 2.0, 1.2, 26.0},
                                                {"medium", 32, 1.5, 1.5, 10.0},
                                                {"high", 64, 1.2, 1.8, 4.0},
                                                {"ultra", 64, 1.0, 2.0, 3.3}}};

inline LodSettings settings_of(const Preset& preset, double ocean_size_m, LodJoin join = LodJoin::masked) {
  LodSettings s;
  s.join = join;
  s.patch_quads = preset.patch_quads;
  s.by = LodLaw::pixel_error;
  s.pixel_error = preset.pixel_error;
  s.threshold = preset.threshold;
  s.cull_scale = preset.cull_scale;
  s.ocean_size_m = ocean_size_m;
  return s;
}

inline LodSettings by_threshold(LodSettings s) {
  s.by = LodLaw::threshold;
  return s;
}
// The spacing of vertices over their distance, at most, of a sea of which the tree knows no mesh_error.
inline double spacing_over_distance(const LodSettings& s) {
  return s.by == LodLaw::pixel_error ? s.pixel_error / (Quadtree::error_over_spacing * reference_pixels_per_radian)
                                     : Quadtree::spacing_over_distance(s);
}

// A viewer without eyes: the whole selection, nothing culled.
inline Viewpoint everything_from(const glm::dvec3& position) { return {{position, {1.0, 0.0, 0.0, 0.0}}, {}}; }

inline bool is_skirt(const gpu::PatchInstance& p) { return (p.flags & gpu::patch_skirt) != 0u; }
inline unsigned side_of(const gpu::PatchInstance& p) { return (p.flags >> gpu::patch_skirt_side_shift) & 3u; }
inline int level_of(const gpu::PatchInstance& p) { return static_cast<int>(gpu::patch_level(p.flags)); }

// Identity of a vertex of the complete mesh: the bits of its place, as the vertex shader computes it.
struct VertexKey {
  glm::vec2 place;
  std::uint64_t bits;
  bool operator==(const VertexKey& o) const { return bits == o.bits; }
};
inline VertexKey key_of(const SurfaceSelection& s, const gpu::PatchInstance& p, int i, int j) {
  const glm::vec2 place = gpu::patch_vertex(p, i, j, s.mesh) + 0.0f;  // no -0
  return {place, std::uint64_t{std::bit_cast<std::uint32_t>(place.x)} << 32 | std::bit_cast<std::uint32_t>(place.y)};
}

// Faults of the topology of the mesh that all patches make together.
struct Topology {
  int open_edges = 0;     // used by one triangle only, and not on the skirt's outer border
  int crowded_edges = 0;  // used by more than two, or twice in the same direction
  // Triangles of the tree that are clockwise from above. Where east and north neighbours are both coarser, one triangle
  // of the corner is flat at rest (its vertices lie on a line); it still closes the displaced surface, and is not a
  // fold.
  int folded = 0;
  double twice_area = 0.0;  // of the tree's triangles, in square units
};

inline Topology topology_of(const SurfaceSelection& selection) {
  Topology result;
  constexpr int quads = gpu::patch_quads;
  static const std::vector<std::uint16_t> indices = patch_indices(quads);
  // Directed edges between numbered vertices, sorted: fast enough for half a million triangles.
  struct Edge {
    std::uint64_t low, high;
    int direction;
    bool operator<(const Edge& o) const { return low != o.low ? low < o.low : high < o.high; }
  };
  std::vector<Edge> edges;
  std::vector<VertexKey> keys(static_cast<std::size_t>((quads + 1) * (quads + 1)));
  for (const gpu::PatchInstance& p : selection.patches) {
    for (int j = 0; j <= quads; ++j)
      for (int i = 0; i <= quads; ++i) keys[static_cast<std::size_t>(j * (quads + 1) + i)] = key_of(selection, p, i, j);
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
      const std::array<const VertexKey*, 3> v{&keys[indices[t]], &keys[indices[t + 1]], &keys[indices[t + 2]]};
      if (*v[0] == *v[1] || *v[1] == *v[2] || *v[2] == *v[0]) continue;  // empty after snapping: draws nothing
      if (!is_skirt(p)) {
        const glm::dvec2 a = glm::dvec2(v[1]->place) - glm::dvec2(v[0]->place),
                         b = glm::dvec2(v[2]->place) - glm::dvec2(v[0]->place);
        const double up = a.y * b.x - a.x * b.y;  // y of (b - a) x (c - a)
        if (up < -1e-6 * p.stride * p.stride) ++result.folded;
        result.twice_area += up;
      }
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint64_t na = v[e]->bits, nb = v[(e + 1) % 3]->bits;
        // The outer border of the skirt is open by design.
        const auto row = [&](std::size_t corner) { return gpu::patch_skirt_row(p, indices[t + corner] / (quads + 1)); };
        if (row(e) == selection.mesh.skirt_rows && row((e + 1) % 3) == selection.mesh.skirt_rows) continue;
        edges.push_back(na < nb ? Edge{na, nb, 1} : Edge{nb, na, -1});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t end = first;
    int directions = 0;
    for (; end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high; ++end)
      directions += edges[end].direction;
    if (end - first == 1)
      ++result.open_edges;
    else if (end - first > 2 || directions != 0)
      ++result.crowded_edges;
    first = end;
  }
  return result;
}

}  // namespace seascape::lod_test
