#include "app/scene_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "app/camera_path.h"
#include "app/input_files.h"
#include "engine/text.h"
#include "ocean/effects.h"
#include "shaders/shared/water_line.h"

namespace seascape {

namespace {

using Kind = LocatedJson::Kind;

constexpr std::array<std::string_view, 5> forms{"box", "sphere", "mesh", "disc", "rectangle"};
static_assert(gpu::shape_box == 0 && gpu::shape_sphere == 1 && gpu::shape_planes == 2 && gpu::shape_disc == 3 &&
              gpu::shape_rectangle == 4);
constexpr std::array<std::string_view, 3> modes{"portal", "volume", "fly_through"};
static_assert(gpu::portal_front == 0 && gpu::portal_volume == 1 && gpu::portal_fly_through == 2);
constexpr double least_m = 0.01, most_m = 1000.0;  // of a side
constexpr std::size_t most_planes_a_mesh = 32;

class Reader {
 public:
  Reader(const std::string& where, const SceneObjects& objects, Faults& faults)
      : where_(where), objects_(objects), faults_(faults), files_(where) {}

  void read(const LocatedJson& json, const std::string& name, bool is_portal, std::vector<PlacedShape>& list) {
    const std::size_t before = faults_.list().size();
    ObjectReader reader(json, name, where_, faults_);
    PlacedShape shape;
    if (is_portal)
      if (const LocatedJson* mode = reader.required("mode", R"("mode": "portal")"))
        faults_.attempt([&] { shape.mode = int(chosen(*mode, reader.key_name("mode"), modes)); });
    if (const LocatedJson* own = reader.required("shape", R"("shape": {"kind": "box", "size_m": [4, 2.5, 3]})"))
      faults_.attempt([&] { read_form(*own, reader.key_name("shape"), shape); });
    if (const LocatedJson* at = reader.required("at_m", "\"at_m\": [0, -5, 0]"))
      faults_.attempt([&] { shape.pose.position_m = position_of(*at, reader.key_name("at_m"), where_); });
    const double yaw = reader.number("yaw_deg", -360.0, 360.0, 0.0, "deg"),
                 pitch = reader.number("pitch_deg", -180.0, 180.0, 0.0, "deg"),
                 roll = reader.number("roll_deg", -180.0, 180.0, 0.0, "deg");
    shape.pose.orientation = orientation_from_angles({yaw, pitch, roll});
    if (const LocatedJson* on = reader.optional("on"))
      faults_.attempt([&] { shape.on = thing(*on, reader.key_name("on")); });
    if (!is_portal) read_level(reader, json, shape);
    reader.finish();
    if (faults_.list().size() > before) return;
    faults_.attempt([&] { fits(shape, is_portal, reader, json); });
    if (faults_.list().size() == before) list.push_back(std::move(shape));
  }

 private:
  static std::string line_of(const std::string& where, const LocatedJson& json) {
    return where + ":" + std::to_string(json.line);
  }
  std::size_t chosen(const LocatedJson& json, const std::string& name, std::span<const std::string_view> names) const {
    const auto found = json.is(Kind::text) ? std::find(names.begin(), names.end(), json.text) : names.end();
    if (found == names.end())
      throw Error(line_of(where_, json),
                  name + ": " + described(json) + " is not known" + did_you_mean(json.text, names),
                  "take " + listed(names));
    return std::size_t(found - names.begin());
  }

  void read_level(ObjectReader& reader, const LocatedJson& json, PlacedShape& shape) {
    if (json.member("level_m") != nullptr) shape.level_m = reader.number("level_m", -most_m, most_m, 0.0, "m");
    shape.open_below = reader.flag("open_below", false);
    if (shape.level_m && shape.open_below)
      faults_.attempt([&] {
        throw Error(line_of(where_, json),
                    reader.key_name("level_m") + ": how high water stands follows from open_below",
                    "give one of the two");
      });
  }

  void read_form(const LocatedJson& json, const std::string& name, PlacedShape& shape) {
    ObjectReader reader(json, name, where_, faults_);
    const LocatedJson* kind = reader.required("kind", R"("kind": "box")");
    if (kind == nullptr) return;
    shape.form = int(chosen(*kind, reader.key_name("kind"), forms));
    if (shape.form == gpu::shape_box) {
      const glm::dvec3 sides = read_sides(reader, 3, "\"size_m\": [4, 2.5, 3]");
      shape.half_m = 0.5 * sides;
      shape.radius_m = glm::length(shape.half_m);
    } else if (shape.form == gpu::shape_rectangle) {
      const glm::dvec3 sides = read_sides(reader, 2, "\"size_m\": [2, 1]");
      shape.half_m = {0.5 * sides.x, 0.5 * sides.y, 1.0};
      shape.radius_m = std::hypot(shape.half_m.x, shape.half_m.y);
    } else if (shape.form == gpu::shape_planes) {
      if (const LocatedJson* file = reader.required("file", "\"file\": \"bell.glb\""))
        faults_.attempt([&] { read_mesh(*file, reader.key_name("file"), shape); });
    } else {
      shape.radius_m = reader.required_number("radius_m", least_m, most_m, "m");
      shape.half_m = glm::dvec3(shape.radius_m);
      if (shape.form == gpu::shape_disc) shape.half_m.z = 1.0;
    }
    reader.finish();
  }
  glm::dvec3 read_sides(ObjectReader& reader, std::size_t count, std::string_view example) {
    glm::dvec3 sides(1.0);
    if (const LocatedJson* json = reader.required("size_m", example))
      faults_.attempt([&] {
        const auto numbers = numbers_of(*json, reader.key_name("size_m"), count, least_m, most_m, "m", where_);
        for (std::size_t i = 0; i < count; ++i) sides[int(i)] = numbers[i];
      });
    return sides;
  }

  // The planes of a closed, convex mesh: each of its triangles has all of it behind it.
  void read_mesh(const LocatedJson& json, const std::string& name, PlacedShape& shape) {
    if (!json.is(Kind::text) || json.text.empty() || json.text.find('\0') != std::string::npos)
      throw Error(line_of(where_, json), name + ": " + described(json) + " is no file's name", "write \"bell.glb\"");
    std::shared_ptr<const Model> model;
    try {
      model = files_.model(json.text);
    } catch (const Error& fault) {
      throw Error(line_of(where_, json), name + ": " + fault.where() + ": " + fault.fault(), fault.remedy());
    }
    const double off_m = 1e-3 * std::max(1.0, double(glm::length(model->most - model->least)));
    shape.radius_m = 0.0;
    for (const MeshPart& part : model->parts)
      for (const glm::vec3& corner : part.positions)
        shape.radius_m = std::max(shape.radius_m, glm::length(glm::dvec3(corner)));
    for (const MeshPart& part : model->parts)
      for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        const glm::dvec3 a(part.positions[part.indices[i]]), b(part.positions[part.indices[i + 1]]),
            c(part.positions[part.indices[i + 2]]);
        const glm::dvec3 across = glm::cross(b - a, c - a);
        if (glm::length(across) < 1e-12) continue;
        const glm::dvec3 normal = glm::normalize(across);
        const glm::dvec4 plane(normal, glm::dot(normal, a));
        if (std::any_of(shape.planes.begin(), shape.planes.end(), [&](const glm::dvec4& have) {
              return glm::length(glm::dvec3(have) - normal) < 1e-3 && std::abs(have.w - plane.w) < off_m;
            }))
          continue;
        check_behind(*model, plane, off_m, json, name);
        shape.planes.push_back(plane);
        if (shape.planes.size() > most_planes_a_mesh)
          throw Error(line_of(where_, json),
                      name + ": '" + json.text + "' has more than " + std::to_string(most_planes_a_mesh) + " sides",
                      "give a mesh of at most " + std::to_string(most_planes_a_mesh) + " planes");
      }
    if (shape.planes.size() < 4)
      throw Error(line_of(where_, json), name + ": '" + json.text + "' is not closed", "give a closed, convex mesh");
    shape.half_m = glm::dvec3(1.0);
  }
  void check_behind(const Model& model, const glm::dvec4& plane, double off_m, const LocatedJson& json,
                    const std::string& name) const {
    for (const MeshPart& part : model.parts)
      for (const glm::vec3& corner : part.positions)
        if (const double before = glm::dot(glm::dvec3(plane), glm::dvec3(corner)) - plane.w; before > off_m)
          throw Error(line_of(where_, json),
                      name + ": '" + json.text + "' is not convex: a corner stands " + text_from(before) +
                          " m before one of its sides",
                      "give a closed, convex mesh whose triangles face outwards, or several of them");
  }

  std::size_t thing(const LocatedJson& json, const std::string& name) const {
    const auto found = std::find(objects_.names.begin(), objects_.names.end(), json.text);
    if (!json.is(Kind::text) || found == objects_.names.end()) {
      const std::vector<std::string_view> names(objects_.names.begin(), objects_.names.end());
      throw Error(line_of(where_, json),
                  name + ": " + described(json) + " is no object of the scene" + did_you_mean(json.text, names),
                  "give the \"name\" of one of its \"objects\"");
    }
    return std::size_t(found - objects_.names.begin());
  }

  void fits(const PlacedShape& shape, bool is_portal, const ObjectReader& reader, const LocatedJson& json) const {
    const bool sheet = shape.form == gpu::shape_disc || shape.form == gpu::shape_rectangle;
    const std::string kind(forms[std::size_t(shape.form)]);
    if (sheet && !is_portal)
      throw Error(line_of(where_, json), reader.key_name("shape.kind") + ": a " + kind + " holds no air",
                  "take \"box\", \"sphere\" or \"mesh\"");
    if (sheet && shape.mode != gpu::portal_front)
      throw Error(line_of(where_, json),
                  reader.key_name("shape.kind") + ": a " + kind + " has no inside for the mode '" +
                      std::string(modes[std::size_t(shape.mode)]) + "'",
                  "take \"box\", \"sphere\" or \"mesh\", or the mode \"portal\"");
  }

  const std::string& where_;
  const SceneObjects& objects_;
  Faults& faults_;
  InputFiles files_;
};

void read_list(const LocatedJson& list, const std::string& key, const std::vector<std::string>& effects,
               const SceneObjects& objects, const std::string& where, Faults& faults, bool are_portals,
               std::vector<PlacedShape>& shapes) {
  faults.attempt([&] {
    const std::string place = where + ":" + std::to_string(list.line);
    if (!list.is(Kind::array))
      throw Error(place, key + ": " + described(list) + " is not a list",
                  "write \"" + key + "\": [{" + (are_portals ? "\"mode\": \"portal\", " : "") +
                      "\"shape\": {\"kind\": \"box\", \"size_m\": [4, 2.5, 3]}, \"at_m\": [0, -5, 0]}]");
    const int most = are_portals ? gpu::most_portals : gpu::most_air_pockets;
    if (list.items.size() > std::size_t(most))
      throw Error(place, key + ": " + described(list) + " of " + std::to_string(list.items.size()) + " shapes",
                  "give at most " + std::to_string(most));
    if (!list.items.empty() && !calls_for(effects, "portals"))
      throw Error(place, key + ": the scene does not name the effect 'portals'", "add \"portals\" to its \"effects\"");
    Reader reader(where, objects, faults);
    for (std::size_t i = 0; i < list.items.size(); ++i)
      faults.attempt([&] { reader.read(list.items[i], key + "[" + std::to_string(i) + "]", are_portals, shapes); });
  });
}

// All planes together have so much room.
void check_planes(const SceneShapes& shapes, const std::string& key, const std::string& place) {
  std::size_t planes = 0;
  for (const auto* list : {&shapes.air, &shapes.portals})
    for (const PlacedShape& shape : *list) planes += shape.planes.size();
  if (planes > std::size_t(gpu::most_shape_planes))
    throw Error(place, key + ": the scene's meshes have " + std::to_string(planes) + " sides together",
                "give at most " + std::to_string(gpu::most_shape_planes) + ", or take boxes and spheres");
}

}  // namespace

void read_air(const LocatedJson& list, const std::vector<std::string>& effects, const SceneObjects& objects,
              const std::string& where, Faults& faults, SceneShapes& shapes) {
  read_list(list, "air", effects, objects, where, faults, false, shapes.air);
  faults.attempt([&] { check_planes(shapes, "air", where + ":" + std::to_string(list.line)); });
}

void read_portals(const LocatedJson& list, const std::vector<std::string>& effects, const SceneObjects& objects,
                  const std::string& where, Faults& faults, SceneShapes& shapes) {
  read_list(list, "portals", effects, objects, where, faults, true, shapes.portals);
  faults.attempt([&] { check_planes(shapes, "portals", where + ":" + std::to_string(list.line)); });
}

}  // namespace seascape
