#include "ocean/lod/culling.h"

#include <algorithm>
#include <cmath>

namespace seascape {

void EyeFrusta::set(const std::vector<View>& eyes, const glm::dvec3& origin_m) {
  planes_.resize(eyes.size() * planes_per_eye);
  row_planes_.resize(eyes.size());
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
    RowPlanes& rows = row_planes_[e];
    rows.end = 0;
    const auto sort_in = [&](const auto& belongs) {
      for (std::size_t p = 0; p < count; ++p)
        if (belongs(planes[p].x)) {
          rows.planes[rows.end] = planes[p];
          rows.inverse_x[rows.end++] = planes[p].x == 0.0 ? 0.0 : 1.0 / planes[p].x;
        }
    };
    constexpr double level = 1e-9;  // below, a plane is as good as along x
    sort_in([](double x) { return x > level; });
    rows.turn = rows.end;
    sort_in([](double x) { return x < -level; });
    rows.level = rows.end;
    sort_in([](double x) { return std::abs(x) <= level; });
    for (; count < planes_per_eye; ++count) planes[count] = {0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  }
}

// A box is beyond a plane where x * centre_x + rest < 0, so the plane keeps all boxes to one side of -rest / x. A thousandth of a
// box more, for what doubles lose.
std::size_t EyeFrusta::may_see(const BoxRow& row, BoxRange range, std::vector<BoxRange>& seen) const {
  seen.resize(std::max<std::size_t>(row_planes_.size(), 1));
  if (row_planes_.empty()) {
    seen[0] = range;
    return range.first <= range.last ? 1 : 0;
  }
  const double inverse_step = 1.0 / row.step;
  std::size_t count = 0;
  for (const RowPlanes& eye : row_planes_) {
    const auto rest = [&](const FrustumPlane& p) { return p.z * row.z + p.offset + p.up * row.high + p.down * row.low + std::abs(p.x) * row.half_x + std::abs(p.z) * row.half_z; };
    bool beyond = false;
    for (std::size_t p = eye.level; p < eye.end; ++p) beyond |= rest(eye.planes[p]) + std::abs(eye.planes[p].x) * 1e7 < 0.0;
    if (beyond) continue;
    double least = -1e9, most = 1e9;
    for (std::size_t p = 0; p < eye.turn; ++p) least = std::max(least, -rest(eye.planes[p]) * eye.inverse_x[p]);
    for (std::size_t p = eye.turn; p < eye.level; ++p) most = std::min(most, -rest(eye.planes[p]) * eye.inverse_x[p]);
    least = std::max((least - row.x) * inverse_step - 1e-3, static_cast<double>(range.first));
    most = std::min((most - row.x) * inverse_step + 1e-3, static_cast<double>(range.last));
    if (!(least <= most)) continue;
    const BoxRange here{static_cast<int>(std::ceil(least)), static_cast<int>(std::floor(most))};
    if (here.last >= here.first) seen[count++] = here;
  }
  if (count < 2) return count;
  // Eyes that see the same boxes see them once.
  std::sort(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count), [](const BoxRange& a, const BoxRange& b) { return a.first < b.first; });
  std::size_t apart = 1;
  for (std::size_t n = 1; n < count; ++n) {
    BoxRange& before = seen[apart - 1];
    if (seen[n].first <= before.last + 1)
      before.last = std::max(before.last, seen[n].last);
    else
      seen[apart++] = seen[n];
  }
  return apart;
}

}  // namespace seascape
