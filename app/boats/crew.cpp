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
  std::optional<std::size_t> nearest;
  double least = reach_m;
  std::vector<BoatSeat> seats;
  const SceneObjects& objects = scene.objects;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const Pose boat = bodies.pose_at(n, time_s);
    if (glm::length(boat.position_m - head) > reach_m + 20.0) continue;
    const SolidThing& thing = objects.things[objects.floating[n].thing];
    BoatModel model = boat_model(objects.models[thing.model].model(), objects.floating[n].at);
    for (BoatSeat& seat : model.seats) {
      seat.at_m *= thing.scale;
      const double away = glm::length(seat_place(boat, seat.at_m) - head);
      if (away >= least) continue;
      least = away;
      nearest = n;
    }
    if (nearest == n) seats = std::move(model.seats);
  }
  if (!nearest) return fmt::format("no boat within {:.0f} m", reach_m);
  const Pose boat = bodies.pose_at(*nearest, time_s);
  const std::string& name = bodies.bodies().spec(*nearest).name;
  if ((boat.orientation * glm::dvec3(0.0, 1.0, 0.0)).y < capsized) {
    BodyMotion motion = bodies.bodies().result()[*nearest].motion;
    motion.orientation = heading(motion.orientation);
    motion.velocity = {};
    bodies.bodies().place(*nearest, motion);
    return "righted: " + name;
  }
  body_ = nearest;
  name_ = name;
  seat_ = *std::min_element(seats.begin(), seats.end(),
                            [](const BoatSeat& a, const BoatSeat& b) { return a.role < b.role; });
  view_ = BoatView::deck;
  chased_rad_.reset();
  const auto& hull = *bodies.bodies().spec(*nearest).hull;
  double front = 0.0, back = 0.0;
  for (const glm::dvec3& v : hull.vertices) front = std::min(front, v.z), back = std::max(back, v.z);
  length_m_ = back - front;
  return "aboard: " + name;
}

void Crew::leave(SeaBodies& bodies) {
  if (body_ && *body_ < bodies.size()) bodies.ask(*body_, {.sheet = 0.0});
  forget();
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
