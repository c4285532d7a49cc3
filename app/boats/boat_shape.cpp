#include "app/boats/boat_shape.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "app/boats/line_shape.h"
#include "app/located_json.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180.0;
constexpr double wheel_rad = 2.0 * pi, lever_rad = 40.0 * degree;    // from amidships and neutral to their ends
constexpr double dips_rad = 7.0 * degree, lifts_rad = 4.0 * degree;  // of an oar, from where its file has it
constexpr double flattest = 0.1;                                     // of a sail's camber, which tells its two sides

std::optional<glm::dvec3> axis_in(const std::string& extras) {
  if (extras.empty()) return std::nullopt;
  const LocatedJson json = parse_located_json(extras, "extras");
  const LocatedJson* axis = json.is(LocatedJson::Kind::object) ? json.member("axis") : nullptr;
  if (axis == nullptr || !axis->is(LocatedJson::Kind::array) || axis->items.size() != 3) return std::nullopt;
  const glm::dvec3 v(axis->items[0].number, axis->items[1].number, axis->items[2].number);
  return glm::length(v) > 1e-6 ? std::optional(glm::normalize(v)) : std::nullopt;
}

glm::dmat4 about(const glm::dvec3& axis, double angle) { return glm::mat4_cast(glm::angleAxis(angle, axis)); }

glm::dmat4 cambered(double share) {
  glm::dmat4 scale(1.0);
  scale[0][0] = std::abs(share) < flattest ? std::copysign(flattest, share) : share;
  return scale;
}

}  // namespace

BoatShape::BoatShape(std::shared_ptr<const SolidModel> model) : model_(std::move(model)) {
  using enum Part;
  constexpr std::array<std::pair<std::string_view, Part>, 10> names{{{"rudder", rudder},
                                                                     {"engine", engine},
                                                                     {"propeller", propeller},
                                                                     {"helm", helm},
                                                                     {"throttle", throttle},
                                                                     {"boom", boom},
                                                                     {"mainsail", mainsail},
                                                                     {"jib", jib},
                                                                     {"oar_left", oar_left},
                                                                     {"oar_right", oar_right}}};
  moves_.assign(model_->nodes.size(), -1);
  for (std::size_t i = 0; i < model_->nodes.size(); ++i) {
    const SolidNode& node = model_->nodes[i];
    for (const auto& [name, part] : names)
      if (node.name == name && !node.matrix) {
        moves_[i] = int(moved_.size());
        const glm::dvec3 usual = part == propeller || part == helm ? glm::dvec3(0.0, 0.0, 1.0)
                                 : part == throttle                ? glm::dvec3(1.0, 0.0, 0.0)
                                                                   : glm::dvec3(0.0, 1.0, 0.0);
        moved_.push_back({part, axis_in(node.extras).value_or(usual)});
      }
  }
}

glm::dmat4 BoatShape::turn(const Moved& moved, const BoatParts& parts, const BoatControls& asked, double time_s) const {
  using enum Part;
  const auto sail = [&](std::size_t i) {
    // Filled it bellies to lee; flogging it goes from side to side.
    const double side = parts.boom_rad[i] < 0.0 ? -1.0 : 1.0, flogs = parts.luffing[i];
    return cambered(side * (1.0 - flogs) + 0.6 * flogs * std::sin(13.0 * time_s + 2.0 * double(i)));
  };
  const auto oar = [&](std::size_t side) {
    const double out = side == 0 ? -1.0 : 1.0, swing = std::sin(2.0 * pi * parts.oar_phase[side]);
    const double down = swing > 0.0 ? dips_rad * std::sqrt(swing) : lifts_rad * swing;
    return about({0.0, 1.0, 0.0}, out * parts.oar_ahead[side]) * about({0.0, 0.0, 1.0}, -out * down);
  };
  switch (moved.part) {
    case rudder:
    case engine:
      return about(moved.axis, parts.helm * 35.0 * degree);
    case propeller:
      return about(moved.axis, parts.propeller_rad);
    case helm:
      return about(moved.axis, -parts.helm * wheel_rad);
    case throttle:
      return about(moved.axis, -asked.throttle * lever_rad);
    case boom:
      return about(moved.axis, parts.boom_rad[0]);
    case mainsail:
      return sail(0);
    case jib:
      return about(moved.axis, parts.boom_rad[1]) * sail(1);
    case oar_left:
      return oar(0);
    case oar_right:
      return oar(1);
  }
  return glm::dmat4(1.0);
}

void BoatShape::place(const BoatParts& parts, const BoatControls& asked, double time_s,
                      std::vector<glm::dmat4>& nodes) const {
  nodes.resize(model_->nodes.size());
  for (const int index : model_->order) {
    const auto i = std::size_t(index);
    const SolidNode& node = model_->nodes[i];
    glm::dmat4 local = node.local();
    if (moves_[i] >= 0) local = local * turn(moved_[std::size_t(moves_[i])], parts, asked, time_s);
    nodes[i] = node.parent < 0 ? local : nodes[std::size_t(node.parent)] * local;
  }
}

BoatShapes::BoatShapes(const SceneObjects& objects) : shapes_(objects.models.size()) {
  for (const FloatingThing& one : objects.floating) {
    const std::size_t model = objects.things[one.thing].model;
    if (shapes_[model] != nullptr) continue;
    auto shape = std::make_shared<const BoatShape>(objects.models[model].shared_model());
    if (shape->moves()) shapes_[model] = std::move(shape);
  }
}

void BoatShapes::place(SceneObjects& objects, const SeaBodies& bodies, double time_s) const {
  for (std::size_t n = 0; n < objects.floating.size(); ++n) {
    SolidThing& thing = objects.things[objects.floating[n].thing];
    thing.pose = bodies.pose_at(n, time_s);
    if (const auto& shape = shapes_[thing.model])
      shape->place(bodies.boat(n).parts(), bodies.boat(n).asked(), time_s, thing.nodes);
  }
  place_lines(objects, bodies, time_s);
}

}  // namespace seascape
