#include "ocean/bodies/contacts.h"

#define BT_USE_DOUBLE_PRECISION  // as Debian's libraries with -float64 are built
#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/error.h"
#include "ocean/bodies/chain.h"

namespace seascape {
namespace {

constexpr double near_m = 0.02;        // of the land: touches from this distance on are known of
constexpr int most_moments = 16;       // that a quick body is looked for in
constexpr std::size_t most_rows = 12;  // places of a hull on land

btVector3 to_bullet(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  void add(const glm::dvec3& v) { low = glm::min(low, v), high = glm::max(high, v); }
};

// A convex shape of Bullet with its faces, so that a touch has all its corners at once and needs no memory of the last
// step.
struct Shape {
  explicit Shape(const HullMesh& mesh) : corners(outermost(mesh)) {
    hull = std::make_unique<btConvexHullShape>();
    Box box;
    for (const glm::dvec3& v : corners) {
      hull->addPoint(to_bullet(v), false);
      radius_m = std::max(radius_m, glm::length(v));
      box.add(v);
    }
    hull->recalcLocalAabb();
    const glm::dvec3 size = box.high - box.low;
    thin_m = std::min({size.x, size.y, size.z});
    // Bullet finds the direction of a touch for shapes this much larger, and then the touch's places by their faces:
    // with no margin its directions are wrong where shapes overlap little.
    hull->setMargin(std::min(0.02, 0.05 * thin_m));
    hull->initializePolyhedralFeatures();
    object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(hull.get());
  }
  void place(const glm::dvec3& at, const glm::dquat& q) {
    object->setWorldTransform(btTransform(btQuaternion(q.x, q.y, q.z, q.w), to_bullet(at)));
  }
  std::vector<glm::dvec3> corners;
  std::unique_ptr<btConvexHullShape> hull;
  std::unique_ptr<btCollisionObject> object;
  double radius_m = 0.0, thin_m = 0.0;
};

void check(const std::vector<MooringLine>& lines, std::size_t bodies) {
  for (const MooringLine& line : lines) {
    const char* where = "mooring line";
    if (line.body >= bodies || line.other.value_or(0) >= bodies || line.other == line.body)
      throw Error(where, "it holds a body that is not there, or one to itself", "name one or two of the scene's");
    const glm::dvec3 sum = line.from_m + line.to_m;
    if (!std::isfinite(sum.x + sum.y + sum.z)) throw Error(where, "an end is no number", "give ends in metres");
    if (!(line.length_m >= 0.0 && std::isfinite(line.length_m) && line.stiffness_n_m > 0.0 &&
          line.stiffness_n_m < 1e15 && line.damping_ns_m >= 0.0 && line.damping_ns_m < 1e15 && line.weight_n_m >= 0.0 &&
          line.weight_n_m < 1e6 && line.holds_n >= 0.0))
      throw Error(where, "its length, stiffness, damping, weight or hold is out of range",
                  "give a length of 0 or more and a stiffness above 0");
  }
}

// A chain's pull as a spring that is as stiff as the catenary is here, taken at the step's end like any line's. Its
// anchor gives way at its hold.
bool hang(const MooringLine& line, const glm::dvec3& way, Pull& pull) {
  const double across = std::hypot(way.x, way.z);
  const ChainPull force =
      chain_pull({line.weight_n_m, line.length_m, line.stiffness_n_m * line.length_m}, across, -way.y);
  const double tension = std::hypot(force.across_n, force.down_n);
  if (!(tension > 0.0)) return false;
  const double flat = force.across_n / tension;
  const glm::dvec2 ahead = across > 1e-9 ? glm::dvec2(way.x, way.z) / across : glm::dvec2(0.0);
  pull.towards = {ahead.x * flat, -force.down_n / tension, ahead.y * flat};
  pull.towards = glm::normalize(pull.towards);
  pull.stiffness_n_m = std::max(force.stiffness_n_m / std::max(flat * flat, 0.01), line.weight_n_m);
  pull.stretch_m = tension / pull.stiffness_n_m;
  pull.most_n = std::max(anchor_hold(line.holds_n, force.across_n, force.lifts_n) / std::max(flat, 1e-6), force.down_n);
  return true;
}

}  // namespace

std::vector<glm::dvec3> outermost(const HullMesh& mesh) {
  constexpr int directions = 128;
  std::vector<bool> taken(mesh.vertices.size());
  for (int n = 0; n < directions + 26; ++n) {
    glm::dvec3 d;
    if (n < directions) {  // evenly over the sphere, by the golden angle (Vogel 1979)
      const double y = 1.0 - 2.0 * (n + 0.5) / directions, r = std::sqrt(1.0 - y * y),
                   turn = n * std::numbers::pi * (3.0 - std::sqrt(5.0));
      d = {r * std::cos(turn), y, r * std::sin(turn)};
    } else {  // along the axes and between them, for boxes
      const int m = n - directions + (n - directions >= 13 ? 1 : 0);
      d = {m % 3 - 1, m / 3 % 3 - 1, m / 9 - 1};
    }
    std::size_t best = 0;
    for (std::size_t v = 1; v < mesh.vertices.size(); ++v)
      if (glm::dot(mesh.vertices[v], d) > glm::dot(mesh.vertices[best], d)) best = v;
    taken[best] = true;
  }
  std::vector<glm::dvec3> out;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (taken[v]) out.push_back(mesh.vertices[v]);
  return out;
}

struct Contacts::World {
  World(const ContactSettings& with, std::span<const HullMesh> hulls, std::span<const glm::dvec3> centres)
      : settings(with), mass_centres(centres.begin(), centres.end()), dispatcher(&configuration) {
    for (const HullMesh& hull : hulls) shapes.emplace_back(hull);
    for (const StillCollider& collider : settings.still) {
      validate(collider.mesh, collider.name.c_str());
      const glm::dvec3& at = collider.at_m;
      const glm::dquat& q = collider.orientation;
      if (!(std::isfinite(at.x + at.y + at.z) && std::abs(glm::length(q) - 1.0) < 1e-3))
        throw Error(collider.name, "its pose is no number", "give a place in metres and a rotation of length 1");
      still.emplace_back(collider.mesh);
      still.back().place(at, glm::normalize(q));
      Box& box = still_boxes.emplace_back();
      for (const glm::dvec3& v : still.back().corners) box.add(at + glm::normalize(q) * v);
    }
    check(settings.lines, shapes.size());
  }

  void find_pairs(std::span<const Collider> bodies, double dt);
  void touch_pair(std::size_t a, std::optional<std::size_t> b, std::size_t pier, std::span<Collider> bodies, double dt);
  bool narrow(Shape& a, Shape& b, std::size_t body, std::optional<std::size_t> other);
  void touch_land(std::size_t a, const ContactBody& body);
  void pull_lines(std::span<Collider> bodies);
  glm::dvec3 on_body(std::span<const Collider> bodies, std::size_t body, const glm::dvec3& hull_m) const {
    const BodyMotion& m = *bodies[body].body.motion;
    return m.centre_m + m.orientation * (hull_m - mass_centres[body]);
  }

  ContactSettings settings;
  std::vector<glm::dvec3> mass_centres;
  std::vector<Shape> shapes, still;  // of bodies; of what stands still
  std::vector<Box> still_boxes;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  ContactSolver solver;
  std::vector<Touch> touches;
  std::vector<Pull> pulls;
  std::vector<double> tensions_n;  // of the lines
  std::size_t first_of_land = 0;
  std::vector<Box> boxes;
  std::vector<std::size_t> by_x;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<glm::dvec2> places;
  std::vector<double> heights;
  std::vector<ContactBody> moving;
};

// Pairs of bodies whose boxes meet, in the order of their numbers: a sweep along x.
void Contacts::World::find_pairs(std::span<const Collider> bodies, double dt) {
  boxes.resize(bodies.size()), by_x.resize(bodies.size());
  pairs.clear();
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const BodyMotion& m = *bodies[n].body.motion;
    const double reach = shapes[n].radius_m + near_m;
    boxes[n] = {m.centre_m - reach, m.centre_m + reach};
    const glm::dvec3 before = m.centre_m - m.velocity.linear * dt;
    boxes[n].low = glm::min(boxes[n].low, before - reach), boxes[n].high = glm::max(boxes[n].high, before + reach);
    by_x[n] = n;
  }
  if (!settings.between_bodies) return;
  std::sort(by_x.begin(), by_x.end(), [&](std::size_t a, std::size_t b) {
    return boxes[a].low.x != boxes[b].low.x ? boxes[a].low.x < boxes[b].low.x : a < b;
  });
  for (std::size_t i = 0; i < by_x.size(); ++i)
    for (std::size_t j = i + 1; j < by_x.size() && boxes[by_x[j]].low.x <= boxes[by_x[i]].high.x; ++j) {
      const auto [a, b] = std::minmax(by_x[i], by_x[j]);
      if (bodies[a].asleep && bodies[b].asleep) continue;
      const bool apart = boxes[a].high.z < boxes[b].low.z || boxes[b].high.z < boxes[a].low.z ||
                         boxes[a].high.y < boxes[b].low.y || boxes[b].high.y < boxes[a].low.y;
      if (!apart) pairs.emplace_back(a, b);
    }
  std::sort(pairs.begin(), pairs.end());
}

// Bullet's answer for two shapes where they are.
bool Contacts::World::narrow(Shape& a, Shape& b, std::size_t body, std::optional<std::size_t> other) {
  btCollisionObjectWrapper first(nullptr, a.hull.get(), a.object.get(), a.object->getWorldTransform(), -1, 0),
      second(nullptr, b.hull.get(), b.object.get(), b.object->getWorldTransform(), -1, 1);
  btPersistentManifold* manifold = dispatcher.getNewManifold(a.object.get(), b.object.get());
  btCollisionAlgorithm* algorithm = dispatcher.findAlgorithm(&first, &second, manifold, BT_CONTACT_POINT_ALGORITHMS);
  const std::size_t had = touches.size();
  if (algorithm != nullptr) {
    btManifoldResult result(&first, &second);
    result.setPersistentManifold(manifold);
    btDispatcherInfo info;
    algorithm->processCollision(&first, &second, info, &result);
    const bool swapped = manifold->getBody0() != a.object.get();
    for (int n = 0; n < manifold->getNumContacts(); ++n) {
      const btManifoldPoint& p = manifold->getContactPoint(n);
      const glm::dvec3 normal = from_bullet(p.m_normalWorldOnB) * (swapped ? -1.0 : 1.0);
      const double gap = p.getDistance();
      if (!(std::isfinite(gap) && gap <= 0.0 && std::abs(glm::length(normal) - 1.0) < 1e-3)) continue;
      const glm::dvec3 middle = 0.5 * (from_bullet(p.getPositionWorldOnA()) + from_bullet(p.getPositionWorldOnB()));
      touches.push_back({body, other, middle, glm::normalize(normal), gap, settings.restitution, settings.friction});
    }
    algorithm->~btCollisionAlgorithm();
    dispatcher.freeCollisionAlgorithm(algorithm);
  }
  dispatcher.releaseManifold(manifold);
  return touches.size() > had;
}

// Two shapes that came past half of the thinner one in this step are looked for on their way, and stay where they
// touched first.
void Contacts::World::touch_pair(std::size_t a, std::optional<std::size_t> b, std::size_t pier,
                                 std::span<Collider> bodies, double dt) {
  BodyMotion& first = *bodies[a].body.motion;
  BodyMotion* second = b ? bodies[*b].body.motion : nullptr;
  Shape& shape = b ? shapes[*b] : still[pier];
  const glm::dvec3 way = (first.velocity.linear - (second ? second->velocity.linear : glm::dvec3(0.0))) * dt;
  const double part = 0.5 * std::min(shapes[a].thin_m, shape.thin_m);
  const int moments = int(std::clamp(std::ceil(glm::length(way) / std::max(part, 1e-3)), 1.0, double(most_moments)));
  for (int n = moments - 1; n >= 0; --n) {
    const double back = dt * n / moments;
    const glm::dvec3 at = first.centre_m - back * first.velocity.linear;
    shapes[a].place(at, first.orientation);
    const glm::dvec3 other = second ? second->centre_m - back * second->velocity.linear : glm::dvec3(0.0);
    if (second) shape.place(other, second->orientation);
    if (!narrow(shapes[a], shape, a, b)) continue;
    first.centre_m = at;
    if (second) second->centre_m = other;
    return;
  }
}

// The ground at a hull's corners, as steep as it is there.
void Contacts::World::touch_land(std::size_t a, const ContactBody& body) {
  const BodyMotion& m = *body.motion;
  const Shape& shape = shapes[a];
  const double reach = shape.radius_m;
  const glm::dvec2 centre(m.centre_m.x, m.centre_m.z);
  const auto ask = [&] {
    heights.assign(places.size(), -1e300);
    settings.land(places, heights);
    for (double& h : heights)
      if (!std::isfinite(h)) h = -1e300;
  };
  places.assign({centre, centre + glm::dvec2(reach, 0.0), centre - glm::dvec2(reach, 0.0),
                 centre + glm::dvec2(0.0, reach), centre - glm::dvec2(0.0, reach)});
  ask();
  // Between these the ground is no higher than by its slope of 45 degrees.
  if (*std::max_element(heights.begin(), heights.end()) + 2.0 * reach < m.centre_m.y) return;
  places.clear();
  constexpr double apart = 0.1;
  const glm::dmat3 to_world = glm::mat3_cast(m.orientation);
  for (const glm::dvec3& corner : shape.corners) {
    const glm::dvec3 at = m.centre_m + to_world * corner;
    const glm::dvec2 place(at.x, at.z);
    for (const glm::dvec2 by : {glm::dvec2(0.0), glm::dvec2(apart, 0.0), glm::dvec2(0.0, apart)})
      places.push_back(place + by);
  }
  ask();
  std::vector<Touch> here;
  for (std::size_t n = 0; n < shape.corners.size(); ++n) {
    const glm::dvec3 at = m.centre_m + to_world * shape.corners[n];
    const double ground = heights[3 * n];
    glm::dvec2 slope(heights[3 * n + 1] - ground, heights[3 * n + 2] - ground);
    slope = glm::clamp(slope / apart, glm::dvec2(-20.0), glm::dvec2(20.0));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
    const double gap = (at.y - ground) * normal.y;
    if (!(gap < near_m)) continue;
    here.push_back({a, {}, at, normal, gap, 0.0, settings.ground_friction});
  }
  // The deepest ones, and of alike the first.
  std::stable_sort(here.begin(), here.end(), [](const Touch& x, const Touch& y) { return x.gap_m < y.gap_m; });
  if (here.size() > most_rows) here.resize(most_rows);
  touches.insert(touches.end(), here.begin(), here.end());
}

void Contacts::World::pull_lines(std::span<Collider> bodies) {
  pulls.clear();
  for (std::size_t n = 0; n < settings.lines.size(); ++n) {
    const MooringLine& line = settings.lines[n];
    if (bodies[line.body].asleep && (!line.other || bodies[*line.other].asleep)) continue;
    const glm::dvec3 at = on_body(bodies, line.body, line.from_m);
    const glm::dvec3 to = line.other ? on_body(bodies, *line.other, line.to_m) : line.to_m;
    const glm::dvec3 way = to - at;
    Pull pull{line.body, at, {}, 0.0, line.stiffness_n_m, line.damping_ns_m, line.other, to};
    pull.line = n;
    if (line.weight_n_m > 0.0) {
      if (!hang(line, way, pull)) continue;
    } else {
      const double distance = glm::length(way);
      pull.stretch_m = distance - line.length_m;
      if (!(pull.stretch_m > 0.0 && distance > 1e-9)) continue;
      pull.towards = way / distance;
    }
    pulls.push_back(pull);
  }
}

Contacts::Contacts(const ContactSettings& settings, std::span<const HullMesh> hulls,
                   std::span<const glm::dvec3> mass_centres)
    : world_(std::make_unique<World>(settings, hulls, mass_centres)) {}
Contacts::~Contacts() = default;
Contacts::Contacts(Contacts&&) noexcept = default;
Contacts& Contacts::operator=(Contacts&&) noexcept = default;

const std::vector<MooringLine>& Contacts::lines() const { return world_->settings.lines; }
void Contacts::set_lines(std::vector<MooringLine> lines) {
  check(lines, world_->shapes.size());
  world_->settings.lines = std::move(lines);
  world_->tensions_n.assign(world_->settings.lines.size(), 0.0);
}
std::span<const double> Contacts::tensions_n() const { return world_->tensions_n; }
void Contacts::move_end(std::size_t line, const glm::dvec3& to_m) { world_->settings.lines[line].to_m = to_m; }

void Contacts::step(double dt, std::span<Collider> bodies, std::span<ContactImpulses> impulses) {
  World& w = *world_;
  w.touches.clear();
  w.find_pairs(bodies, dt);
  for (const auto& [a, b] : w.pairs) w.touch_pair(a, b, 0, bodies, dt);
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    if (bodies[a].asleep) continue;
    for (std::size_t n = 0; n < w.still.size(); ++n) {
      const Box &box = w.still_boxes[n], &own = w.boxes[a];
      if (glm::all(glm::lessThanEqual(own.low, box.high)) && glm::all(glm::lessThanEqual(box.low, own.high)))
        w.touch_pair(a, {}, n, bodies, dt);
    }
  }
  w.first_of_land = w.touches.size();
  for (std::size_t a = 0; a < bodies.size(); ++a)
    if (w.settings.land && !bodies[a].asleep) w.touch_land(a, bodies[a].body);
  w.pull_lines(bodies);
  w.moving.clear();
  for (const Collider& collider : bodies) w.moving.push_back(collider.body);
  w.solver.solve(w.settings.solver, dt, w.moving, w.touches, w.pulls);

  std::fill(impulses.begin(), impulses.end(), ContactImpulses{});
  for (std::size_t n = 0; n < w.touches.size(); ++n) {
    const Touch& touch = w.touches[n];
    (n < w.first_of_land ? impulses[touch.a].hit_ns : impulses[touch.a].ground_ns) += touch.impulse_ns;
    if (!touch.b) continue;
    impulses[*touch.b].hit_ns += touch.impulse_ns;
    if (touch.impulse_ns > 0.0) bodies[touch.a].asleep = bodies[*touch.b].asleep = false;
  }
  w.tensions_n.assign(w.settings.lines.size(), 0.0);
  for (const Pull& pull : w.pulls) {
    w.tensions_n[pull.line] = pull.impulse_ns / dt;
    impulses[pull.body].lines_ns += pull.impulse_ns;
    if (!pull.other) continue;
    impulses[*pull.other].lines_ns += pull.impulse_ns;
    if (pull.impulse_ns > 0.0) bodies[pull.body].asleep = bodies[*pull.other].asleep = false;
  }
}

}  // namespace seascape
