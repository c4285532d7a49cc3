#include "ocean/lod/culling.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

namespace seascape {

void EyeFrusta::set(const std::vector<View>& eyes, const glm::dvec3& origin_m) {
  planes_.resize(eyes.size() * planes_per_eye);
  for (std::vector<Across>& axis : across_) axis.resize(eyes.size());
  all_ = none;
  for (std::size_t e = 0; e < eyes.size(); ++e) {
    const Fov& fov = eyes[e].fov;
    FrustumPlane* const planes = &planes_[e * planes_per_eye];
    const glm::dvec3 position = eyes[e].pose.position_m - origin_m;
    std::size_t count = 0;
    const auto add = [&](const glm::dvec3& n, double offset) {
      planes[count++] = {n.x, n.z, offset, std::max(n.y, 0.0), std::min(n.y, 0.0), std::abs(n.x) + std::abs(n.z)};
    };
    const glm::dmat3 rotation = glm::mat3_cast(eyes[e].pose.orientation);
    // A point (x, y, z) of eye space is inside while left * -z <= x <= right * -z, likewise for y, and z <= 0.
    for (const glm::dvec3& of_eye : {glm::dvec3(1.0, 0.0, fov.left), glm::dvec3(-1.0, 0.0, -fov.right), glm::dvec3(0.0, -1.0, -fov.up),
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
    if (e < most_eyes) all_ |= ((Questions{1} << count) - 1) << (8 * e);
    for (std::size_t axis = 0; axis < 2; ++axis) across_[axis][e] = across(planes, count, axis == 1);
    for (; count < planes_per_eye; ++count) planes[count] = {0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  }
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
      result.planes[result.end++] = {along, other, planes[p].offset, planes[p].up, planes[p].down, inverse, other * inverse};
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
constexpr double far_m = 1e7;  // farther than any box: what a plane as good as along an axis may rise on the way
constexpr double spare = 1e-3;  // of a box, for what doubles lose
namespace hn = hwy::HWY_NAMESPACE;
// Two doubles are a vector that every instruction set has: no run-time dispatch is needed.
using Pair = hn::FixedTag<double, 2>;
}  // namespace

// A box is beyond a plane where along * its centre's x + rest < 0, so the plane keeps all boxes to one side of -rest / along, and rest is
// linear in the row. Two eyes at a time, one to a lane.
void EyeFrusta::may_see(const BoxGrid& grid, BoxRange rows, BoxRange columns, std::vector<BoxRange>& seen) const {
  const std::size_t eyes = lists();
  seen.resize(eyes * static_cast<std::size_t>(std::max(rows.last - rows.first + 1, 0)));
  if (across_[0].empty()) {
    std::fill(seen.begin(), seen.end(), columns);
    return;
  }
  const double inverse_step = 1.0 / grid.step;
  for (std::size_t first = 0; first < eyes; first += 2) {
    const std::size_t lanes = std::min<std::size_t>(eyes - first, 2);
    std::array<std::array<double, 2>, planes_per_eye> least_cut, least_slope, most_cut, most_slope;
    std::array<double, 2> rows_from{1e9, 1e9}, rows_to{-1e9, -1e9};
    std::array<std::size_t, 2> least_count{}, most_count{};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Across& eye = across_[0][first + lane];
      const auto rest = [&](const Across::Plane& p) {
        return p.across * grid.z + p.offset + p.up * grid.high + p.down * grid.low + std::abs(p.along) * grid.half_x + std::abs(p.across) * grid.half_z;
      };
      double from = rows.first, to = rows.last;
      for (std::size_t p = eye.level; p < eye.end; ++p) {
        const Across::Plane& plane = eye.planes[p];
        const double most = rest(plane) + std::abs(plane.along) * far_m, cut = -most / plane.across * inverse_step;
        if (plane.across > 1e-9)
          from = std::max(from, cut - spare);
        else if (plane.across < -1e-9)
          to = std::min(to, cut + spare);
        else if (most + std::abs(plane.across) * far_m < 0.0)
          to = from - 1.0;
      }
      rows_from[lane] = from;
      rows_to[lane] = to;
      const auto cut = [&](std::size_t p, double spared) { return (rest(eye.planes[p]) * eye.planes[p].inverse - grid.x) * inverse_step + spared; };
      for (std::size_t p = 0; p < eye.turn; ++p) {
        least_cut[p][lane] = cut(p, -spare);
        least_slope[p][lane] = eye.planes[p].slope;
      }
      for (std::size_t p = eye.turn; p < eye.level; ++p) {
        most_cut[p - eye.turn][lane] = cut(p, spare);
        most_slope[p - eye.turn][lane] = eye.planes[p].slope;
      }
      least_count[lane] = eye.turn;
      most_count[lane] = eye.level - eye.turn;
    }
    // A lane that has fewer planes is cut by none in their stead.
    const std::size_t least_planes = std::max(least_count[0], least_count[1]), most_planes = std::max(most_count[0], most_count[1]);
    for (std::size_t lane = 0; lane < 2; ++lane) {
      for (std::size_t p = least_count[lane]; p < least_planes; ++p) least_cut[p][lane] = -1e300, least_slope[p][lane] = 0.0;
      for (std::size_t p = most_count[lane]; p < most_planes; ++p) most_cut[p][lane] = 1e300, most_slope[p][lane] = 0.0;
    }
    const Pair d;
    const auto columns_from = hn::Set(d, static_cast<double>(columns.first)), columns_to = hn::Set(d, static_cast<double>(columns.last));
    BoxRange* of_row = &seen[first];
    for (int row = rows.first; row <= rows.last; ++row, of_row += eyes) {
      const auto at = hn::Set(d, static_cast<double>(row));
      auto least = columns_from, most = columns_to;
      for (std::size_t p = 0; p < least_planes; ++p)
        least = hn::Max(least, hn::Add(hn::LoadU(d, least_cut[p].data()), hn::Mul(hn::LoadU(d, least_slope[p].data()), at)));
      for (std::size_t p = 0; p < most_planes; ++p)
        most = hn::Min(most, hn::Add(hn::LoadU(d, most_cut[p].data()), hn::Mul(hn::LoadU(d, most_slope[p].data()), at)));
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

// Of a plane the farthest corner of a trapezoid counts, which lies at one of its ends, t, on the inner or the outer line: along * t * scale +
// across * border * scale + rest, which is not below 0 where along * t >= -(rest / scale + across * border).
void EyeFrusta::may_see(const Border& border, std::span<const BorderBand> bands, std::span<BorderRange> seen) const {
  const std::size_t count = lists();
  std::fill(seen.begin(), seen.end(), BorderRange{-border.half, border.half});
  const double centre_along = border.centre[border.axis], centre_across = border.centre[1 - border.axis];
  const std::vector<Across>& eyes = across_[static_cast<std::size_t>(border.axis)];
  for (std::size_t e = 0; e < eyes.size(); ++e)
    for (std::size_t p = 0; p < eyes[e].end; ++p) {
      const Across::Plane& plane = eyes[e].planes[p];
      const double everywhere = plane.along * centre_along + plane.across * centre_across + plane.offset + (std::abs(plane.along) + std::abs(plane.across)) * border.grow;
      const double across = plane.across * border.border;
      for (std::size_t b = 0; b < bands.size(); ++b) {
        const BorderBand& band = bands[b];
        BorderRange& range = seen[b * count + e];
        const double rest = everywhere + plane.up * band.high + plane.down * band.low;
        const double most = (rest > 0.0 ? rest * band.per_inner : rest * band.per_outer) + across;
        if (p < eyes[e].turn)
          range.least = std::max(range.least, most * plane.inverse);
        else if (p < eyes[e].level)
          range.most = std::min(range.most, most * plane.inverse);
        else if (most + std::abs(plane.along) * border.half < 0.0)
          range.most = -2.0 * border.half;
      }
    }
  for (BorderRange& range : seen) {
    const double lost = 1e-12 * (border.half + std::abs(range.least) + std::abs(range.most));
    range = {range.least - lost, range.most + lost};
  }
}

}  // namespace seascape
