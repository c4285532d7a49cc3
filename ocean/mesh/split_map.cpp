#include "ocean/mesh/split_map.h"

#include <bit>
#include <cassert>
#include <cmath>

namespace seascape {

void SplitMap::find(const TreeFrame& frame) {
  assert(frame.levels <= max_levels);
  levels_ = frame.levels;
  while (levels_ > 0 && !(frame.split_reach(levels_ - 1) > frame.gap_y))
    --levels_;     // from high above the finest do not split
  int cells = -1;  // that balance may add one level up
  for (int level = levels_ - 1; level >= 0; --level) cells = (find_by_distance(frame, level, cells) + 2) / 2;
  for (int level = levels_ - 1; level > 0; --level) balance(level);
}

// Returns how many rows away from the viewer's a level may split, `least_cells` or more.
int SplitMap::find_by_distance(const TreeFrame& frame, int level, int least_cells) {
  Level& to = rows_[static_cast<std::size_t>(level)];
  const int size = frame.size(level), end = (1 << level) - 1, shift = std::countr_zero(static_cast<unsigned>(size));
  const int cell_x = std::clamp(frame.viewer_x >> shift, 0, end), cell_z = std::clamp(frame.viewer_z >> shift, 0, end);
  // Squared, so that whole numbers stay exact.
  const double reach = frame.split_reach(level), reach2 = reach * reach - frame.gap_y * frame.gap_y;
  const int cells =
      reach2 > 0.0 ? static_cast<int>(std::min(std::sqrt(reach2) / size, static_cast<double>(end))) + 1 : -1;
  const int all = std::max(cells, least_cells);
  const int low = std::max(cell_z - all, 0), high = std::min(cell_z + all, end);
  to.z0 = low;
  to.rows.clear();
  if (all < 0) return all;
  to.rows.resize(static_cast<std::size_t>(high - low + 1));
  if (cells < 0) return all;
  const auto gap2 = [size](int cell, int viewer) {
    const double d = std::max({cell * size - viewer, viewer - (cell + 1) * size, 0});
    return d * d;
  };
  for (const int step : {1, -1}) {
    // No row's interval is wider than that of the row before it.
    int first = std::max(cell_x - cells, 0), last = std::min(cell_x + cells, end);
    double first_gap2 = gap2(first, frame.viewer_x), last_gap2 = gap2(last, frame.viewer_x);
    for (int z = step > 0 ? cell_z : cell_z - 1; z >= std::max(cell_z - cells, 0) && z <= std::min(cell_z + cells, end);
         z += step) {
      const double left = reach2 - gap2(z, frame.viewer_z);
      while (first <= last && !(first_gap2 < left)) first_gap2 = gap2(++first, frame.viewer_x);
      while (first <= last && !(last_gap2 < left)) last_gap2 = gap2(--last, frame.viewer_x);
      if (first > last) break;
      to.rows[static_cast<std::size_t>(z - low)] = {first, last};
    }
  }
  return all;
}

// Two leaves that share an edge differ by at most one level exactly if every edge neighbour of a split node exists,
// that is, if the neighbour's parent is split. From the deepest level upwards one sweep is enough, because a sweep only
// adds splits one level up. Every interval holds the viewer's column, so that two that meet in a row of parents are
// one.
void SplitMap::balance(int level) {
  const Level& fine = rows_[static_cast<std::size_t>(level)];
  Level& coarse = rows_[static_cast<std::size_t>(level - 1)];
  const int end = (1 << level) - 1;
  for (std::size_t n = 0; n < fine.rows.size(); ++n) {
    const Interval row = fine.rows[n];
    if (row.last < row.first) continue;
    const int z = fine.z0 + static_cast<int>(n);
    coarse.add(z >> 1, std::max(row.first - 1, 0) >> 1, std::min(row.last + 1, end) >> 1);
    if (z > 0) coarse.add((z - 1) >> 1, row.first >> 1, row.last >> 1);
    if (z < end) coarse.add((z + 1) >> 1, row.first >> 1, row.last >> 1);
  }
}

}  // namespace seascape
