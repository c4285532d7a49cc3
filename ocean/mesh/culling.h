// Decides what at least one of several eyes may see: bounds against the union of their frusta, without a far plane.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "engine/view.h"

namespace seascape {

// A grid of equal upright boxes, all in metres relative to EyeFrusta's origin: box (i, j), whatever whole numbers these
// are, has its centre at (x + i * step, z + j * step).
struct BoxGrid {
  double x, z, step;
  double half_x, half_z;  // half their sides
  double low, high;       // their heights
};

// Boxes of a row, or rows, from `first` to `last`; none where last < first.
struct BoxRange {
  int first, last;
};

// Puts ranges in order and those that meet together, in place, without empty ones: returns how many are left, apart
// from each other.
std::size_t join_ranges(BoxRange* ranges, std::size_t count);
// The same of two: what the eyes of a head see of a row is nearly always much the same.
inline std::size_t join_two(BoxRange* ranges) {
  const bool first = ranges[0].first <= ranges[0].last, second = ranges[1].first <= ranges[1].last;
  if (first && second) {
    if (std::max(ranges[0].first, ranges[1].first) <= std::min(ranges[0].last, ranges[1].last) + 1) {
      ranges[0] = {std::min(ranges[0].first, ranges[1].first), std::max(ranges[0].last, ranges[1].last)};
      return 1;
    }
    if (ranges[1].first < ranges[0].first) std::swap(ranges[0], ranges[1]);
    return 2;
  }
  if (second) ranges[0] = ranges[1];
  return first || second ? 1 : 0;
}

// A straight border about a centre, outside of which trapezoids lie side by side. In metres relative to EyeFrusta's
// origin.
struct Border {
  glm::dvec2 centre;
  int axis;       // that it runs along: 0 x, 1 z
  double border;  // where it lies along the other axis, from the centre
  double half;    // its ends: t, the distance along it, from -half to half
  double grow;    // what trapezoids are grown by to every side
};

// A band of such trapezoids: of a point t of the border they hold what lies from an inner to an outer multiple of its
// distance from the centre.
struct BorderBand {
  double per_inner, per_outer;  // 1 over either
  double low, high;
};

// Of a border: what lies between two t.
struct BorderRange {
  double least, most;
};

// An upright box, in metres relative to EyeFrusta's origin.
struct UprightBox {
  double x, z;            // its centre
  double half_x, half_z;  // half its sides
  double low, high;
};

// x * px + (up + down) * py + z * pz + offset >= 0 on the seen side. Of an eye: left, right, up, down, and the plane
// through it (the near plane's distance belongs to the drawing, and zero is on the safe side of it). Where all corner
// rays of an eye go up, or all down, along an axis, nothing beyond the eye on the other side is seen: three more. The
// frustum's planes alone let through boxes beside and behind the eye; these complete the separating axes in the plane
// of the sea.
struct FrustumPlane {
  double x, z, offset;
  double up, down;  // the normal's y where it is positive, where it is negative
  static constexpr std::size_t per_eye = 8;
};

class EyeFrusta {
 public:
  // Takes the eyes' poses (unit quaternions) and fields of view; positions below are relative to `origin_m`, world
  // axes. No eyes: everything counts as seen. No allocation once as many eyes have been set before.
  void set(const std::vector<View>& eyes, const glm::dvec3& origin_m);

  // False only if no eye can see any point of the box.
  bool may_see(const UprightBox& box) const;

  // Lists of one range for every eye: one eye that sees everything where there are none.
  std::size_t lists() const { return std::max<std::size_t>(across_[0].size(), 1); }

  // The same for boxes of a grid: writes for each of `rows` and for each eye (lists() of them, side by side) which of
  // its `columns` may be seen; the list grows as needed. The planes cut a row where one sum says, so that a row costs
  // as little as one box.
  void may_see(const BoxGrid& grid, BoxRange rows, BoxRange columns, std::vector<BoxRange>& seen) const;

  // The same for bands of trapezoids: writes for each band and each eye between which t the eye sees any of it. A
  // trapezoid from t0 to t1 may be seen only if t1 >= least and t0 <= most; least > most: nothing is. `whole` holds all
  // bands: an eye that sees nothing of it is asked no more, and `bands` is not called if none sees any. Then nothing is
  // written, and the answer is false.
  bool may_see(const Border& border, const BorderBand& whole, const std::function<std::span<const BorderBand>()>& bands,
               std::span<BorderRange> seen) const;

 private:
  static constexpr std::size_t planes_per_eye = FrustumPlane::per_eye;

  // An eye's planes as they cut lines along an axis: first those whose seen side is towards more of it, from `turn` on
  // towards less, from `level` to the end those that lie along it. Where a plane cuts, its offset counts `inverse`
  // times and the other axis `slope` times.
  struct Across {
    struct Plane {
      double along, across, offset, up, down;
      double inverse, slope;  // -1 / along, -across / along
    };
    std::array<Plane, planes_per_eye> planes;
    std::size_t turn, level, end;
  };
  static Across across(const FrustumPlane* planes, std::size_t count, bool along_z);

  // The same of two eyes side by side: the planes that cut from below, and from above. An eye that has fewer has some
  // that cut nothing: `limit` is where a plane cuts at most, or at least.
  struct TwoEyes {
    using Lanes = std::array<double, 2>;
    struct Plane {
      Lanes along, across, offset, up, down, inverse, slope, limit;
    };
    std::array<Plane, planes_per_eye> least, most;
    std::size_t least_count, most_count;
  };
  static TwoEyes two_eyes(const Across* eyes, std::size_t count);

  // All planes of an eye side by side, as single boxes are held against them.
  struct SideBySide {
    using Lanes = std::array<float, planes_per_eye>;
    alignas(16) Lanes x, z, x_size, z_size, up, down, offset;  // sizes: |x|, |z|
  };
  static SideBySide side_by_side(const FrustumPlane* planes);

  std::vector<SideBySide> together_;           // of each eye
  std::array<std::vector<Across>, 2> across_;  // lines along x, along z
  std::array<std::vector<TwoEyes>, 2> pairs_;  // the same
};

}  // namespace seascape
