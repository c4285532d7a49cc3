// Decides what at least one of several eyes may see: bounds against the union of their frusta, without a far plane.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "engine/view.h"

namespace seascape {

// A row of equal upright boxes side by side along x, all in metres relative to EyeFrusta's origin: box n, whatever whole number it
// is, has its centre at (x + n * step, z).
struct BoxRow {
  double x, z, step;
  double half_x, half_z;  // half their sides
  double low, high;       // their heights
};

// Boxes of a row from `first` to `last`; none where last < first.
struct BoxRange {
  int first, last;
};

// An upright prism over the convex hull of four points (x, z), grown by `grow` to every side.
struct UprightPrism {
  std::array<glm::dvec2, 4> corners;
  double grow;
  double low, high;
};

// x * px + (up + down) * py + z * pz + offset >= 0 on the seen side. Of an eye: left, right, up, down, and the plane through
// it (the near plane's distance belongs to the drawing, and zero is on the safe side of it). Where all corner rays of an
// eye go up, or all down, along an axis, nothing beyond the eye on the other side is seen: three more. The frustum's planes
// alone let through boxes beside and behind the eye; these complete the separating axes in the plane of the sea.
struct FrustumPlane {
  double x, z, offset;
  double up, down;  // the normal's y where it is positive, where it is negative
  double level;     // |x| + |z|
  static constexpr std::size_t per_eye = 8;
};

class EyeFrusta {
 public:
  // What is still to be asked about bounds that lie inside of others: none of it once the outer ones are wholly in one
  // eye's sight. A bit a plane, eight to an eye; an eye that sees nothing of the outer bounds has none. Beyond eight eyes
  // everything is asked every time.
  using Questions = std::uint64_t;
  static constexpr Questions none = 0;

  // Takes the eyes' poses (unit quaternions) and fields of view; positions below are relative to `origin_m`, world axes.
  // No eyes: everything counts as seen. No allocation once as many eyes have been set before.
  void set(const std::vector<View>& eyes, const glm::dvec3& origin_m);

  // All questions: what to begin with.
  Questions all() const { return all_; }

  // False only if no eye can see any point of the bounds. `questions`, not `none`: what the bounds around these left;
  // becomes what these leave for all that lies inside of them.
  bool may_see(const UprightPrism& prism, Questions& questions) const {
    return ask(questions, [&prism](const FrustumPlane& plane) {
      double least = plane.x * prism.corners[0].x + plane.z * prism.corners[0].y, most = least;
      for (std::size_t c = 1; c < 4; ++c) {
        const double at = plane.x * prism.corners[c].x + plane.z * prism.corners[c].y;
        least = at < least ? at : least;
        most = at > most ? at : most;
      }
      const double reach = plane.level * prism.grow;
      return Span{least - reach + plane.offset + plane.up * prism.low + plane.down * prism.high,
                  most + reach + plane.offset + plane.up * prism.high + plane.down * prism.low};
    });
  }

  // The same for a row of boxes, of those that `range` holds: writes the ranges that may be seen, apart and from the least on,
  // as many as there are eyes at most, and returns how many. Without eyes all of it is. The planes cut a row where one division
  // says, so that a row costs as much as two boxes.
  std::size_t may_see(const BoxRow& row, BoxRange range, std::vector<BoxRange>& seen) const;

 private:
  struct Span {
    double least, most;  // of the distances from a plane, over all of some bounds
  };
  static constexpr std::size_t planes_per_eye = FrustumPlane::per_eye, most_eyes = 8;
  static constexpr Questions of_an_eye = 0xff;

  template <typename Distances>
  bool ask(Questions& questions, const Distances& distances) const {
    if (planes_.size() > most_eyes * planes_per_eye) return ask_all(distances);
    Questions left = 0;
    for (Questions asked = questions; asked != 0;) {
      const unsigned first = static_cast<unsigned>(std::countr_zero(asked)) & ~7u;
      unsigned open = static_cast<unsigned>((asked >> first) & of_an_eye);
      asked &= ~(of_an_eye << first);
      unsigned crossed = 0;
      for (; open != 0; open &= open - 1) {
        const unsigned p = static_cast<unsigned>(std::countr_zero(open));
        const Span span = distances(planes_[first + p]);
        if (span.most < 0.0) break;
        if (span.least < 0.0) crossed |= 1u << p;
      }
      if (open != 0) continue;  // all of it beyond a plane: nothing more for this eye
      if (crossed == 0) {
        questions = none;
        return true;
      }
      left |= static_cast<Questions>(crossed) << first;
    }
    if (left == 0) return false;
    questions = left;
    return true;
  }
  template <typename Distances>
  bool ask_all(const Distances& distances) const {
    for (std::size_t first = 0; first < planes_.size(); first += planes_per_eye) {
      bool seen = true;
      for (std::size_t p = first; seen && p < first + planes_per_eye; ++p) seen = distances(planes_[p]).most >= 0.0;
      if (seen) return true;
    }
    return false;
  }

  // An eye's planes for rows along x: first those whose seen side is towards +x, from `turn` on towards -x, from `level` to the
  // end those along x.
  struct RowPlanes {
    std::array<FrustumPlane, planes_per_eye> planes;
    std::array<double, planes_per_eye> inverse_x;
    std::size_t turn, level, end;
  };

  std::vector<FrustumPlane> planes_;  // eight an eye; those that an eye does not need have all on their seen side
  std::vector<RowPlanes> row_planes_;
  Questions all_ = none;
};

}  // namespace seascape
