#include "ocean/bodies/planing_bottom.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180.0;
constexpr double no_impact_rad = 75.0 * degree;  // of deadrise, where K is 0
constexpr double pile_up = 0.5 * pi;
// Of half of a station, over its breadth b: its potential goes as sqrt(b^2 - y^2), and as b grows the pressure as
// 1 / sqrt(b^2 - y^2) (Wagner 1932).
constexpr double centroid = 4.0 / (3.0 * pi), impact_centroid = 2.0 / pi;
const double steepest = std::tan(60.0 * degree);
// The least deadrise of a flat bottom: its wetted breadth grows over some depth rather than at once.
const double flattest = std::tan(3.0 * degree);

// Where a plane of one z cuts a triangle, as two ends; false where it does not.
bool cut_at(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double z, glm::dvec2 (&ends)[2]) {
  int count = 0;
  const auto side = [&](const glm::dvec3& p, const glm::dvec3& q) {
    if ((p.z < z) == (q.z < z) || count == 2) return;
    const glm::dvec3 at = p + (q - p) * ((z - p.z) / (q.z - p.z));
    ends[count++] = {at.x, at.y};
  };
  side(a, b), side(b, c), side(c, a);
  return count == 2;
}

}  // namespace

// A station: where a plane across the hull cuts its skin.
struct PlaningBottom::Outline {
  std::vector<std::array<glm::dvec2, 2>> segments;  // x, y
  std::array<double, 2> breadth_m{};                // to port, to starboard

  // The lowest of the hull, at a distance from the middle to a side; 1e300 where there is none.
  double lowest(double to_side, double x_m) const {
    const double most = breadth_m[to_side < 0.0 ? 0 : 1];
    const double x = to_side * std::clamp(x_m, 1e-5 * most, (1.0 - 1e-5) * most);  // not where two segments meet
    double low = 1e300;
    for (const auto& [a, b] : segments)
      if ((a.x < x) != (b.x < x)) low = std::min(low, a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)));
    return low;
  }
};

PlaningBottom::PlaningBottom(const HullMesh& mesh) {
  double front = 1e300, back = -1e300;
  for (const glm::dvec3& v : mesh.vertices) front = std::min(front, v.z), back = std::max(back, v.z);
  if (!(back > front)) return;
  spacing_m_ = (back - front) / stations;
  for (int i = 0; i < stations; ++i) {
    // Half a spacing before the end there is still all of a hull that a transom ends.
    const double z = front + (i + 0.5) * spacing_m_;
    Outline outline;
    for (const auto& t : mesh.triangles) {
      glm::dvec2 ends[2];
      if (!cut_at(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], z, ends)) continue;
      outline.segments.push_back({ends[0], ends[1]});
      for (const glm::dvec2& at : ends)
        for (const int s : {0, 1}) {
          double& breadth = outline.breadth_m[std::size_t(s)];
          breadth = std::max(breadth, s == 0 ? -at.x : at.x);
        }
    }
    Station station;
    station.keel_m = {0.0, 1e300, z};
    for (const auto& segment : outline.segments)
      for (const glm::dvec2& at : segment) station.keel_m.y = std::min(station.keel_m.y, at.y);
    if (outline.segments.empty()) station.keel_m.y = 0.0;
    for (const int s : {0, 1}) station.sides[std::size_t(s)] = side_of(outline, s == 0 ? -1.0 : 1.0, station.keel_m.y);
    stations_.push_back(station);
  }
}

PlaningBottom::Side PlaningBottom::side_of(const Outline& outline, double to_side, double keel) {
  Side side;
  const double breadth = outline.breadth_m[to_side < 0.0 ? 0 : 1];
  if (!(breadth > 0.0)) return side;
  const auto slope = [&](double from, double to) {
    return std::abs(outline.lowest(to_side, to) - outline.lowest(to_side, from)) / (to - from);
  };
  // The chine is where some bottom ends.
  constexpr int fine = 64;
  double chine = breadth;
  bool wide = false;
  for (int k = 0; k < fine && chine == breadth; ++k) {
    const double from = breadth * k / fine, to = breadth * (k + 1) / fine;
    if (slope(from, to) <= steepest)
      wide = true;
    else if (wide)
      chine = from;
  }
  for (int k = 0; k < cells; ++k) {
    const bool before = k < inner_cells;
    const double width = before ? chine / inner_cells : (breadth - chine) / (cells - inner_cells);
    const double x = before ? width * k : chine + width * (k - inner_cells);
    if (!(width > 1e-9 * breadth)) continue;
    const double inner = outline.lowest(to_side, x) - keel, outer = outline.lowest(to_side, x + width) - keel;
    if (!(inner < 1e200 && outer < 1e200) || (!before && slope(x, x + width) > steepest)) continue;
    const double tangent = slope(x, x + width);
    side.bottom[std::size_t(side.count++)] = {std::max(inner, flattest * x),
                                              std::max(outer, flattest * (x + width)),
                                              x,
                                              width,
                                              tangent,
                                              std::atan(tangent),
                                              before};
  }
  return side;
}

PlaningBottom::Half PlaningBottom::half_of(const Side& side, double to_side, double depth, double heel, double cosine,
                                           double sine) {
  Half out;
  double slopes = 0.0, deadrises = 0.0;
  for (int k = 0; k < side.count; ++k) {
    const Cell& cell = side.bottom[std::size_t(k)];
    // Heights over the keel, of the heeled station.
    double low = cell.inner_m * cosine + to_side * cell.x_m * sine;
    double high = cell.outer_m * cosine + to_side * (cell.x_m + cell.width_m) * sine;
    if (low > high) std::swap(low, high);
    const double reaches = (cell.before_chine ? pile_up : 1.0) * depth;
    if (!(reaches > low)) continue;
    const double width = reaches >= high ? cell.width_m : cell.width_m * ((reaches - low) / (high - low));
    out.width_m += width, slopes += width * cell.slope, deadrises += width * cell.deadrise;
  }
  if (!(out.width_m > 0.0)) return out;
  // Of the heeled station: a hull rights itself on the side that lies flatter.
  out.slope = slopes / out.width_m;
  const double deadrise = deadrises / out.width_m + to_side * heel;
  out.mass_kg_m = 0.25 * pi * out.width_m * out.width_m * std::clamp(1.0 - deadrise / no_impact_rad, 0.0, 1.0);
  return out;
}

// Of all stations m J J^T, and m J D^T, of which `passing` is the skew part: J is how a motion moves the bottom along
// its normal there, D how that changes from station to station. Neither normal nor D has a part along z.
struct PlaningBottom::StationSums {
  void add(const glm::dvec3& r, const glm::dvec3& n, double mass, bool passes = false) {
    const glm::dvec3 t = glm::cross(r, n);
    const std::array<double, 5> j{n.x, n.y, t.x, t.y, t.z};
    for (std::size_t a = 0; a < 5; ++a) {
      const double part = mass * j[a];
      for (std::size_t b = a; b < 5; ++b) own[a][b] += part * j[b];
      if (passes) along[a][0] -= part * n.y, along[a][1] += part * n.x;
    }
  }
  void give(Matrix6& whole) const {
    for (std::size_t a = 0; a < 5; ++a)
      for (std::size_t b = a; b < 5; ++b) whole.rows[at[a]][at[b]] = whole.rows[at[b]][at[a]] = own[a][b];
  }
  void give_passing(Matrix6& skew, double share) const {
    for (std::size_t a = 0; a < 5; ++a)
      for (std::size_t b = 0; b < 2; ++b) {
        skew.rows[at[a]][3 + b] += share * along[a][b];
        skew.rows[3 + b][at[a]] -= share * along[a][b];
      }
  }
  static constexpr std::array<std::size_t, 5> at{0, 1, 3, 4, 5};
  std::array<std::array<double, 5>, 5> own{};
  std::array<std::array<double, 2>, 5> along{};
};

PlaningBottom::Lift PlaningBottom::lift(const BodyPose& pose, const Vector6& velocity, const WaterPatch& water,
                                        const HullMedia& media, double dt, Before& before) const {
  Lift out;
  if (stations_.empty()) return out;
  const glm::dvec3 &across = pose.to_world[0], &up = pose.to_world[1], &aft = pose.to_world[2];
  const glm::dvec3 normal = water.plane_normal(), current = water.velocity({pose.centre_m.x, pose.centre_m.z});
  const double ahead = -glm::dot(aft, velocity.linear - current), upright = std::max(glm::dot(up, normal), 0.0);
  const double sine = glm::dot(across, normal), heel = std::atan2(sine, upright);
  std::array<std::array<Half, 2>, stations> halves{};
  std::array<double, 2> most{};
  std::array<double, stations> depths{};
  for (std::size_t i = 0; i < stations && upright > 0.0; ++i) {
    const Station& station = stations_[i];
    const glm::dvec3 keel = pose.centre_m + pose.to_world * station.keel_m;
    const double depth = depths[i] = water.dry({keel.x, keel.z}) ? -1.0 : water.height({keel.x, keel.z}) - keel.y;
    if (!(depth > 0.0)) continue;
    for (std::size_t s = 0; s < 2; ++s) {
      Half& half = halves[i][s] = half_of(station.sides[s], s == 0 ? -1.0 : 1.0, depth, heel, upright, sine);
      half.mass_kg_m *= media.density_kg_m3 * upright;
      most[s] = std::max(most[s], half.mass_kg_m);
    }
  }
  const std::size_t first = ahead >= 0.0 ? 0 : stations - 1, last = stations - 1 - first;
  if (most[0] + most[1] > 0.0)
    out.sheds = (halves[last][0].mass_kg_m + halves[last][1].mass_kg_m) / (most[0] + most[1]);
  const double rate = 0.5 * out.sheds * std::abs(ahead);
  StationSums sums, grew;
  for (std::size_t s = 0; s < 2; ++s) {
    const double to_side = s == 0 ? -1.0 : 1.0;
    // A side's force is normal to its bottom.
    const auto normal_of = [&](const Half& half) {
      return glm::dvec3(-to_side * half.slope, 1.0, 0.0) / std::sqrt(1.0 + half.slope * half.slope);
    };
    const auto place = [&](std::size_t i, double part) {
      const double x = part * halves[i][s].width_m;
      return glm::dvec3(to_side * x, stations_[i].keel_m.y + halves[i][s].slope * x, stations_[i].keel_m.z);
    };
    const auto press = [&](const glm::dvec3& own, const glm::dvec3& own_normal, double mass_per_s, double grown) {
      const glm::dvec3 r = pose.to_world * own, at = pose.centre_m + r, carrier = water.velocity({at.x, at.z});
      const glm::dvec3 n = pose.to_world * own_normal;
      // It has no force where it rises, and leaves the water with what it gave it.
      if (glm::dot(n, velocity.linear + glm::cross(velocity.angular, r) - carrier) >= 0.0) return;
      if (grown > 0.0) grew.add(own, own_normal, grown);
      if (!(mass_per_s > 0.0)) return;
      out.resists.add_along(r, n, mass_per_s);
      const glm::dvec3 force = mass_per_s * glm::dot(n, carrier) * n;
      out.carried.linear += force, out.carried.angular += glm::cross(r, force);
    };
    double had = 0.0;
    std::size_t widest = last;
    for (std::size_t n = 0; n < stations; ++n) {
      const std::size_t i = ahead >= 0.0 ? n : stations - 1 - n;
      const Half& half = halves[i][s];
      double& was = before.mass_kg_m[i][s];
      const double grown = before.known ? (half.mass_kg_m - was) * spacing_m_ : 0.0,
                   passes = std::max(half.mass_kg_m - had, 0.0);
      was = half.mass_kg_m;
      if (half.mass_kg_m > had) had = half.mass_kg_m, widest = i;
      if (!(half.mass_kg_m > 0.0)) continue;
      const glm::dvec3 middle = place(i, centroid), own_normal = normal_of(half);
      const double mass = half.mass_kg_m * spacing_m_;
      sums.add(middle, own_normal, mass, true);
      // What a rising hull's stations lose they do not take: d/dt and U d/ds are one rate.
      const double takes = std::max(rate * passes + std::min(grown, 0.0) / dt, 0.0);
      if (!(takes > 0.0 || grown > 0.0)) continue;
      glm::dvec3 own = place(i, impact_centroid);
      if (n > 0) {
        // Halfway from the last station; behind one that is dry the mass grows as the square of the depth.
        const double last_m = depths[ahead >= 0.0 ? i - 1 : i + 1];
        const double part = last_m > 0.0 ? 0.5 : depths[i] / (3.0 * (depths[i] - last_m));
        own.z -= std::copysign(part * spacing_m_, ahead);
      }
      press(own, own_normal, takes, std::max(grown, 0.0));
    }
    if (had > 0.0) {
      glm::dvec3 own = place(widest, impact_centroid);
      own.z = stations_[last].keel_m.z + std::copysign(0.5 * spacing_m_, ahead);
      const glm::dvec3 own_normal = normal_of(halves[widest][s]);
      press(own, own_normal, rate * had, 0.0);
      out.sideways_kg_m += out.sheds * had * own_normal.x * own_normal.x;
    }
  }
  before.known = true;
  sums.give(out.added), grew.give(out.grown);
  sums.give_passing(out.passing, 0.5 * out.sheds);
  return out;
}

Matrix6 PlaningBottom::sideways(double waterline, double density) const {
  Matrix6 out;
  for (const Station& station : stations_) {
    const double draught = std::max(waterline - station.keel_m.y, 0.0);
    const glm::dvec3 middle(0.0, waterline - centroid * draught, station.keel_m.z);
    out.add_along(middle, {1.0, 0.0, 0.0}, 0.5 * pi * density * draught * draught * spacing_m_);
  }
  return out;
}

Matrix6 PlaningBottom::radiates(double waterline, double stiffness, double mass, const HullMedia& media) const {
  Matrix6 out;
  const auto half_at = [&](const Station& station, std::size_t s, double depth) {
    return half_of(station.sides[s], s == 0 ? -1.0 : 1.0, depth, 0.0, 1.0, 0.0);
  };
  double added = 0.0;
  for (const Station& station : stations_)
    if (const double draught = waterline - station.keel_m.y; draught > 0.0)
      for (const std::size_t s : {0u, 1u})
        added += media.density_kg_m3 * half_at(station, s, draught).mass_kg_m * spacing_m_;
  if (!(added > 0.0 && stiffness > 0.0)) return out;
  const double w = std::sqrt(stiffness / (mass + added)), k = w * w / media.gravity_mps2;
  for (const Station& station : stations_) {
    const double draught = waterline - station.keel_m.y;
    if (!(draught > 0.0)) continue;
    double breadth = 0.0;
    for (const std::size_t s : {0u, 1u}) breadth += half_at(station, s, draught / pile_up).width_m;  // as it lies there
    // Not beyond the first of its maxima, where broad stations would make no waves at all.
    const double high = 2.0 * std::sin(std::min(0.5 * k * breadth, 0.5 * pi)) * std::exp(-k * draught);
    const double damps = media.density_kg_m3 * media.gravity_mps2 * media.gravity_mps2 * high * high / (w * w * w);
    out.add_along({0.0, 0.0, station.keel_m.z}, {0.0, 1.0, 0.0}, damps * spacing_m_);
  }
  return out;
}

}  // namespace seascape
