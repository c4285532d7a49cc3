#include "app/scene_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "app/camera_path.h"
#include "app/scene.h"
#include "engine/text.h"
#include "ocean/effects.h"
#include "ocean/inputs/hull_map.h"

namespace seascape {

namespace {

using Kind = LocatedJson::Kind;

class Reader {
 public:
  Reader(const std::string& where, const std::vector<std::string>& effects, Faults& faults)
      : where_(where), effects_(effects), faults_(faults) {}

  void read(const LocatedJson& json, const std::string& name) {
    ObjectReader reader(json, name, where_, faults_);
    const std::size_t before = faults_.list().size();
    const LocatedJson* model = reader.required("model", "\"model\": \"rowing_boat\"");
    std::string called = reader.text("name", "");
    SolidThing thing;
    if (const LocatedJson* at = reader.required("at_m", "\"at_m\": [0, 0, 0]"))
      faults_.attempt([&] { thing.pose.position_m = position_of(*at, reader.key_name("at_m"), where_); });
    const double yaw = reader.number("yaw_deg", -360.0, 360.0, 0.0, "deg"),
                 pitch = reader.number("pitch_deg", -180.0, 180.0, 0.0, "deg"),
                 roll = reader.number("roll_deg", -180.0, 180.0, 0.0, "deg");
    thing.scale = reader.number("scale", 0.001, 1000.0, 1.0, "");
    const double count = reader.number("count", 1.0, double(most_things), 1.0, "");
    const double seed = reader.number("seed", 0.0, 4294967295.0, 1.0, "");
    glm::dvec2 area(0.0);
    const LocatedJson* area_json = reader.optional("area_m");
    if (area_json != nullptr)
      faults_.attempt([&] {
        const std::vector<double> sides = numbers_of(*area_json, reader.key_name("area_m"), 2, 0.0, 1e5, "m", where_);
        area = {sides[0], sides[1]};
      });
    std::optional<FloatSpec> floats;
    if (const LocatedJson* json_float = reader.optional("float"))
      faults_.attempt([&] { floats = read_float(*json_float, reader.key_name("float")); });
    for (const auto& [key, value] : {std::pair{"count", count}, std::pair{"seed", seed}})
      if (value != std::floor(value))
        faults_.attempt([&, key = key, value = value] {
          throw Error(where_ + ":" + std::to_string(json.line),
                      reader.key_name(key) + ": " + text_from(value) + " is not a whole number", "give a whole number");
        });
    if (count > 1.0 && area_json == nullptr && faults_.list().size() == before)
      faults_.attempt([&] {
        throw Error(where_ + ":" + std::to_string(json.line), reader.key_name("count") + ": several things need room",
                    "add \"area_m\": [width, depth] in metres");
      });
    reader.finish();
    if (model == nullptr || faults_.list().size() > before) return;
    thing.pose.orientation = orientation_from_angles({yaw, pitch, roll});
    thing.model = model_of(*model, reader);
    if (called.empty()) called = model->text;
    const std::size_t first = objects.things.size();
    place(thing, called, std::size_t(count), area, std::uint32_t(seed), json);
    if (floats) float_all(first, *floats, json);
  }

  SceneObjects objects;

 private:
  std::size_t model_of(const LocatedJson& json, const ObjectReader& reader) {
    const std::string key = reader.key_name("model");
    if (!json.is(Kind::text) || json.text.empty() || json.text.find('\0') != std::string::npos)
      throw Error(reader.place(json), key + ": " + described(json) + " is not a model's name",
                  "write \"rowing_boat\", or the name of a .glb file beside the scene");
    const bool is_file = json.text.ends_with(".glb") || json.text.ends_with(".gltf");
    const std::filesystem::path file = is_file ? std::filesystem::path(where_).parent_path() / json.text
                                               : content_directory() / "models" / (json.text + ".glb");
    const auto [found, is_new] = known_.emplace(file.string(), objects.models.size());
    if (!is_new) return found->second;
    try {
      PlacedModel placed(std::make_shared<const SolidModel>(load_solid_model(file)));
      for (const auto& hull : placed.insides())
        if (const std::string fault = hull_fault(*hull); !fault.empty())
          throw Error(file.string(), in_quotes(hull->name) + ", which is to hold no water, " + fault,
                      "close it, or give its node a name that does not begin with inside_");
      objects.models.push_back(std::move(placed));
    } catch (const Error& fault) {
      known_.erase(found);
      throw Error(reader.place(json), key + ": " + fault.where() + ": " + fault.fault(), fault.remedy());
    }
    return found->second;
  }

  // Scattered things are turned any way, and far from each other: of a few places each takes the one with most room.
  void place(const SolidThing& thing, const std::string& called, std::size_t count, const glm::dvec2& area,
             std::uint32_t seed, const LocatedJson& json) {
    if (objects.things.size() + count > most_things)
      throw Error(where_ + ":" + std::to_string(json.line),
                  "objects: these are over " + std::to_string(most_things) + " things", "scatter fewer");
    if (count == 1) {
      objects.things.push_back(thing);
      objects.names.push_back(called);
      return;
    }
    std::mt19937 random(seed);
    const auto share = [&] { return random() / 4294967296.0; };
    const glm::dquat turned = heading(thing.pose.orientation);
    std::vector<glm::dvec2> taken;
    for (std::size_t i = 0; i < count; ++i) {
      glm::dvec2 best(0.0);
      double most = -1.0;
      for (int attempt = 0; attempt < 8; ++attempt) {
        const double across = share(), along = share();
        const glm::dvec2 at = (glm::dvec2(across, along) - 0.5) * area;
        double room = 1e300;
        const std::size_t first = taken.size() > 2000 ? taken.size() - 2000 : 0;  // enough to keep apart
        for (std::size_t k = first; k < taken.size(); ++k) room = std::min(room, glm::length(at - taken[k]));
        if (room <= most) continue;
        most = room;
        best = at;
      }
      taken.push_back(best);
      SolidThing one = thing;
      one.pose.position_m += turned * glm::dvec3(best.x, 0.0, best.y);
      one.pose.orientation = orientation_from_angles({360.0 * share(), 0.0, 0.0}) * thing.pose.orientation;
      objects.things.push_back(one);
      objects.names.push_back(called + " " + std::to_string(i + 1));
    }
  }

  FloatSpec read_float(const LocatedJson& json, const std::string& name) {
    if (!calls_for(effects_, "boats"))
      throw Error(where_ + ":" + std::to_string(json.line), name + ": the scene does not name the effect 'boats'",
                  "add \"boats\" to its \"effects\", or remove it: the thing then stands still");
    ObjectReader reader(json, name, where_, faults_);
    FloatSpec floats;
    const std::string level = reader.text("level", "hull");
    faults_.attempt([&] {
      constexpr std::array<std::string_view, 3> levels{"hull", "probes", "follow"};
      const auto found = std::find(levels.begin(), levels.end(), level);
      if (found == levels.end())
        throw Error(reader.place(*json.member("level")), reader.key_name("level") + ": '" + level + "' is no level",
                    "write \"hull\", \"probes\" or \"follow\"");
      floats.level = BodyLevel(found - levels.begin());
    });
    if (json.member("mass_kg") != nullptr) floats.mass_kg = reader.number("mass_kg", 1e-3, 1e9, 1.0, "kg");
    if (const LocatedJson* velocity = reader.optional("velocity_mps"))
      faults_.attempt([&] {
        const auto v = numbers_of(*velocity, reader.key_name("velocity_mps"), 2, -100.0, 100.0, "m/s", where_);
        floats.velocity_mps = {v[0], v[1]};
      });
    if (const LocatedJson* moored = reader.optional("moored_m"))
      faults_.attempt([&] { floats.moored_m = read_places(*moored, reader.key_name("moored_m"), 0, 16); });
    if (const LocatedJson* course = reader.optional("course_m"))
      faults_.attempt([&] { floats.course_m = read_places(*course, reader.key_name("course_m"), 2, 64); });
    floats.controls.throttle = reader.number("throttle", -1.0, 1.0, 0.0, "");
    floats.controls.helm = reader.number("helm", -1.0, 1.0, 0.0, "");
    floats.controls.sheet = reader.number("sheet", 0.0, 1.0, 0.5, "");
    floats.fills = reader.flag("fills", false);
    floats.bail_kg_s = reader.number("bail_kg_s", 0.0, 1e5, 0.0, "kg/s");
    floats.towed = reader.flag("towed", false);
    reader.finish();
    return floats;
  }

  std::vector<glm::dvec2> read_places(const LocatedJson& json, const std::string& name, std::size_t least,
                                      std::size_t most) {
    if (!json.is(Kind::array) || json.items.size() < least || json.items.size() > most)
      throw Error(where_ + ":" + std::to_string(json.line), name + ": " + described(json) + " is not a list of places",
                  "write [[x, z], ...], " + (least > 0 ? std::to_string(least) + " to " : std::string("at most ")) +
                      std::to_string(most));
    std::vector<glm::dvec2> places;
    for (const LocatedJson& item : json.items) {
      const auto v = numbers_of(item, name, 2, -1e7, 1e7, "m", where_);
      places.push_back({v[0], v[1]});
    }
    return places;
  }

  void float_all(std::size_t first, const FloatSpec& floats, const LocatedJson& json) {
    const std::string at = where_ + ":" + std::to_string(json.line);
    if (objects.floating.size() + objects.things.size() - first > most_floating)
      throw Error(at, "objects: over " + std::to_string(most_floating) + " things float", "let fewer float");
    const SolidThing& thing = objects.things[first];
    const std::size_t model = thing.model;
    if (boats_.size() <= model) boats_.resize(model + 1);
    try {
      if (!boats_[model]) boats_[model] = boat_model(objects.models[model].model(), at);
      (void)body_spec(*boats_[model], floats, thing.scale, at);  // for its faults
    } catch (const Error& fault) {
      throw Error(at, "objects: " + objects.models[model].model().name + ": " + fault.fault(), fault.remedy());
    }
    for (std::size_t i = first; i < objects.things.size(); ++i) objects.floating.push_back({i, floats, at});
  }

  const std::string& where_;
  const std::vector<std::string>& effects_;
  Faults& faults_;
  std::map<std::string, std::size_t> known_;
  std::vector<std::optional<BoatModel>> boats_;  // of each model that floats
};

}  // namespace

SceneObjects read_objects(const LocatedJson& list, const std::vector<std::string>& effects, const std::string& where,
                          Faults& faults) {
  Reader reader(where, effects, faults);
  faults.attempt([&] {
    const std::string place = where + ":" + std::to_string(list.line);
    if (!list.is(Kind::array))
      throw Error(place, "objects: " + described(list) + " is not a list",
                  "write \"objects\": [{\"model\": \"rowing_boat\", \"at_m\": [0, 0, 0]}]");
    if (list.items.size() > most_objects)
      throw Error(place, "objects: " + described(list), "give at most " + std::to_string(most_objects));
    if (!list.items.empty() && !calls_for(effects, "models"))
      throw Error(place, "objects: the scene does not name the effect 'models'", "add \"models\" to its \"effects\"");
    for (std::size_t i = 0; i < list.items.size(); ++i)
      faults.attempt([&] { reader.read(list.items[i], "objects[" + std::to_string(i) + "]"); });
  });
  return std::move(reader.objects);
}

}  // namespace seascape
