#include "app/boats/crew.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/camera_path.h"

namespace seascape {

namespace {

constexpr double chase_s = 1.5;  // in which a chase follows her heading, but for 1/e

glm::dvec3 seat_place(const Pose& boat, const glm::dvec3& at_m) { return boat.position_m + boat.orientation * at_m; }

double heading_rad(const glm::dquat& orientation) {
  const glm::dvec3 ahead = heading(orientation) * glm::dvec3(0.0, 0.0, -1.0);
  return std::atan2(ahead.x, -ahead.z);
}

struct Reached {
  std::size_t body;
  std::vector<BoatSeat> seats;
};

// The boat whose seat is nearest.
std::optional<Reached> within_reach(const Scene& scene, const SeaBodies& bodies, const glm::dvec3& head,
                                    double time_s) {
  std::optional<Reached> nearest;
  double least = Crew::reach_m;
  const SceneObjects& objects = scene.objects;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const Pose boat = bodies.pose_at(n, time_s);
    if (glm::length(boat.position_m - head) > Crew::reach_m + 20.0) continue;
    const SolidThing& thing = objects.things[objects.floating[n].thing];
    BoatModel model = boat_model(objects.models[thing.model].model(), objects.floating[n].at);
    bool nearer = false;
    for (BoatSeat& seat : model.seats) {
      seat.at_m *= thing.scale;
      const double away = glm::length(seat_place(boat, seat.at_m) - head);
      if (away >= least) continue;
      least = away;
      nearer = true;
    }
    if (nearer) nearest = Reached{n, std::move(model.seats)};
  }
  return nearest;
}

}  // namespace

const char* boat_view_name(BoatView view) {
  return view == BoatView::deck ? "from the deck" : view == BoatView::chase ? "from behind" : "from where you were";
}

std::string Crew::board(const Scene& scene, SeaBodies& bodies, const glm::dvec3& head, double time_s) {
  if (body_) {
    const std::string left = name_;
    leave(bodies);
    return "stepped off: " + left;
  }
  const std::optional<Reached> found = within_reach(scene, bodies, head, time_s);
  if (!found) return fmt::format("no boat within {:.0f} m", reach_m);
  const std::size_t nearest = found->body;
  const Pose boat = bodies.pose_at(nearest, time_s);
  const std::string& name = bodies.bodies().spec(nearest).name;
  if ((boat.orientation * glm::dvec3(0.0, 1.0, 0.0)).y < capsized) {
    BodyMotion motion = bodies.bodies().result()[nearest].motion;
    motion.orientation = heading(motion.orientation);
    motion.velocity = {};
    bodies.bodies().place(nearest, motion);
    return "righted: " + name;
  }
  body_ = last_ = nearest;
  name_ = name;
  seat_ = *std::min_element(found->seats.begin(), found->seats.end(),
                            [](const BoatSeat& a, const BoatSeat& b) { return a.role < b.role; });
  view_ = BoatView::deck;
  chased_rad_.reset();
  const auto& hull = *bodies.bodies().spec(nearest).hull;
  double front = 0.0, back = 0.0;
  for (const glm::dvec3& v : hull.vertices) front = std::min(front, v.z), back = std::max(back, v.z);
  length_m_ = back - front;
  return "aboard: " + name;
}

void Crew::leave(SeaBodies& bodies) {
  if (body_ && *body_ < bodies.size()) bodies.ask(*body_, {.sheet = 0.0});
  const std::optional<std::size_t> last = last_;
  forget();
  last_ = last;
}

std::string Crew::moor(SeaBodies& bodies) const {
  if (!body_) return "you are not aboard";
  if (bodies.moorings().made_fast(*body_)) {
    bodies.cast_off(*body_);
    return "cast off: " + name_;
  }
  const std::vector<std::string> to = bodies.make_fast(*body_, line_m);
  if (to.empty()) return fmt::format("nothing to make fast to within {:.0f} m", line_m);
  return fmt::format("moored: {} to {}", name_, fmt::join(to, " and "));
}

std::string Crew::anchor(SeaBodies& bodies) const {
  if (!body_) return "you are not aboard";
  if (bodies.moorings().anchored(*body_)) {
    bodies.weigh_anchor(*body_);
    return "anchor weighed: " + name_;
  }
  const AnchorDrop drop = bodies.drop_anchor(*body_);
  if (drop.dry) return "there is no water to anchor in";
  if (drop.let_go)
    return fmt::format("anchored: {}, {:.1f} m of water, {:.0f} m of chain", name_, drop.depth_m, drop.chain_m);
  return fmt::format("too deep to anchor: {:.0f} m of water, and her chain is long enough for {:.0f} m", drop.depth_m,
                     drop.most_depth_m);
}

std::string Crew::respawn(const Scene& scene, SeaBodies& bodies, const glm::dvec3& head, double time_s) const {
  std::optional<std::size_t> boat = body_ ? body_ : last_;
  if (!boat)
    if (const auto found = within_reach(scene, bodies, head, time_s)) boat = found->body;
  if (!boat || *boat >= bodies.size()) return fmt::format("no boat within {:.0f} m", reach_m);
  bodies.put_back(*boat);
  return "back where she began: " + bodies.bodies().spec(*boat).name;
}

std::optional<std::string> Crew::press(Action action, const Scene& scene, SeaBodies& bodies, const glm::dvec3& head,
                                       double time_s) {
  switch (action) {
    case Action::board:
      return board(scene, bodies, head, time_s);
    case Action::moor:
      return moor(bodies);
    case Action::anchor:
      return anchor(bodies);
    case Action::respawn:
      return respawn(scene, bodies, head, time_s);
    default:
      return std::nullopt;
  }
}

void Crew::drive(SeaBodies& bodies, const ActionValues& values) const {
  if (!body_) return;
  const auto value = [&](Action action) { return values[std::size_t(action)]; };
  bodies.ask(*body_, {value(Action::throttle), value(Action::helm), value(Action::sheet), value(Action::oar_left),
                      value(Action::oar_right)});
}

void Crew::set_view(BoatView view, const glm::dvec3& head) {
  view_ = view;
  stood_m_ = head;
  chased_rad_.reset();
}

Pose Crew::eyes(const SeaBodies& bodies, double time_s) const {
  const Pose boat = bodies.pose_at(*body_, time_s);
  return {seat_place(boat, seat_.at_m + glm::dvec3(0.0, eyes_m, 0.0)),
          boat.orientation * orientation_from_angles({seat_.yaw_deg, 0.0, 0.0})};
}

Pose Crew::outside(const SeaBodies& bodies, double time_s, double dt_s) {
  const Pose boat = bodies.pose_at(*body_, time_s);
  const double now = heading_rad(boat.orientation);
  const double before = chased_rad_.value_or(now);
  const double turns = std::remainder(now - before, 2.0 * std::numbers::pi);
  chased_rad_ = before - turns * std::expm1(-dt_s / chase_s);
  glm::dvec3 at = stood_m_;
  const glm::dvec3 aim = boat.position_m + glm::dvec3(0.0, 0.15 * length_m_, 0.0);
  if (view_ == BoatView::chase)
    at = boat.position_m + glm::dvec3(-std::sin(*chased_rad_) * 1.8 * length_m_, 0.55 * length_m_ + 0.8,
                                      std::cos(*chased_rad_) * 1.8 * length_m_);
  const glm::dvec3 to = aim - at;
  const double flat = std::hypot(to.x, to.z);
  return {at,
          orientation_from_angles({glm::degrees(std::atan2(to.x, -to.z)), glm::degrees(std::atan2(to.y, flat)), 0.0})};
}

}  // namespace seascape
