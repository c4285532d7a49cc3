#include "ocean/mesh/culling.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

namespace seascape {

std::size_t join_ranges(BoxRange* ranges, std::size_t count) {
  if (count == 2) return join_two(ranges);
  const auto none = [](const BoxRange& range) { return range.last < range.first; };
  if (count == 1) return none(ranges[0]) ? 0 : 1;
  std::size_t joined = 0;
  for (std::size_t n = 0; n < count; ++n) {
    BoxRange next = ranges[n];
    if (none(next)) continue;
    std::size_t at = joined;  // those from here on lie wholly beyond it
    for (; at > 0 && ranges[at - 1].first > next.last + 1; --at) {
    }
    std::size_t from = at;
    for (; from > 0 && ranges[from - 1].last + 1 >= next.first; --from)
      next = {std::min(next.first, ranges[from - 1].first), std::max(next.last, ranges[from - 1].last)};
    if (from == at) {
      std::move_backward(ranges + at, ranges + joined, ranges + joined + 1);
      ++joined;
    } else {
      std::move(ranges + at, ranges + joined, ranges + from + 1);
      joined -= at - from - 1;
    }
    ranges[from] = next;
  }
  return joined;
}

void EyeFrusta::set(const std::vector<View>& eyes, const glm::dvec3& origin_m) {
  together_.resize(eyes.size());
  for (std::vector<Across>& axis : across_) axis.resize(eyes.size());
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    const Fov& fov = eyes[e].fov;
    std::array<FrustumPlane, planes_per_eye> planes;
    const glm::dvec3 position = eyes[e].pose.position_m - origin_m;
    std::size_t count = 0;
    const auto add = [&](const glm::dvec3& n, double offset) {
      planes[count++] = {n.x, n.z, offset, std::max(n.y, 0.0), std::min(n.y, 0.0)};
    };
    const glm::dmat3 rotation = glm::mat3_cast(eyes[e].pose.orientation);
    // A point (x, y, z) of eye space is inside while left * -z <= x <= right * -z, likewise for y, and z <= 0.
    for (const glm::dvec3& of_eye :
         {glm::dvec3(1.0, 0.0, fov.left), glm::dvec3(-1.0, 0.0, -fov.right), glm::dvec3(0.0, -1.0, -fov.up),
          glm::dvec3(0.0, 1.0, fov.down), glm::dvec3(0.0, 0.0, -1.0)}) {
      const glm::dvec3 normal = rotation * of_eye;
      add(normal, -glm::dot(normal, position));
    }
    glm::bvec3 all_up(true), all_down(true);
    for (const double x : {fov.left, fov.right})
      for (const double y : {fov.down, fov.up}) {
        const glm::dvec3 ray = rotation * glm::dvec3(x, y, -1.0);
        for (int axis = 0; axis < 3; ++axis) {
          if (ray[axis] < 0.0) all_up[axis] = false;
          if (ray[axis] > 0.0) all_down[axis] = false;
        }
      }
    for (int axis = 0; axis < 3; ++axis) {
      if (!all_up[axis] && !all_down[axis]) continue;
      glm::dvec3 normal(0.0);
      normal[axis] = all_up[axis] ? 1.0 : -1.0;
      add(normal, all_up[axis] ? -position[axis] : position[axis]);
    }
    for (std::size_t axis = 0; axis < 2; ++axis) across_[axis][e] = across(planes.data(), count, axis == 1);
    for (; count < planes_per_eye; ++count) planes[count] = {0.0, 0.0, 1.0, 0.0, 0.0};  // all on its seen side
    together_[e] = side_by_side(planes.data());
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    pairs_[axis].resize((eyes.size() + 1) / 2);
    for (std::size_t pair = 0; pair < pairs_[axis].size(); ++pair)
      pairs_[axis][pair] = two_eyes(&across_[axis][2 * pair], std::min<std::size_t>(eyes.size() - 2 * pair, 2));
  }
}

EyeFrusta::TwoEyes EyeFrusta::two_eyes(const Across* eyes, std::size_t count) {
  constexpr double nowhere = 1e300;
  TwoEyes result;
  result.least_count = result.most_count = 0;
  for (std::size_t lane = 0; lane < count; ++lane) {
    result.least_count = std::max(result.least_count, eyes[lane].turn);
    result.most_count = std::max(result.most_count, eyes[lane].level - eyes[lane].turn);
  }
  for (std::size_t lane = 0; lane < 2; ++lane) {
    const auto fill = [lane](TwoEyes::Plane& to, const Across::Plane* plane, double limit) {
      const Across::Plane none{};
      const Across::Plane& p = plane != nullptr ? *plane : none;
      to.along[lane] = p.along;
      to.across[lane] = p.across;
      to.offset[lane] = p.offset;
      to.up[lane] = p.up;
      to.down[lane] = p.down;
      to.inverse[lane] = p.inverse;
      to.slope[lane] = p.slope;
      to.limit[lane] = limit;
    };
    const std::size_t turn = lane < count ? eyes[lane].turn : 0, level = lane < count ? eyes[lane].level : 0;
    for (std::size_t p = 0; p < result.least_count; ++p) {
      const bool any = p < turn;
      fill(result.least[p], any ? &eyes[lane].planes[p] : nullptr, any ? nowhere : -nowhere);
    }
    for (std::size_t p = 0; p < result.most_count; ++p) {
      const bool any = turn + p < level;
      fill(result.most[p], any ? &eyes[lane].planes[turn + p] : nullptr, any ? -nowhere : nowhere);
    }
  }
  return result;
}

EyeFrusta::Across EyeFrusta::across(const FrustumPlane* planes, std::size_t count, bool along_z) {
  constexpr double level = 1e-9;  // below, a plane is as good as along the axis
  Across result;
  result.end = 0;
  const auto sort_in = [&](const auto& belongs) {
    for (std::size_t p = 0; p < count; ++p) {
      const double along = along_z ? planes[p].z : planes[p].x, other = along_z ? planes[p].x : planes[p].z;
      if (!belongs(along)) continue;
      const double inverse = std::abs(along) > level ? -1.0 / along : 0.0;
      result.planes[result.end++] = {along,          other,   planes[p].offset, planes[p].up,
                                     planes[p].down, inverse, other * inverse};
    }
  };
  sort_in([](double along) { return along > level; });
  result.turn = result.end;
  sort_in([](double along) { return along < -level; });
  result.level = result.end;
  sort_in([](double along) { return std::abs(along) <= level; });
  return result;
}

namespace {
constexpr double far_m = 1e7;         // farther than any box: what a plane as good as along an axis may rise on the way
constexpr double spare = 1e-3;        // of a box, for what doubles lose
constexpr double float_spare = 1e-6;  // of each distance: more than what sums of seven floats lose
namespace hn = hwy::HWY_NAMESPACE;
// Two doubles are a vector that every instruction set has: no run-time dispatch is needed.
using Pair = hn::FixedTag<double, 2>;
}  // namespace

EyeFrusta::SideBySide EyeFrusta::side_by_side(const FrustumPlane* planes) {
  SideBySide result;
  for (std::size_t n = 0; n < planes_per_eye; ++n) {
    const FrustumPlane& p = planes[n];
    const double length = std::sqrt(p.x * p.x + p.z * p.z + (p.up + p.down) * (p.up + p.down));
    const double per = length > 0.0 ? 1.0 / length : 1.0;
    result.x[n] = float(per * p.x);
    result.z[n] = float(per * p.z);
    result.x_size[n] = std::abs(result.x[n]);
    result.z_size[n] = std::abs(result.z[n]);
    result.up[n] = float(per * p.up);
    result.down[n] = float(per * p.down);
    result.offset[n] = float(per * p.offset + float_spare * std::abs(per * p.offset));
  }
  return result;
}

bool EyeFrusta::may_see(const UprightBox& box) const {
  if (together_.empty()) return true;
  const hn::FixedTag<float, 4> d;  // as of pairs: every instruction set has it
  const double lost_m = float_spare * (std::abs(box.x) + std::abs(box.z) + box.half_x + box.half_z + std::abs(box.low) +
                                       std::abs(box.high));
  const auto x = hn::Set(d, float(box.x)), z = hn::Set(d, float(box.z)), half_x = hn::Set(d, float(box.half_x)),
             half_z = hn::Set(d, float(box.half_z));
  const auto high = hn::Set(d, float(box.high)), low = hn::Set(d, float(box.low)), least = hn::Set(d, float(-lost_m));
  for (const SideBySide& p : together_) {
    auto beyond = hn::Zero(d);
    for (std::size_t n = 0; n < planes_per_eye; n += 4) {
      const auto across =
          hn::MulAdd(hn::Load(d, &p.x[n]), x, hn::MulAdd(hn::Load(d, &p.z[n]), z, hn::Load(d, &p.offset[n])));
      const auto size = hn::MulAdd(hn::Load(d, &p.x_size[n]), half_x, hn::Mul(hn::Load(d, &p.z_size[n]), half_z));
      const auto upright = hn::MulAdd(hn::Load(d, &p.up[n]), high, hn::Mul(hn::Load(d, &p.down[n]), low));
      beyond = hn::Or(beyond, hn::VecFromMask(d, hn::Lt(hn::Add(hn::Add(across, size), upright), least)));
    }
    if (hn::AllFalse(d, hn::MaskFromVec(beyond))) return true;
  }
  return false;
}

// A box is beyond a plane where along * its centre's x + rest < 0, so the plane keeps all boxes to one side of -rest /
// along, and rest is linear in the row. Two eyes at a time, one to a lane.
void EyeFrusta::may_see(const BoxGrid& grid, BoxRange rows, BoxRange columns, std::vector<BoxRange>& seen) const {
  const std::size_t eyes = lists();
  const std::size_t ranges = eyes * static_cast<std::size_t>(std::max(rows.last - rows.first + 1, 0));
  if (seen.size() < ranges) seen.resize(ranges);
  if (across_[0].empty()) {
    std::fill_n(seen.begin(), ranges, columns);
    return;
  }
  const double inverse_step = 1.0 / grid.step;
  const Pair d;
  const auto columns_from = hn::Set(d, static_cast<double>(columns.first)),
             columns_to = hn::Set(d, static_cast<double>(columns.last));
  for (std::size_t pair = 0; pair < pairs_[0].size(); ++pair) {
    const TwoEyes& two = pairs_[0][pair];
    const std::size_t first = 2 * pair, lanes = std::min<std::size_t>(eyes - first, 2);
    std::array<double, 2> rows_from{1e9, 1e9}, rows_to{-1e9, -1e9};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Across& eye = across_[0][first + lane];
      double from = rows.first, to = rows.last;
      for (std::size_t p = eye.level; p < eye.end; ++p) {
        const Across::Plane& plane = eye.planes[p];
        const double most = plane.across * grid.z + plane.offset + plane.up * grid.high + plane.down * grid.low +
                            std::abs(plane.along) * grid.half_x + std::abs(plane.across) * grid.half_z +
                            std::abs(plane.along) * far_m;
        const double cut = -most / plane.across * inverse_step;
        if (plane.across > 1e-9)
          from = std::max(from, cut - spare);
        else if (plane.across < -1e-9)
          to = std::min(to, cut + spare);
        else if (most + std::abs(plane.across) * far_m < 0.0)
          to = from - 1.0;
      }
      rows_from[lane] = from;
      rows_to[lane] = to;
    }
    const auto cut = [&](const TwoEyes::Plane& p, double spared) {
      const auto along = hn::LoadU(d, p.along.data()), across = hn::LoadU(d, p.across.data());
      auto rest = hn::Add(hn::Mul(across, hn::Set(d, grid.z)), hn::LoadU(d, p.offset.data()));
      rest = hn::Add(rest, hn::Mul(hn::LoadU(d, p.up.data()), hn::Set(d, grid.high)));
      rest = hn::Add(rest, hn::Mul(hn::LoadU(d, p.down.data()), hn::Set(d, grid.low)));
      rest = hn::Add(rest, hn::Mul(hn::Abs(along), hn::Set(d, grid.half_x)));
      rest = hn::Add(rest, hn::Mul(hn::Abs(across), hn::Set(d, grid.half_z)));
      return hn::Add(
          hn::Mul(hn::Sub(hn::Mul(rest, hn::LoadU(d, p.inverse.data())), hn::Set(d, grid.x)), hn::Set(d, inverse_step)),
          hn::Set(d, spared));
    };
    std::array<TwoEyes::Lanes, planes_per_eye> least_cut, most_cut;
    for (std::size_t p = 0; p < two.least_count; ++p)
      hn::StoreU(hn::Min(cut(two.least[p], -spare), hn::LoadU(d, two.least[p].limit.data())), d, least_cut[p].data());
    for (std::size_t p = 0; p < two.most_count; ++p)
      hn::StoreU(hn::Max(cut(two.most[p], spare), hn::LoadU(d, two.most[p].limit.data())), d, most_cut[p].data());
    BoxRange* of_row = &seen[first];
    for (int row = rows.first; row <= rows.last; ++row, of_row += eyes) {
      const auto at = hn::Set(d, static_cast<double>(row));
      auto least = columns_from, most = columns_to;
      for (std::size_t p = 0; p < two.least_count; ++p)
        least = hn::Max(
            least, hn::Add(hn::LoadU(d, least_cut[p].data()), hn::Mul(hn::LoadU(d, two.least[p].slope.data()), at)));
      for (std::size_t p = 0; p < two.most_count; ++p)
        most = hn::Min(most,
                       hn::Add(hn::LoadU(d, most_cut[p].data()), hn::Mul(hn::LoadU(d, two.most[p].slope.data()), at)));
      std::array<double, 2> begin, end;
      hn::StoreU(least, d, begin.data());
      hn::StoreU(most, d, end.data());
      for (std::size_t lane = 0; lane < lanes; ++lane)
        of_row[lane] = begin[lane] <= end[lane] && row >= rows_from[lane] && row <= rows_to[lane]
                           ? BoxRange{static_cast<int>(std::ceil(begin[lane])), static_cast<int>(std::floor(end[lane]))}
                           : BoxRange{0, -1};
    }
  }
}

// Of a plane the farthest corner of a trapezoid counts, which lies at one of its ends, t, on the inner or the outer
// line: along * t * scale + across * border * scale + rest, which is not below 0 where along * t >= -(rest / scale +
// across * border).
bool EyeFrusta::may_see(const Border& border, const BorderBand& whole,
                        const std::function<std::span<const BorderBand>()>& bands, std::span<BorderRange> seen) const {
  const std::size_t count = lists();
  const double centre_along = border.centre[border.axis], centre_across = border.centre[1 - border.axis];
  const std::vector<Across>& eyes = across_[static_cast<std::size_t>(border.axis)];
  const auto spared = [&](double least, double most) {
    const double lost = 1e-12 * (border.half + std::abs(least) + std::abs(most));
    return BorderRange{least - lost, most + lost};
  };
  if (eyes.empty()) {
    std::fill(seen.begin(), seen.end(), spared(-border.half, border.half));
    return true;
  }
  const Pair d;
  const auto zero = hn::Zero(d);
  const BorderRange nothing{border.half, -border.half};
  std::span<const BorderBand> all;
  bool any = false;
  for (std::size_t pair = 0; pair < pairs_[0].size(); ++pair) {
    const TwoEyes& two = pairs_[static_cast<std::size_t>(border.axis)][pair];
    const std::size_t first = 2 * pair, lanes = std::min<std::size_t>(eyes.size() - first, 2);
    // Of a plane what no band changes: its value at the centre, raised by what trapezoids grow, and what the border
    // adds.
    struct Whole {
      TwoEyes::Lanes everywhere, across;
    };
    std::array<Whole, planes_per_eye> least_of, most_of;
    const auto prepare = [&](const TwoEyes::Plane& p, Whole& to) {
      const auto along = hn::LoadU(d, p.along.data()), across = hn::LoadU(d, p.across.data());
      auto everywhere = hn::Add(hn::Mul(along, hn::Set(d, centre_along)), hn::Mul(across, hn::Set(d, centre_across)));
      everywhere = hn::Add(hn::Add(everywhere, hn::LoadU(d, p.offset.data())),
                           hn::Mul(hn::Add(hn::Abs(along), hn::Abs(across)), hn::Set(d, border.grow)));
      hn::StoreU(everywhere, d, to.everywhere.data());
      hn::StoreU(hn::Mul(across, hn::Set(d, border.border)), d, to.across.data());
    };
    for (std::size_t p = 0; p < two.least_count; ++p) prepare(two.least[p], least_of[p]);
    for (std::size_t p = 0; p < two.most_count; ++p) prepare(two.most[p], most_of[p]);
    const auto ranges_of = [&](const BorderBand& band, BorderRange* to) {
      const auto high = hn::Set(d, band.high), low = hn::Set(d, band.low), per_inner = hn::Set(d, band.per_inner),
                 per_outer = hn::Set(d, band.per_outer);
      const auto cut = [&](const TwoEyes::Plane& p, const Whole& of) {
        const auto rest = hn::Add(hn::Add(hn::LoadU(d, of.everywhere.data()), hn::Mul(hn::LoadU(d, p.up.data()), high)),
                                  hn::Mul(hn::LoadU(d, p.down.data()), low));
        const auto farthest = hn::Add(hn::Mul(rest, hn::IfThenElse(hn::Gt(rest, zero), per_inner, per_outer)),
                                      hn::LoadU(d, of.across.data()));
        return hn::Mul(farthest, hn::LoadU(d, p.inverse.data()));
      };
      auto least = hn::Set(d, -border.half), most = hn::Set(d, border.half);
      for (std::size_t p = 0; p < two.least_count; ++p)
        least = hn::Max(least, hn::Min(cut(two.least[p], least_of[p]), hn::LoadU(d, two.least[p].limit.data())));
      for (std::size_t p = 0; p < two.most_count; ++p)
        most = hn::Min(most, hn::Max(cut(two.most[p], most_of[p]), hn::LoadU(d, two.most[p].limit.data())));
      TwoEyes::Lanes from, end;
      hn::StoreU(least, d, from.data());
      hn::StoreU(most, d, end.data());
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Across& eye = eyes[first + lane];
        for (std::size_t p = eye.level; p < eye.end; ++p) {
          const Across::Plane& plane = eye.planes[p];
          const double everywhere = plane.along * centre_along + plane.across * centre_across + plane.offset +
                                    (std::abs(plane.along) + std::abs(plane.across)) * border.grow;
          const double rest = everywhere + plane.up * band.high + plane.down * band.low;
          const double farthest = rest * (rest > 0.0 ? band.per_inner : band.per_outer) + plane.across * border.border;
          if (farthest + std::abs(plane.along) * border.half < 0.0) end[lane] = -2.0 * border.half;
        }
        to[lane] = spared(from[lane], end[lane]);
      }
    };
    std::array<BorderRange, 2> of_whole;
    ranges_of(whole, of_whole.data());
    bool sees = false;
    for (std::size_t lane = 0; lane < lanes; ++lane) sees = sees || of_whole[lane].least <= of_whole[lane].most;
    if (sees && !any) {
      all = bands();
      for (std::size_t b = 0; b < all.size(); ++b)
        std::fill_n(&seen[b * count], first, nothing);  // as the eyes before have seen
    }
    any = any || sees;
    for (std::size_t b = 0; b < all.size(); ++b) {
      BorderRange* const to = &seen[b * count + first];
      if (sees)
        ranges_of(all[b], to);
      else
        std::fill_n(to, lanes, nothing);
    }
  }
  return any;
}

}  // namespace seascape
