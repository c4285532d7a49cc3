#include "ocean/bodies/swamping.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/error.h"

namespace seascape {

// Sums over tetrahedra between a point of the level and what of each triangle lies below it: the cut itself, whose
// plane has that point, adds nothing.
Filled below_level(const HullMesh& mesh, const glm::dmat3& to_world, double level) {
  Filled out;
  const glm::dvec3 apex(0.0, level, 0.0);
  const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double v = glm::dot(a, glm::cross(b, c)) / 6.0;
    out.volume_m3 += v, out.centre_m += 0.25 * v * (a + b + c);
  };
  for (const auto& t : mesh.triangles) {
    std::array<glm::dvec3, 3> p;
    int low = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = to_world * mesh.vertices[t[i]] - apex;
      low += p[i].y < 0.0;
    }
    const auto cut = [](const glm::dvec3& a, const glm::dvec3& b) { return a + a.y / (a.y - b.y) * (b - a); };
    const auto rotate_until = [&](bool first_is_low) {
      while ((p[0].y < 0.0) != first_is_low) std::rotate(p.begin(), p.begin() + 1, p.end());
    };
    if (low == 3) {
      add(p[0], p[1], p[2]);
    } else if (low == 1) {
      rotate_until(true);
      add(p[0], cut(p[0], p[1]), cut(p[0], p[2]));
    } else if (low == 2) {
      rotate_until(false);
      const glm::dvec3 first = cut(p[1], p[0]), last = cut(p[2], p[0]);
      add(first, p[1], p[2]);
      add(first, p[2], last);
    }
  }
  if (out.volume_m3 > 0.0) out.centre_m = out.centre_m / out.volume_m3 + apex;
  return out;
}

Inside::Inside(const InsideSpec& spec, const glm::dvec3& mass_centre, const char* where) {
  if (!spec.hull) return;
  validate(*spec.hull, where);
  if (!(spec.bail_kg_s >= 0.0 && spec.bail_kg_s < 1e9 && spec.weir > 0.0 && spec.weir <= 1.0))
    throw Error(where, "what is bailed, or the weir's coefficient, is out of range",
                "give bail_kg_s of 0 or more, and a coefficient of 0 to 1");
  mesh_ = *spec.hull;
  for (glm::dvec3& v : mesh_.vertices) v -= mass_centre;
  // The gunwale is where the lid, whose triangles look up, meets what does not.
  const auto looks_up = [&](std::size_t triangle) {
    const auto& t = mesh_.triangles[triangle];
    const glm::dvec3 normal =
        glm::cross(mesh_.vertices[t[1]] - mesh_.vertices[t[0]], mesh_.vertices[t[2]] - mesh_.vertices[t[0]]);
    return normal.y > 0.5 * glm::length(normal);
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<bool, bool>> sides;  // looks up; does not
  for (std::size_t n = 0; n < mesh_.triangles.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh_.triangles[n][i], b = mesh_.triangles[n][(i + 1) % 3];
      auto& side = sides[{std::min(a, b), std::max(a, b)}];
      (looks_up(n) ? side.first : side.second) = true;
    }
  const double piece = 0.1 * std::cbrt(volume_of(mesh_).volume_m3);
  for (const auto& [ends, side] : sides)
    if (side.first && side.second) {
      const glm::dvec3 a = mesh_.vertices[ends.first], b = mesh_.vertices[ends.second];
      // In pieces, for a long side goes under bit by bit.
      const int pieces = std::max(int(std::ceil(glm::length(b - a) / piece)), 1);
      for (int i = 0; i < pieces; ++i) gunwale_.push_back({a + (i + 0.5) / pieces * (b - a), (b - a) / double(pieces)});
    }
  if (gunwale_.empty()) throw Error(where, "the inside has no lid that looks up", "close it at the gunwale");
  volume_m3_ = volume_of(mesh_).volume_m3;
  weir_ = spec.weir;
}

Inside::Pool Inside::pool(const glm::dmat3& to_world, double filled) const {
  double low = 1e300, high = -1e300;
  for (const glm::dvec3& v : mesh_.vertices) {
    const double y = (to_world * v).y;
    low = std::min(low, y), high = std::max(high, y);
  }
  filled = std::clamp(filled, 0.0, volume_m3_);
  // A false position whose end that stays is halved (Illinois; Dowell and Jarratt 1971).
  double low_miss = -filled, high_miss = volume_m3_ - filled, level = high;
  int last = 0;
  Filled here = below_level(mesh_, to_world, high);
  for (int n = 0; n < 60 && low_miss < 0.0 && high_miss > 0.0; ++n) {
    level = low - low_miss * (high - low) / (high_miss - low_miss);
    here = below_level(mesh_, to_world, level);
    const double miss = here.volume_m3 - filled;
    if (std::abs(miss) <= 1e-9 * volume_m3_) break;
    const int side = miss < 0.0 ? -1 : 1;
    if (side < 0) {
      low = level, low_miss = miss;
      if (last == side) high_miss *= 0.5;
    } else {
      high = level, high_miss = miss;
      if (last == side) low_miss *= 0.5;
    }
    last = side;
  }
  if (!(filled > 0.0)) return {low, here.centre_m};
  return {level, here.centre_m};
}

double Inside::flow_m3_s(const BodyPose& pose, const WaterPatch& water, const Pool& pool, double filled,
                         double gravity) const {
  double in = 0.0, out = 0.0;
  bool all_under = true;
  const double pool_level = filled > 0.0 ? pose.centre_m.y + pool.level_m : -1e300;
  for (const Edge& edge : gunwale_) {
    const glm::dvec3 at = pose.centre_m + pose.to_world * edge.middle_m, along = pose.to_world * edge.along_m;
    const glm::dvec2 place(at.x, at.z);
    const double outside = water.dry(place) ? -1e300 : water.height(place) - at.y, inside = pool_level - at.y;
    all_under = all_under && outside > 0.0;
    const double more = std::max(outside, inside), less = std::max(std::min(outside, inside), 0.0);
    if (!(more > less)) continue;
    const double free = 2.0 / 3.0 * weir_ * glm::length(along) * std::sqrt(2.0 * gravity) * more * std::sqrt(more),
                 part = less / more;
    const double flow = free * std::pow(1.0 - part * std::sqrt(part), 0.385);
    (outside > inside ? in : out) += flow;
  }
  if (all_under && pose.to_world[1].y < 0.0) in = 0.0;
  return in - out;
}

Matrix6 mass_at(const glm::dvec3& place, double kg) {
  Matrix6 out;
  out.add_at(place, glm::dmat3(kg));
  return out;
}

}  // namespace seascape
