// What the water about a viewer does now: which water stands beneath, and which patches no eye sees as it stands.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ocean/mesh/culling.h"
#include "ocean/mesh/leaf_runs.h"
#include "ocean/mesh/surface_selection.h"
#include "ocean/mesh/tree_frame.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {

// The water beneath a viewer, by the waves that a footprint of NearMotion::footprint_m leaves, which fold nowhere: the
// search always ends, and what it finds moves as smoothly as the water does. `viewer_m` in the world; not finite: none.
std::optional<DisplacementBounds::Below> water_below(const WaveField& field, const WaveTiles& tiles,
                                                     const glm::dvec3& viewer_m, const NearMotion& motion);

// Finds the near leaves that no eye sees as their water stands, which culling by bounds cannot tell: the water of a
// node of four by four leaves lies about its corners, no farther off than what a mesh of its size misses. `frusta` as
// the tree was culled with (relative to the grid origin), `tiles` with all waves that are drawn. Looks at leaves of up
// to two fifths of a significant wave height. Keeps room to work in: no allocation once levels have reached as far.
class WaterCulling {
 public:
  // Tells the levels which of their nodes are seen: valid until the next call.
  void operator()(const WaveField& field, const WaveTiles& tiles, const EyeFrusta& frusta, const TreeFrame& frame,
                  const glm::dvec2& grid_origin_m, std::span<const LeafRun> runs, std::span<LeafLevel> levels);

 private:
  static constexpr std::uint32_t unknown = 0xffffffff;
  // Of a level the nodes that may hold leaves of it, and their corners, of which there is one more either way.
  struct Grid {
    int size;                   // of a node, in units
    int x0, z0, columns, rows;  // in nodes from the tree's least corner
    std::size_t first_node, first_corner;
    double off_m;  // how far the water of a node may lie off what lies between its corners
  };
  struct Node {
    std::uint32_t at, grid;  // among all nodes; of its level
    int x, z;                // in nodes from the tree's least corner
    glm::dvec3 low, high;    // of the corners asked so far
  };
  // The number of a corner of grid n, which may be one of the next finer nodes' too.
  std::uint32_t corner(std::size_t n, int x, int z, const TreeFrame& frame, glm::dvec2 grid_origin_m);
  std::vector<Grid> grids_;
  std::vector<std::uint8_t> seen_;      // of nodes
  std::vector<Node> left_;              // that are not known to be seen
  std::vector<std::uint32_t> corners_;  // of all grids: which of those asked, or unknown
  std::vector<std::uint32_t> asked_;    // of the nodes left, side by side
  std::vector<glm::dvec2> rest_m_;      // of what was asked, in the world
  std::vector<glm::vec3> moved_m_;      // their displacements
};

}  // namespace seascape
