#include "ocean/bodies/moorings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ocean/sea/state_hash.h"

namespace seascape {

namespace {

constexpr double deepest_m = 40.0;   // of where a scene's line is made fast, below the still sea
constexpr double over_land_m = 0.3;  // of a bollard's or a ring's height
// Of a scene's line and of one made by hand: a little more than the way there.
constexpr double slack = 1.1, slack_m = 0.3, hand_slack = 1.05, hand_slack_m = 0.15;
constexpr double rope_damping = 0.2;      // of critical
constexpr double still_again_s = 5.0;     // without dragging, before an anchor that drags is told of again
constexpr double most_dragged_mps = 5.0;  // along the ground
constexpr double dry_m = 0.05;            // over the still water, of a stone or an edge that a line is made fast to

glm::dvec3 in_world(const Bodies& bodies, std::size_t body, const glm::dvec3& hull_m) {
  const BodyState& state = bodies.result()[body];
  return state.at_m + state.motion.orientation * hull_m;
}

// Closest point of a triangle by its Voronoi regions (Ericson 2005, "Real-Time Collision Detection", section 5.1.5).
glm::dvec3 nearest_of_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
               d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  if (d3 >= 0.0 && d4 <= d3) return b;
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return sum > 0.0 ? a + ab * (vb / sum) + ac * (vc / sum) : a;
}

// Corners of the part of a triangle that stands out of the still water (Sutherland and Hodgman 1974); fewer than three:
// none does.
std::size_t over_water(const std::array<glm::dvec3, 3>& corners, std::array<glm::dvec3, 4>& dry) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
    const double over_a = a.y - dry_m, over_b = b.y - dry_m;
    if (over_a >= 0.0) dry[count++] = a;
    if ((over_a >= 0.0) != (over_b >= 0.0)) dry[count++] = a + (b - a) * (over_a / (over_a - over_b));
  }
  return count;
}

}  // namespace

MooringRope rope_of(double boat_kg) {
  const double mm = std::max(7.3 * std::cbrt(boat_kg / 1000.0), 10.0);
  return {1e-3 * mm, 210.0 * mm * mm};
}

GroundTackle tackle_of(double boat_kg, double gravity) {
  const double length = std::cbrt(boat_kg / 1000.0), mm = std::max(4.85 * length, 4.0);
  GroundTackle tackle;
  tackle.anchor_kg = 5.0 * length * length;
  tackle.holds_n = 560e3 * std::pow(tackle.anchor_kg / 4536.0, 0.8);
  tackle.chain_diameter_m = 1e-3 * mm;
  tackle.chain_m = 30.0 * length;
  tackle.weight_n_m = 0.87 * 0.0219 * mm * mm * gravity;
  tackle.stiff_n = 0.854e11 * tackle.chain_diameter_m * tackle.chain_diameter_m;
  tackle.breaking_n = 300.0 * 2.0 * 0.25 * std::numbers::pi * mm * mm;
  return tackle;
}

Moorings::Moorings(std::vector<BodyMooring> of_scene, std::vector<BodyFittings> fittings,
                   std::vector<MooringPoint> points, std::vector<StillCollider> still)
    : of_scene_(std::move(of_scene)),
      pending_(of_scene_),
      fittings_(std::move(fittings)),
      points_(std::move(points)),
      still_(std::move(still)) {}

const BodyFittings& Moorings::fittings(std::size_t body) const {
  static const BodyFittings none;
  return body < fittings_.size() ? fittings_[body] : none;
}

void Moorings::hand_over(Bodies& bodies) {
  std::vector<MooringLine> list;
  for (const Line& line : lines_) list.push_back(line.is);
  bodies.moor(std::move(list));
}

// A line's stiffness stretches it by a tenth under half of the body's weight, and its damping is critical.
void Moorings::make_scene_lines(Bodies& bodies, const SeaWater& water, const HullMedia& media) {
  if (pending_.empty()) return;
  for (const BodyMooring& mooring : pending_) {
    double ground_m = 0.0;
    water.ground({&mooring.to_m, 1}, {&ground_m, 1});
    const double mass = bodies.spec(mooring.body).mass.mass_kg;
    Line line;
    line.kind = Kind::scene;
    line.diameter_m = rope_of(mass).diameter_m;
    MooringLine& is = line.is;
    is.body = mooring.body;
    is.from_m = mooring.from_m;
    is.to_m = {mooring.to_m.x, std::max(ground_m, -deepest_m) + (ground_m > -over_land_m ? over_land_m : 0.0),
               mooring.to_m.y};
    is.length_m = slack * glm::length(is.to_m - in_world(bodies, is.body, is.from_m)) + slack_m;
    is.stiffness_n_m = 0.5 * mass * media.gravity_mps2 / (0.1 * is.length_m);
    is.damping_ns_m = 2.0 * std::sqrt(is.stiffness_n_m * mass);
    lines_.push_back(line);
  }
  pending_.clear();
  hand_over(bodies);
}

void Moorings::follow(double end_s, double dt_s, Bodies& bodies, const SeaWater& water,
                      std::vector<BodyEvent>& events) {
  const std::span<const double> tensions = bodies.line_tensions_n();
  bool parted = false;
  for (std::size_t n = 0; n < lines_.size(); ++n) {
    Line& line = lines_[n];
    if (line.breaking_n > 0.0 && tensions[n] > line.breaking_n) {
      events.push_back({end_s, line.is.body, BodyEventKind::parted, 0.0});
      line.is.length_m = -1.0;
      parted = true;
    }
    if (line.kind != Kind::anchor || line.is.length_m < 0.0 || bodies.result()[line.is.body].asleep) continue;
    const glm::dvec3 bow = in_world(bodies, line.is.body, line.is.from_m), way = bow - line.is.to_m;
    const double across = std::hypot(way.x, way.z);
    const Chain chain{line.is.weight_n_m, line.is.length_m, line.is.stiffness_n_m * line.is.length_m};
    const ChainPull pull = chain_pull(chain, across, way.y);
    const double holds = anchor_hold(line.is.holds_n, pull.across_n, pull.lifts_n);
    if (!(pull.across_n > holds && across > 0.0)) continue;
    const double by = std::min(across - std::max(chain_reach(chain, holds, way.y), 0.0), most_dragged_mps * dt_s);
    if (!(by > 0.0)) continue;
    line.is.to_m += glm::dvec3(way.x, 0.0, way.z) * (by / across);
    const glm::dvec2 place(line.is.to_m.x, line.is.to_m.z);
    water.ground({&place, 1}, {&line.is.to_m.y, 1});
    bodies.move_line_end(n, line.is.to_m);
    if (end_s - line.dragged_s > still_again_s)
      events.push_back({end_s, line.is.body, BodyEventKind::drags, by / dt_s});
    line.dragged_s = end_s;
  }
  if (!parted) return;
  std::erase_if(lines_, [](const Line& line) { return line.is.length_m < 0.0; });
  hand_over(bodies);
}

Moorings::Target Moorings::nearest(std::size_t body, const glm::dvec3& from, const Bodies& bodies) const {
  Target found;
  for (const MooringPoint& point : points_)
    if (const double away = glm::length(point.at_m - from); away < found.away_m)
      found = {point.name, point.at_m, {}, {}, away};
  for (std::size_t other = 0; other < fittings_.size(); ++other) {
    if (other == body || bodies.result()[other].lost) continue;
    for (const glm::dvec3& fitting : fittings_[other]) {
      const glm::dvec3 at = in_world(bodies, other, fitting);
      if (const double away = glm::length(at - from); away < found.away_m)
        found = {bodies.spec(other).name, at, other, fitting, away};
    }
  }
  return found;
}

// Out of the water: a stone, a pile or the edge of a deck.
Moorings::Target Moorings::nearest_still(const glm::dvec3& from) const {
  Target found;
  for (const StillCollider& collider : still_) {
    for (const auto& t : collider.mesh.triangles) {
      std::array<glm::dvec3, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = collider.at_m + collider.orientation * collider.mesh.vertices[t[i]];
      std::array<glm::dvec3, 4> dry;
      const std::size_t count = over_water(corners, dry);
      for (std::size_t i = 2; i < count; ++i) {
        const glm::dvec3 at = nearest_of_triangle(from, dry[0], dry[i - 1], dry[i]);
        if (const double away = glm::length(at - from); away < found.away_m) found = {collider.name, at, {}, {}, away};
      }
    }
  }
  return found;
}

std::vector<std::string> Moorings::make_fast(std::size_t body, double reach_m, Bodies& bodies) {
  struct End {
    glm::dvec3 from_m, on_hull_m;
    Target to;
  };
  std::vector<End> ends;
  for (const bool fitted : {true, false}) {
    for (const glm::dvec3& fitting : fittings(body)) {
      const glm::dvec3 from = in_world(bodies, body, fitting);
      const Target to = fitted ? nearest(body, from, bodies) : nearest_still(from);
      if (to.away_m <= reach_m) ends.push_back({from, fitting, to});
    }
    if (!ends.empty()) break;
  }
  std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.to.away_m < b.to.away_m; });
  std::vector<std::string> names;
  std::vector<glm::dvec3> taken;
  const double mass = bodies.spec(body).mass.mass_kg;
  const MooringRope rope = rope_of(mass);
  for (const End& end : ends) {
    if (std::any_of(taken.begin(), taken.end(), [&](const glm::dvec3& at) { return at == end.to.at_m; })) continue;
    taken.push_back(end.to.at_m);
    Line line;
    line.breaking_n = rope.breaking_n;
    line.diameter_m = rope.diameter_m;
    MooringLine& is = line.is;
    is.body = body;
    is.from_m = end.on_hull_m;
    is.other = end.to.body;
    is.to_m = end.to.body ? end.to.on_body_m : end.to.at_m;
    is.length_m = hand_slack * end.to.away_m + hand_slack_m;
    is.stiffness_n_m = rope.breaking_n / (MooringRope::most_stretch * is.length_m);
    const double lighter = is.other ? std::min(mass, bodies.spec(*is.other).mass.mass_kg) : mass;
    is.damping_ns_m = rope_damping * 2.0 * std::sqrt(is.stiffness_n_m * lighter);
    lines_.push_back(line);
    if (std::find(names.begin(), names.end(), end.to.name) == names.end()) names.push_back(end.to.name);
  }
  if (!names.empty()) hand_over(bodies);
  return names;
}

bool Moorings::made_fast(std::size_t body) const {
  return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
    return line.kind != Kind::anchor && (line.is.body == body || line.is.other == body);
  });
}

void Moorings::cast_off(std::size_t body, Bodies& bodies) {
  std::erase_if(lines_, [&](const Line& line) {
    const bool holds = line.kind != Kind::anchor && (line.is.body == body || line.is.other == body);
    if (holds && line.is.other) bodies.wake(line.is.body), bodies.wake(*line.is.other);
    return holds;
  });
  bodies.wake(body);
  hand_over(bodies);
}

bool Moorings::anchored(std::size_t body) const {
  return std::any_of(lines_.begin(), lines_.end(),
                     [&](const Line& line) { return line.kind == Kind::anchor && line.is.body == body; });
}

AnchorDrop Moorings::drop_anchor(std::size_t body, Bodies& bodies, const SeaWater& water, const HullMedia& media) {
  AnchorDrop drop;
  if (fittings(body).empty()) return drop;
  const double mass = bodies.spec(body).mass.mass_kg;
  const GroundTackle tackle = tackle_of(mass, media.gravity_mps2);
  const glm::dvec3 hawse = fittings(body).front(), bow = in_world(bodies, body, hawse);
  const glm::dvec2 place(bow.x, bow.z);
  drop.depth_m = water.depth_m(place);
  double ground_m = 0.0;
  water.ground({&place, 1}, {&ground_m, 1});
  const double up = bow.y - ground_m;
  drop.dry = !(drop.depth_m > 0.0);
  drop.most_depth_m = std::max(tackle.chain_m / least_scope - (up - drop.depth_m), 0.0);
  drop.chain_m = std::min(most_scope * up, tackle.chain_m);
  if (drop.dry || !(drop.chain_m >= least_scope * up)) return drop;
  drop.let_go = true;
  Line line;
  line.kind = Kind::anchor;
  line.breaking_n = tackle.breaking_n;
  line.diameter_m = tackle.chain_diameter_m;
  MooringLine& is = line.is;
  is.body = body;
  is.from_m = hawse;
  is.to_m = {bow.x, ground_m, bow.z};
  is.length_m = drop.chain_m;
  is.stiffness_n_m = tackle.stiff_n / is.length_m;
  is.damping_ns_m = rope_damping * 2.0 * std::sqrt(tackle.weight_n_m * mass);
  is.weight_n_m = tackle.weight_n_m;
  is.holds_n = tackle.holds_n;
  lines_.push_back(line);
  hand_over(bodies);
  return drop;
}

void Moorings::weigh(std::size_t body, Bodies& bodies) {
  std::erase_if(lines_, [&](const Line& line) { return line.kind == Kind::anchor && line.is.body == body; });
  bodies.wake(body);
  hand_over(bodies);
}

void Moorings::begin_anew(std::size_t body, Bodies& bodies) {
  cast_off(body, bodies);
  weigh(body, bodies);
  std::erase_if(pending_, [&](const BodyMooring& one) { return one.body == body; });
  for (const BodyMooring& one : of_scene_)
    if (one.body == body) pending_.push_back(one);
}

std::uint64_t Moorings::mixed_into(std::uint64_t hash) const {
  for (const Line& line : lines_) {
    if (line.kind == Kind::scene) continue;
    hash = mixed(mixed(hash, std::uint64_t(line.is.body)), std::uint64_t(line.is.other.value_or(~std::size_t(0))));
    hash = mixed(mixed(mixed(hash, line.is.from_m), line.is.to_m), line.is.length_m);
  }
  return hash;
}

}  // namespace seascape
