// What has changed of windows around the viewer: the columns and rows of texels that came in, so that the rest is
// neither read nor copied again.
#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "ocean/places/lod_windows.h"

namespace seascape {

// Columns or rows of a slice as they are stored, by their number modulo the side: `count` from `from` on; after the
// last comes the first.
struct LodSpan {
  int from = 0, count = 0;
  bool operator==(const LodSpan&) const = default;
};

// Of one slice: all texels of these columns, and all of these rows.
struct LodChange {
  LodSpan columns, rows;
  bool any() const { return columns.count > 0 || rows.count > 0; }
  bool operator==(const LodChange&) const = default;
};
using LodChanges = std::array<LodChange, gpu::max_lod_slices>;

inline LodChange whole_change(int side) { return {{}, {0, side}}; }

// Bit i for a slice i of which anything has changed.
std::uint32_t changed_slices(const LodChanges& changes);

// What comes in as a window of `side` texels moves from one first texel to another.
LodChange lod_entered(LodIndex before, LodIndex now, int side);

// Adds what others have: the same, or a slice as a whole.
void join(LodChanges& changes, const LodChanges& others, int side);

// With the texels beside it, whose slopes are taken from it (around the end too).
LodChange with_neighbours(const LodChange& change, int side);

// Texels [from, to) of one axis.
struct LodRun {
  int from, to;
};
// A rectangle of stored texels.
struct LodRect {
  LodRun x, z;
};
// The rectangles that make a change, at most six. No two of them overlap.
std::vector<LodRect> rects(const LodChange& change, int side);

// The least and the most of each slice's values, known by squares of texels: only squares with a change in them are
// read again.
class LodRanges {
 public:
  LodRanges(int slices, int side);
  // `value(x, z)`: of the stored texel in column x of row z.
  template <class Value>
  void take(int slice, const LodChange& change, const Value& value) {
    std::vector<Range>& squares = slices_[std::size_t(slice)].squares;
    for (const LodRect& rect : rects(change, side_))
      for (int z = rect.z.from / square; z * square < rect.z.to; ++z)
        for (int x = rect.x.from / square; x * square < rect.x.to; ++x) {
          Range range;
          for (int j = z * square; j < (z + 1) * square; ++j)
            for (int i = x * square; i < (x + 1) * square; ++i) range.add(value(i, j));
          squares[std::size_t(z * (side_ / square) + x)] = range;
        }
    sum_up(slice);
  }
  float least(int slice) const { return slices_[std::size_t(slice)].all.least; }
  float most(int slice) const { return slices_[std::size_t(slice)].all.most; }

 private:
  static constexpr int square = 16;  // sides are multiples of it
  struct Range {
    float least = std::numeric_limits<float>::infinity(), most = -least;
    void add(float value) { least = std::min(least, value), most = std::max(most, value); }
  };
  struct Slice {
    std::vector<Range> squares;
    Range all;
  };
  void sum_up(int slice);
  int side_;
  std::vector<Slice> slices_;
};

}  // namespace seascape
