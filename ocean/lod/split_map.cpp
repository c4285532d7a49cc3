#include "ocean/lod/split_map.h"

#include <bit>
#include <cassert>
#include <cmath>

namespace seascape {
namespace {

// How far v lies outside of the interval, 0 inside.
int gap(int low, int high, int v) { return std::max({low - v, v - high, 0}); }

// Bit n of the result: bit 2n or bit 2n + 1 of `bits`.
std::uint64_t halved(std::uint64_t bits) {
  bits = (bits | (bits >> 1)) & 0x5555555555555555u;
  bits = (bits | (bits >> 1)) & 0x3333333333333333u;
  bits = (bits | (bits >> 2)) & 0x0f0f0f0f0f0f0f0fu;
  bits = (bits | (bits >> 4)) & 0x00ff00ff00ff00ffu;
  bits = (bits | (bits >> 8)) & 0x0000ffff0000ffffu;
  return (bits | (bits >> 16)) & 0xffffffffu;
}

}  // namespace

void SplitMap::Window::add(int row, std::uint32_t bits) {
  assert(row >= 0 && row < width);
  rows[static_cast<std::size_t>(row)] |= bits;
  first = std::min(first, row);
  last = std::max(last, row);
}

void SplitMap::find(const TreeFrame& frame) {
  assert(frame.levels <= max_levels);
  levels_ = frame.levels;
  for (int level = 0; level < levels_; ++level) find_by_distance(frame, level);
  for (int level = levels_ - 1; level > 0; --level) balance(level);
}

void SplitMap::find_by_distance(const TreeFrame& frame, int level) {
  Window& window = windows_[static_cast<std::size_t>(level)];
  const int size = frame.size(level), end = (1 << level) - 1, shift = std::countr_zero(static_cast<unsigned>(size));
  const int cell_x = std::clamp(frame.viewer_x >> shift, 0, end), cell_z = std::clamp(frame.viewer_z >> shift, 0, end);
  window.x0 = cell_x - Window::width / 2;
  window.z0 = cell_z - Window::width / 2;
  window.rows = {};
  window.first = Window::width;
  window.last = -1;
  // Squared, so that whole numbers stay exact.
  const double reach = frame.split_reach(level), reach2 = reach * reach - frame.gap_y * frame.gap_y;
  if (!(reach2 > 0.0)) return;
  const int cells = std::min(static_cast<int>(std::sqrt(reach2) / size), end) + 1;  // how far off a node may be that splits
  assert(cells + 3 < Window::width / 2);
  const auto gap2 = [size](int cell, int viewer) {
    const double d = gap(cell * size, (cell + 1) * size, viewer);
    return d * d;
  };
  const int low = std::max(cell_x - cells, 0), high = std::min(cell_x + cells, end);
  std::array<double, Window::width> dx2;
  for (int x = low; x <= high; ++x) dx2[static_cast<std::size_t>(x - low)] = gap2(x, frame.viewer_x);
  // A row's nodes within reach are an interval about the viewer's column, no wider than that of the row before it.
  for (const int step : {1, -1}) {
    int from = low, to = high;
    for (int z = step > 0 ? cell_z : cell_z - 1; z >= std::max(cell_z - cells, 0) && z <= std::min(cell_z + cells, end); z += step) {
      const double dz2 = gap2(z, frame.viewer_z);
      while (from <= to && !(dx2[static_cast<std::size_t>(from - low)] + dz2 < reach2)) ++from;
      while (from <= to && !(dx2[static_cast<std::size_t>(to - low)] + dz2 < reach2)) --to;
      if (from > to) break;
      window.add(z - window.z0, ((2u << (to - from)) - 1u) << (from - window.x0));
    }
  }
}

// Two leaves that share an edge differ by at most one level exactly if every edge neighbour of a split node exists, that
// is, if the neighbour's parent is split. From the deepest level upwards one sweep is enough, because a sweep only adds
// splits one level up. A ring of e cells about the viewer's cell needs at most (e + 1 + 1) / 2 one level up: no more than
// that level's own splits and one, inside the window. A row at a time.
void SplitMap::balance(int level) {
  const Window& fine = windows_[static_cast<std::size_t>(level)];
  Window& coarse = windows_[static_cast<std::size_t>(level - 1)];
  const int end = (1 << level) - 1;
  for (int row = fine.first; row <= fine.last; ++row) {
    const std::uint64_t bits = fine.rows[static_cast<std::size_t>(row)];
    if (bits == 0u) continue;
    // Bit 0 stands for the even column at or before x0 - 1, so that halving makes whole columns of the coarser level.
    const int first_x = (fine.x0 - 1) & ~1, off = fine.x0 - first_x, z = fine.z0 + row;
    std::uint64_t wide = (bits << off) | (bits << (off + 1)) | (bits << (off - 1));
    if (first_x < 0) wide &= ~std::uint64_t{0} << -first_x;                        // columns before 0,
    if (end - first_x < 63) wide &= (std::uint64_t{2} << (end - first_x)) - 1u;    // and after the last
    const auto add = [&](int at_z, std::uint64_t columns) {
      const std::uint64_t parents = halved(columns);
      const int by = (first_x >> 1) - coarse.x0;
      coarse.add((at_z >> 1) - coarse.z0, static_cast<std::uint32_t>(by >= 0 ? parents << by : parents >> -by));
    };
    add(z, wide);
    add(std::max(z - 1, 0), bits << off);
    add(std::min(z + 1, end), bits << off);
  }
}

}  // namespace seascape
