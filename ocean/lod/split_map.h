// Which nodes of the quadtree split, a bit each: by distance, and balanced so that neighbours differ by one level at most.
#pragma once
#include <array>
#include <cstdint>

#include "ocean/lod/tree_frame.h"
#include "shaders/shared/patch_instance.h"

namespace seascape {

class SplitMap {
 public:
  static constexpr int max_levels = 15;

  // A square's nodes of one level lie at whole multiples of its size from the tree's least corner: (x, z) below.
  void find(const TreeFrame& frame);

  bool split(int level, int x, int z) const { return level < levels_ && windows_[static_cast<std::size_t>(level)].get(x, z); }

  // The quarters of a split node: a bit for each that splits, quarter 0 with the least x and z, 1 east and 2 north of it, 3
  // across; and the edge bits (shaders/shared/patch_instance.h) of the sides on which leaves among them have coarser
  // neighbours: those where no node of the parent's size is split. Outside the root none is coarser.
  struct Brood {
    unsigned splits, coarser;
  };
  Brood brood(int level, int x, int z) const {
    const Window& own = windows_[static_cast<std::size_t>(level)];
    const int end = (1 << level) - 1;
    unsigned coarser = 0u;
    coarser |= x < end && !own.get(x + 1, z) ? gpu::patch_east : 0u;
    coarser |= z < end && !own.get(x, z + 1) ? gpu::patch_north : 0u;
    coarser |= x > 0 && !own.get(x - 1, z) ? gpu::patch_west : 0u;
    coarser |= z > 0 && !own.get(x, z - 1) ? gpu::patch_south : 0u;
    if (level + 1 >= levels_) return {0u, coarser};
    const Window& below = windows_[static_cast<std::size_t>(level + 1)];
    return {below.pair(2 * x, 2 * z) | below.pair(2 * x, 2 * z + 1) << 2, coarser};
  }

  // Which sides of its parent a quarter touches.
  static constexpr std::array<unsigned, 4> outer_edges{gpu::patch_west | gpu::patch_south, gpu::patch_east | gpu::patch_south,
                                                       gpu::patch_west | gpu::patch_north, gpu::patch_east | gpu::patch_north};

 private:
  // The split nodes of one level, in a window about the viewer. Splitting is local: a level's split nodes lie within
  // TreeFrame::split_reach of the viewer, plus the ring that balancing adds.
  struct Window {
    static constexpr int width = 32;
    int x0 = 0, z0 = 0;
    int first = width, last = -1;  // rows that may have a bit
    std::array<std::uint32_t, width> rows{};
    bool get(int x, int z) const {
      const unsigned dx = static_cast<unsigned>(x - x0), dz = static_cast<unsigned>(z - z0);
      return dx < width && dz < width && ((rows[dz] >> dx) & 1u) != 0u;
    }
    // get(x, z), and get(x + 1, z) one bit higher.
    unsigned pair(int x, int z) const {
      const unsigned dx = static_cast<unsigned>(x - x0 + 1), dz = static_cast<unsigned>(z - z0);
      return dx <= width && dz < width ? static_cast<unsigned>((std::uint64_t{rows[dz]} << 1) >> dx) & 3u : 0u;
    }
    void add(int row, std::uint32_t bits);
  };
  void find_by_distance(const TreeFrame& frame, int level);
  void balance(int level);

  int levels_ = 0;
  std::array<Window, max_levels> windows_;
};

}  // namespace seascape
