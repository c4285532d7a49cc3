// The leaves of the tree that are to be listed, as runs along the rows of a level: which of them are seen is decided
// before any patch is written.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ocean/mesh/culling.h"
#include "shaders/shared/patch_instance.h"

namespace seascape {

// Leaves (x, z) of a level, from x = first to last. Their places count leaves from the tree's least corner.
struct LeafRun {
  int z, first, last;
};

// The leaves of one level.
struct LeafLevel {
  int level;               // of the tree: 0 is the root
  int size;                // of a leaf, in units
  BoxRange rows, columns;  // that hold them all
  int column;              // the viewer's: runs are written from there outwards, for nearer water hides what follows
  std::size_t first_run, end_run;  // its runs among all
  // Of its nodes of four by four leaves, which are seen: 1 or 0, that of leaf (x, z) at first_node + (z >> node_shift)
  // * pitch + (x >> node_shift). Empty: all.
  std::span<const std::uint8_t> seen = {};
  std::ptrdiff_t first_node = 0, pitch = 0;

  static constexpr int node_shift = 2, node_leaves = 1 << node_shift;
};

// Appends the leaves of a level that are seen as patches of a tree whose least corner is at `least`, with these flags,
// the runs in their order and each nearest first. `patches` holds `count`, and room after these.
void write_leaves(const LeafLevel& level, std::span<const LeafRun> runs, const glm::ivec2& least, std::uint32_t flags,
                  std::vector<gpu::PatchInstance>& patches, std::size_t& count);

}  // namespace seascape
