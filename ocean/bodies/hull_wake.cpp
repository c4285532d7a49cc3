#include "ocean/bodies/hull_wake.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace seascape {
namespace {

constexpr double pi = std::numbers::pi;
// The wave number, times the hull's draught, that sources are right at: theirs are within 3 % of Wigley's drag by
// Michell from Froude 0.25 to 1.
constexpr double number_at_draught = 1.6;
constexpr int sideways_together = 4;  // sections that push sideways by one pair of sources

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// What a wave of number k feels of a section's area, as a share of it: the mean of exp(-k depth).
double felt(const HullSection& s, double k) { return std::exp(-k * s.depth_m + 0.5 * k * k * s.spread_m2); }

}  // namespace

HullWake::HullWake(const HullMesh& mesh, int sections) {
  double bow = mesh.vertices.front().z, stern = bow;
  for (const glm::dvec3& v : mesh.vertices) bow = std::min(bow, v.z), stern = std::max(stern, v.z);
  sections = std::clamp(sections, 4, 64);
  part_m_ = (stern - bow) / sections;
  outlines_.resize(std::size_t(sections));
  for (int i = 0; i < sections; ++i) at_z_.push_back(stern - (i + 0.5) * part_m_);
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]],
                     normal = glm::cross(b - a, c - a);
    for (std::size_t i = 0; i < at_z_.size(); ++i) {
      // A corner in the plane counts as behind it, for all triangles alike: outlines close.
      std::array<glm::dvec2, 2> ends;
      std::size_t found = 0;
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        if ((p.z < at_z_[i]) != (q.z < at_z_[i]) && found < 2) {
          // From the same end whichever way the side runs, so that neighbours meet to the bit.
          const glm::dvec3 &low = p.z < q.z ? p : q, &high = p.z < q.z ? q : p;
          ends[found++] = glm::mix(glm::dvec2(low), glm::dvec2(high), (at_z_[i] - low.z) / (high.z - low.z));
        }
      if (found < 2 || ends[0] == ends[1]) continue;
      const glm::dvec2 along = ends[1] - ends[0];
      if (along.y * normal.x - along.x * normal.y < 0.0) std::swap(ends[0], ends[1]);
      outlines_[i].push_back({ends[0], ends[1]});
    }
  }
}

// Sums over the triangles between a place on the waterline and each wetted line: what closes the outline along the
// waterline adds nothing.
void HullWake::cut_outline(std::span<const Line> outline, double depth_of_axis, const glm::dvec2& up,
                           HullSection& section, glm::dvec2& middle) {
  const double steep2 = glm::dot(up, up);
  const glm::dvec2 origin = depth_of_axis / steep2 * up, across = glm::dvec2(up.y, -up.x) / std::sqrt(steep2);
  double area = 0.0, first = 0.0, second = 0.0, chord = 0.0, chord2 = 0.0;
  glm::dvec2 moment(0.0);
  for (const Line& line : outline) {
    glm::dvec2 a = line.from - origin, b = line.to - origin;
    double da = -glm::dot(a, up), db = -glm::dot(b, up);
    if (da <= 0.0 && db <= 0.0) continue;
    if (da < 0.0 || db < 0.0) {
      const glm::dvec2 crossing = a + da / (da - db) * (b - a);
      const double at = glm::dot(crossing, across), sign = da < 0.0 ? -1.0 : 1.0;  // the water is left there, or met
      chord += sign * at, chord2 += 0.5 * sign * at * at;
      (da < 0.0 ? a : b) = crossing;
      (da < 0.0 ? da : db) = 0.0;
    } else if (da == 0.0 || db == 0.0) {
      // Its other end's line lies above: the waterline ends here.
      const double at = glm::dot(da == 0.0 ? a : b, across), sign = da == 0.0 ? -1.0 : 1.0;
      chord += sign * at, chord2 += 0.5 * sign * at * at;
    }
    const double part = 0.5 * cross(a, b);
    area += part, first += part * (da + db) / 3.0, second += part * (da * da + db * db + da * db) / 6.0;
    moment += part / 3.0 * (a + b);
    section.draught_m = std::max({section.draught_m, da, db});
  }
  if (!(area > 0.0)) {
    section.draught_m = 0.0;
    return;
  }
  section.area_m2 = area;
  section.depth_m = std::max(first / area, 0.0);
  section.spread_m2 = std::max(second / area - section.depth_m * section.depth_m, 0.0);
  section.breadth_m = std::max(chord, 0.0);
  middle = origin + (section.breadth_m > 0.0 ? chord2 / chord * across : moment / area);
}

void HullWake::cut(const HullMotion& motion, const Height& height, std::span<HullSection> cut) const {
  const glm::dmat3& turn = motion.pose.to_world;
  const glm::dvec2 up(turn[0].y, turn[1].y);  // of the section's plane
  const bool on_end = std::abs(turn[2].y) > 0.98;
  for (std::size_t i = 0; i < outlines_.size(); ++i) {
    HullSection& section = cut[i];
    section = {};
    const glm::dvec3 axis = motion.pose.centre_m + at_z_[i] * turn[2];
    section.place_m = {axis.x, axis.z};
    section.surface_m = height(section.place_m);
    glm::dvec2 middle(0.0);
    if (!on_end) cut_outline(outlines_[i], section.surface_m - axis.y, up, section, middle);
    const glm::dvec3 there = axis + middle.x * turn[0] + middle.y * turn[1];
    section.place_m = {there.x, there.z};
    section.velocity_mps =
        motion.velocity.linear + glm::cross(motion.velocity.angular, there - motion.pose.centre_m) - motion.water_mps;
  }
}

void HullWake::add_sources(const HullMotion& motion, std::span<const HullSection> cut, double least_length,
                           std::vector<WaveSource>& sources) const {
  const glm::dvec3 bow = -motion.pose.to_world[2];
  const double level = std::hypot(bow.x, bow.z);
  if (!(level > 0.0)) return;
  const glm::dvec2 ahead = glm::dvec2(bow.x, bow.z) / level, right(-ahead.y, ahead.x);
  const double part = part_m_ * level, length = std::max(least_length, part);
  double deepest = 0.0;
  for (const HullSection& s : cut) deepest = std::max(deepest, s.draught_m);
  if (!(deepest > 0.0)) return;
  const double k = number_at_draught / deepest;
  const auto speed = [](const HullSection& s, const glm::dvec2& along) {
    return s.velocity_mps.x * along.x + s.velocity_mps.z * along.y;
  };
  const auto push = [&](const glm::dvec2& at, const HullSection& s, double flow, double depth) {
    if (flow == 0.0) return;
    const glm::dvec3 over_ground = s.velocity_mps + motion.water_mps;
    sources.push_back({at, {over_ground.x, over_ground.z}, length, 0.0, flow * pi / (length * length), depth});
  };
  const HullSection none;
  const int count = int(cut.size());
  for (int i = 0; i <= count; ++i) {
    const HullSection &behind = i > 0 ? cut[std::size_t(i) - 1] : none,
                      &before = i < count ? cut[std::size_t(i)] : none, &nearer = i > 0 ? behind : before;
    // Beyond the last sections the hull ends half a part on: the middle of that.
    const glm::dvec2 at = i == 0       ? before.place_m - 0.25 * part * ahead
                          : i == count ? behind.place_m + 0.25 * part * ahead
                                       : 0.5 * (behind.place_m + before.place_m);
    const double u_behind = speed(behind, ahead), u_before = speed(before, ahead);
    // What a section displaces by sinking goes half to each of its ends.
    const double by_behind = u_behind * behind.area_m2 - 0.5 * part * behind.breadth_m * behind.velocity_mps.y,
                 by_before = -u_before * before.area_m2 - 0.5 * part * before.breadth_m * before.velocity_mps.y,
                 flow = by_behind + by_before;
    if (flow == 0.0) continue;
    const double share = (by_behind * felt(behind, k) + by_before * felt(before, k)) / flow,
                 own = k * length * length / (4.0 * pi * pi),
                 depth = std::clamp(-std::log(std::max(share, std::exp(-k * deepest))) / k - own, 0.0, deepest);
    push(at, nearer, flow, depth);
  }
  for (int i = 0; i < count; i += sideways_together) {
    double flow = 0.0, breadth = 0.0, weight = 0.0;
    glm::dvec2 at(0.0);
    const int end = std::min(i + sideways_together, count);
    for (int j = i; j < end; ++j) {
      const HullSection& s = cut[std::size_t(j)];
      flow += speed(s, right) * s.draught_m * part;
      breadth += s.draught_m * s.breadth_m, at += s.draught_m * s.place_m, weight += s.draught_m;
    }
    if (!(weight > 0.0)) continue;
    const HullSection& middle = cut[std::size_t((i + end) / 2)];
    const glm::dvec2 side = 0.5 * breadth / weight * right;
    push(at / weight + side, middle, flow, 0.5 * middle.draught_m);
    push(at / weight - side, middle, -flow, 0.5 * middle.draught_m);
  }
}

}  // namespace seascape
