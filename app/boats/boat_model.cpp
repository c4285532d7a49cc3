#include "app/boats/boat_model.h"

#include <cmath>
#include <numbers>

#include "app/located_json.h"
#include "app/solids/inside_hulls.h"
#include "engine/error.h"

namespace seascape {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

// Members of one object of the extras. Keys that nobody asks for are for others.
class Extras {
 public:
  Extras(const LocatedJson& json, std::string name, const std::string& where)
      : json_(json), name_(std::move(name)), where_(where) {
    if (!json.is(LocatedJson::Kind::object)) fault("is not an object");
  }
  const LocatedJson* find(const char* key) const { return json_.member(key); }
  double number(const char* key, double least, double most) const {
    return number_of(need(key), name_ + "." + key, least, most, "", where_);
  }
  std::optional<double> maybe(const char* key, double least, double most) const {
    if (find(key) == nullptr) return std::nullopt;
    return number(key, least, most);
  }
  glm::dvec3 place(const char* key) const {
    const std::vector<double> v = numbers_of(need(key), name_ + "." + key, 3, -1e4, 1e4, "m", where_);
    return {v[0], v[1], v[2]};
  }
  std::string text(const char* key) const {
    const LocatedJson* value = find(key);
    return value != nullptr && value->is(LocatedJson::Kind::text) ? value->text : std::string();
  }
  // The larger of a range's ends, rad.
  double range(const char* key, double otherwise_deg) const {
    if (find(key) == nullptr) return otherwise_deg * degree;
    const std::vector<double> v = numbers_of(*find(key), name_ + "." + key, 2, -90.0, 90.0, "deg", where_);
    return std::max(std::abs(v[0]), std::abs(v[1])) * degree;
  }
  template <class Read>
  void each(const char* key, std::size_t most, const Read& read) const {
    const LocatedJson* list = find(key);
    if (list == nullptr) return;
    if (!list->is(LocatedJson::Kind::array) || list->items.size() > most)
      throw Error(where_,
                  name_ + "." + key + ": " + described(*list) + " is not a list of at most " + std::to_string(most),
                  "correct the model's extras (content/models/README.md)");
    for (const LocatedJson& item : list->items) read(Extras(item, name_ + "." + key, where_));
  }

 private:
  [[noreturn]] void fault(const std::string& what) const {
    throw Error(where_, name_ + ": " + what, "correct the model's extras (content/models/README.md)");
  }
  const LocatedJson& need(const char* key) const {
    const LocatedJson* value = find(key);
    if (value == nullptr) fault(std::string(key) + " is missing");
    return *value;
  }
  const LocatedJson& json_;
  std::string name_;
  const std::string& where_;
};

HullMesh triangles_of(const std::vector<std::shared_ptr<const Model>>& meshes) {
  HullMesh all;
  for (const auto& mesh : meshes) {
    const HullMesh one = hull_of(*mesh, 1.0);
    const auto first = std::uint32_t(all.vertices.size());
    all.vertices.insert(all.vertices.end(), one.vertices.begin(), one.vertices.end());
    for (const auto& t : one.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return all;
}

// All that is drawn at its finest, as the file has it.
HullMesh drawn_mesh(const SolidModel& model) {
  HullMesh all;
  const std::vector<glm::dmat4> placed = placed_nodes(model);
  std::vector<bool> drawn(model.nodes.size(), false);
  for (const int root : model.drawn) drawn[std::size_t(root)] = true;
  for (const int index : model.order) {
    const SolidNode& node = model.nodes[std::size_t(index)];
    if (node.parent >= 0 && drawn[std::size_t(node.parent)]) drawn[std::size_t(index)] = true;
    if (!drawn[std::size_t(index)] || node.mesh < 0) continue;
    const bool mirrored = glm::determinant(glm::dmat3(placed[std::size_t(index)])) < 0.0;
    for (const SolidPrimitive& primitive : model.meshes[std::size_t(node.mesh)].primitives) {
      const auto first = std::uint32_t(all.vertices.size());
      for (const glm::vec3& at : primitive.positions)
        all.vertices.push_back(glm::dvec3(placed[std::size_t(index)] * glm::dvec4(at, 1.0)));
      for (std::size_t k = 0; k + 2 < primitive.indices.size(); k += 3) {
        const auto &a = primitive.indices[k], &b = primitive.indices[k + 1], &c = primitive.indices[k + 2];
        all.triangles.push_back({first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
      }
    }
  }
  return welded(all);
}

void read_parts(const Extras& extras, const std::string& where, BoatSpec& boat) {
  if (const LocatedJson* json = extras.find("engine")) {
    const Extras own(*json, "engine", where);
    BoatEngine engine;
    engine.at_m = own.place("at_m");
    engine.propeller.diameter_m = own.number("propeller_m", 0.01, 20.0);
    engine.most_turns_per_s = own.number("turns_per_s", 0.1, 500.0);
    engine.most_power_w = own.number("power_w", 1.0, 1e9);
    engine.most_turn_rad = own.range("range_deg", 0.0);
    boat.engine = engine;
  }
  if (const LocatedJson* json = extras.find("rudder")) {
    const Extras own(*json, "rudder", where);
    BoatRudder rudder;
    rudder.at_m = own.place("at_m");
    rudder.area_m2 = own.number("area_m2", 1e-4, 1e3);
    rudder.aspect = own.number("aspect", 0.1, 20.0);
    rudder.most_rad = own.range("range_deg", 35.0);
    boat.rudder = rudder;
  }
  extras.each("sails", 2, [&](const Extras& own) {
    BoatSail sail;
    sail.centre_m = own.place("centre_m");
    sail.sail.area_m2 = own.number("area_m2", 0.01, 1e4);
    sail.sail.jib = own.text("name") == "jib";
    boat.sails.push_back(sail);
  });
  extras.each("oars", 2, [&](const Extras& own) {
    BoatOar oar;
    oar.pivot_m = own.place("at_m");
    oar.length_m = own.number("length_m", 0.1, 20.0);
    oar.area_m2 = own.number("area_m2", 1e-3, 10.0);
    oar.to_port = oar.pivot_m.x < 0.0;
    boat.oars.push_back(oar);
  });
}

void read_extras(const LocatedJson& json, const std::string& where, BoatModel& boat) {
  const Extras extras(json, "extras.seascape", where);
  boat.is_boat = extras.text("kind") == "hull";
  boat.mass_kg = extras.maybe("mass_kg", 1e-3, 1e10);
  if (extras.find("centre_of_mass_m") != nullptr) boat.mass_centre_m = extras.place("centre_of_mass_m");
  if (const LocatedJson* rows = extras.find("inertia_kgm2")) {
    if (!rows->is(LocatedJson::Kind::array) || rows->items.size() != 3)
      throw Error(where, "extras.seascape.inertia_kgm2: " + described(*rows) + " is no matrix", "give 3 rows of 3");
    glm::dmat3 inertia(0.0);
    for (int row = 0; row < 3; ++row) {
      const std::vector<double> v =
          numbers_of(rows->items[std::size_t(row)], "extras.seascape.inertia_kgm2", 3, -1e15, 1e15, "kg m2", where);
      for (int column = 0; column < 3; ++column) inertia[column][row] = v[std::size_t(column)];
    }
    boat.inertia_kg_m2 = inertia;
  }
  extras.each("seats", 64, [&](const Extras& own) {
    BoatSeat seat;
    seat.at_m = own.place("at_m");
    seat.yaw_deg = own.maybe("yaw_deg", -360.0, 360.0).value_or(0.0);
    const std::string role = own.text("role");
    seat.role = role == "helm" ? SeatRole::helm : role == "rower" ? SeatRole::rower : SeatRole::passenger;
    boat.seats.push_back(seat);
  });
  if (extras.find("moored_at_m") != nullptr) boat.moored_at_m = extras.place("moored_at_m");
  if (extras.find("mooring_ring_m") != nullptr) boat.ring_m = extras.place("mooring_ring_m");
  read_parts(extras, where, boat.boat);
}

// The extras of the first of the scene's roots that has them.
template <class Read>
void with_extras(const SolidModel& model, const std::string& where, const Read& read) {
  for (const int root : model.drawn) {
    const std::string& text = model.nodes[std::size_t(root)].extras;
    if (text.empty()) continue;
    const LocatedJson json = parse_located_json(text, where);
    if (const LocatedJson* own = json.is(LocatedJson::Kind::object) ? json.member("seascape") : nullptr)
      return read(*own);
  }
}

struct Ends {
  glm::dvec3 bow{0.0}, stern{0.0};
};

// The foremost and the aftermost place of a hull's upper edge, a little inside of it; as high as the hull is there, and
// not as its house.
Ends ends_of(const HullMesh& hull) {
  constexpr double inside = 0.9, end = 0.12;  // of the way from the middle; of the length
  double front = 1e300, back = -1e300;
  for (const glm::dvec3& v : hull.vertices) front = std::min(front, v.z), back = std::max(back, v.z);
  Ends ends{{0.0, -1e300, inside * front}, {0.0, -1e300, inside * back}};
  for (const glm::dvec3& v : hull.vertices) {
    if (v.z < front + end * (back - front)) ends.bow.y = std::max(ends.bow.y, v.y);
    if (v.z > back - end * (back - front)) ends.stern.y = std::max(ends.stern.y, v.y);
  }
  return ends;
}

}  // namespace

std::vector<glm::dvec3> mooring_points_of(const SolidModel& model, const std::string& where) {
  std::vector<glm::dvec3> points;
  with_extras(model, where, [&](const LocatedJson& json) {
    const Extras extras(json, "extras.seascape", where);
    if (extras.find("mooring_ring_m") != nullptr) points.push_back(extras.place("mooring_ring_m"));
    const LocatedJson* cleats = extras.find("cleats");
    if (cleats == nullptr) return;
    for (const LocatedJson& cleat : cleats->items) {
      const std::vector<double> v = numbers_of(cleat, "extras.seascape.cleats", 3, -1e4, 1e4, "m", where);
      points.push_back({v[0], v[1], v[2]});
    }
  });
  return points;
}

BodyFittings fittings_of(const BoatModel& model, double scale) {
  if (model.ring_m) return {scale * *model.ring_m};
  if (!model.is_boat) return {};
  const Ends ends = ends_of(model.hull);
  return {scale * ends.bow, scale * ends.stern};
}

BoatModel boat_model(const SolidModel& model, const std::string& where) {
  BoatModel boat;
  with_extras(model, where, [&](const LocatedJson& json) { read_extras(json, where, boat); });
  const auto hulls = hidden_meshes(model, "collision");
  boat.hull = hulls.empty() ? drawn_mesh(model) : triangles_of(hulls);
  try {
    validate(boat.hull, where.c_str());
  } catch (const Error& fault) {
    throw Error(where, "it cannot float: " + fault.fault(),
                hulls.empty() ? "give it a closed mesh in a node called collision, outside of its scene"
                              : "close the mesh of its node collision");
  }
  return boat;
}

BoatSpec scaled(const BoatSpec& boat, double scale) {
  BoatSpec spec = boat;
  const double area = scale * scale;
  if (spec.engine) {
    spec.engine->at_m *= scale;
    spec.engine->propeller.diameter_m *= scale;
    // Froude's rules: speeds go with the root of the length, power with its 3.5th power.
    spec.engine->most_turns_per_s /= std::sqrt(scale);
    spec.engine->most_power_w *= std::pow(scale, 3.5);
  }
  if (spec.rudder) spec.rudder->at_m *= scale, spec.rudder->area_m2 *= area;
  for (BoatSail& sail : spec.sails) sail.centre_m *= scale, sail.sail.area_m2 *= area;
  for (BoatOar& oar : spec.oars) oar.pivot_m *= scale, oar.length_m *= scale, oar.area_m2 *= area;
  return spec;
}

// At the end that is nearer.
glm::dvec3 made_fast_at(const BoatModel& model, double scale, const Pose& pose, const glm::dvec2& to) {
  if (model.moored_at_m) return scale * *model.moored_at_m;
  const auto [bow, stern] = ends_of(model.hull);
  const auto away = [&](const glm::dvec3& at) {
    const glm::dvec3 world = pose.position_m + pose.orientation * (scale * at);
    return std::hypot(world.x - to.x, world.z - to.y);
  };
  return scale * (away(bow) < away(stern) ? bow : stern);
}

BodySpec body_spec(const BoatModel& model, const FloatSpec& floats, double scale, const std::string& where) {
  if (!floats.mass_kg && !model.mass_kg)
    throw Error(where, "nobody says how heavy it is", "add \"mass_kg\" to its \"float\"");
  BodySpec spec;
  auto hull = std::make_shared<HullMesh>(model.hull);
  for (glm::dvec3& v : hull->vertices) v *= scale;
  const HullVolume volume = volume_of(*hull);
  spec.hull = hull;
  spec.level = floats.level;
  const double own = model.mass_kg.value_or(0.0) * scale * scale * scale, mass = floats.mass_kg.value_or(own);
  spec.mass.mass_kg = mass;
  spec.mass_centre_m = model.mass_centre_m ? scale * *model.mass_centre_m : volume.centre_m;
  if (model.inertia_kg_m2 && own > 0.0)
    spec.mass.inertia_kg_m2 = *model.inertia_kg_m2 * (scale * scale * mass / *model.mass_kg);
  else
    spec.mass.inertia_kg_m2 = volume.inertia_m5 * (mass / volume.volume_m3);
  glm::dvec3 least(1e300), most(-1e300);
  for (const glm::dvec3& v : hull->vertices) least = glm::min(least, v), most = glm::max(most, v);
  const glm::dmat3& i = spec.mass.inertia_kg_m2;
  const double length = std::max(most.x - least.x, most.z - least.z);
  spec.planes = model.is_boat;
  if (model.is_boat) {
    // Added masses over the boat's own, and the times in which sway and yaw die down, of a slender hull of 2 m (MSS's
    // Otter, Fossen 2021), longer ones by Froude's rule; heave and pitch come to a fifth, roll to a tenth of critical
    // damping of usual hulls. Ahead she is held back by friction, form and waves.
    const double slower = std::sqrt(length / 2.0), rate = 1.0 / slower;
    spec.mass.added =
        Matrix6::diagonal({1.5 * mass, 1.0 * mass, 0.1 * mass, 0.8 * i[0][0], 1.7 * i[1][1], 0.2 * i[2][2]});
    spec.damping = Matrix6::diagonal({2.5 * mass * rate, 6.0 * mass * rate, 0.02 * mass * rate, 6.0 * i[0][0] * rate,
                                      2.7 * i[1][1] * rate, 1.7 * i[2][2] * rate});
  } else {
    // Half of its own mass, as of a sphere (Lamb 1932, article 92).
    const double rate = 1.0 / std::sqrt(length);
    spec.mass.added =
        Matrix6::diagonal({0.5 * mass, 0.5 * mass, 0.5 * mass, 0.3 * i[0][0], 0.3 * i[1][1], 0.3 * i[2][2]});
    spec.damping = Matrix6::diagonal({0.3 * mass * rate, 3.0 * mass * rate, 0.3 * mass * rate, 2.0 * i[0][0] * rate,
                                      0.3 * i[1][1] * rate, 2.0 * i[2][2] * rate});
  }
  spec.velocity_mps = {floats.velocity_mps.x, 0.0, floats.velocity_mps.y};
  return spec;
}

}  // namespace seascape
