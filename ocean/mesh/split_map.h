// Which nodes of the quadtree split: by distance, and balanced so that neighbours differ by one level at most.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "ocean/mesh/tree_frame.h"

namespace seascape {

// Within a level the nodes that split are those nearer than its reach, and so in each row of them an interval about the
// viewer's own column; what balance adds keeps it one. A level is a few rows of two numbers, however far it reaches.
class SplitMap {
 public:
  static constexpr int max_levels = TreeFrame::max_levels;

  // Columns of a row, from `first` to `last`; none where last < first.
  struct Interval {
    int first = 0, last = -1;
    bool holds(int x) const { return x >= first && x <= last; }
  };

  // A level's nodes lie at whole multiples of their size from the tree's least corner: (x, z) below. No allocation once
  // the levels have reached as far before.
  void find(const TreeFrame& frame);

  bool split(int level, int x, int z) const { return row(level, z).holds(x); }
  // The nodes of a row that split; empty beyond the rows and levels that have any.
  Interval row(int level, int z) const {
    if (level >= levels_) return {};
    const Level& l = rows_[static_cast<std::size_t>(level)];
    const int at = z - l.z0;
    return at >= 0 && at < static_cast<int>(l.rows.size()) ? l.rows[static_cast<std::size_t>(at)] : Interval{};
  }
  // Of coarser levels than this alone some node may split.
  int levels() const { return levels_; }
  // From the first row that may have any to the last, of such a level.
  Interval rows(int level) const {
    const Level& l = rows_[static_cast<std::size_t>(level)];
    return {l.z0, l.z0 + static_cast<int>(l.rows.size()) - 1};
  }

 private:
  struct Level {
    int z0 = 0;
    std::vector<Interval> rows;
    void add(int z, int first, int last) {
      Interval& interval = rows[static_cast<std::size_t>(z - z0)];
      if (interval.last < interval.first)
        interval = {first, last};
      else
        interval = {std::min(interval.first, first), std::max(interval.last, last)};
    }
  };
  int find_by_distance(const TreeFrame& frame, int level, int least_cells);
  void balance(int level);

  int levels_ = 0;
  std::array<Level, max_levels> rows_;
};

}  // namespace seascape
