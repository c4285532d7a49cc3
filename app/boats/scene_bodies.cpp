#include "app/boats/scene_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "app/scene_hulls.h"
#include "app/solids/inside_hulls.h"
#include "ocean/effects.h"

namespace seascape {

HullMedia body_media(const Settings& settings) {
  HullMedia media;
  media.gravity_mps2 = settings.sea.gravity_mps2;
  const double to = glm::radians(settings.sea.wind_to_deg);
  media.wind_mps = settings.sea.wind_speed_mps * glm::dvec3(std::sin(to), 0.0, -std::cos(to));
  return media;
}

namespace {

constexpr std::size_t most_colliders = 20000;

std::shared_ptr<const HullCourse> course_of(const BodySpec& spec, const HullMedia& media) {
  HullMesh mesh = *spec.hull;
  for (glm::dvec3& v : mesh.vertices) v -= spec.mass_centre_m;
  const FloatingUpright upright = float_upright(mesh, spec.mass.mass_kg, media);
  return upright.floats ? std::make_shared<const HullCourse>(mesh, upright.waterline_m, media) : nullptr;
}

// Of several insides that whose lid lies highest is open to the sky.
InsideSpec inside_of(const PlacedModel& model, double scale, double bail_kg_s) {
  InsideSpec inside;
  const Model* highest = nullptr;
  for (const auto& one : model.insides())
    if (highest == nullptr || one->most.y > highest->most.y) highest = one.get();
  if (highest == nullptr) return inside;
  inside.hull = std::make_shared<const HullMesh>(hull_of(*highest, scale));
  inside.bail_kg_s = bail_kg_s;
  return inside;
}

// Of things that stand still and have a mesh to run into: each of its parts by itself.
std::vector<StillCollider> still_colliders(const Scene& scene) {
  std::vector<StillCollider> still;
  const SceneObjects& objects = scene.objects;
  std::vector<bool> floats(objects.things.size(), false);
  for (const FloatingThing& one : objects.floating) floats[one.thing] = true;
  std::map<std::size_t, std::vector<HullMesh>> known;
  for (std::size_t t = 0; t < objects.things.size() && still.size() < most_colliders; ++t) {
    const SolidThing& thing = objects.things[t];
    if (floats[t]) continue;
    const auto [found, is_new] = known.try_emplace(thing.model);
    if (is_new)
      for (const auto& mesh : hidden_meshes(objects.models[thing.model].model(), "collision"))
        for (HullMesh& part : parts_of(hull_of(*mesh, 1.0))) found->second.push_back(std::move(part));
    for (const HullMesh& part : found->second) {
      StillCollider collider{objects.names[t], part, thing.pose.position_m, thing.pose.orientation};
      for (glm::dvec3& v : collider.mesh.vertices) v *= thing.scale;
      still.push_back(std::move(collider));
    }
  }
  return still;
}

double length_of(const HullMesh& hull) {
  double front = 0.0, back = 0.0;
  for (const glm::dvec3& v : hull.vertices) front = std::min(front, v.z), back = std::max(back, v.z);
  return std::max(back - front, 0.1);
}

// Cleats and rings of things that stand still.
std::vector<MooringPoint> points_of(const Scene& scene) {
  std::vector<MooringPoint> points;
  const SceneObjects& objects = scene.objects;
  std::vector<bool> floats(objects.things.size(), false);
  for (const FloatingThing& one : objects.floating) floats[one.thing] = true;
  std::map<std::size_t, std::vector<glm::dvec3>> known;
  for (std::size_t t = 0; t < objects.things.size() && points.size() < most_colliders; ++t) {
    const SolidThing& thing = objects.things[t];
    if (floats[t]) continue;
    const auto [found, is_new] = known.try_emplace(thing.model);
    if (is_new) {
      const SolidModel& model = objects.models[thing.model].model();
      found->second = mooring_points_of(model, model.name);
    }
    for (const glm::dvec3& at : found->second)
      points.push_back({objects.names[t], thing.pose.position_m + thing.pose.orientation * (thing.scale * at)});
  }
  return points;
}

}  // namespace

std::vector<HullMesh> parts_of(const HullMesh& mesh) {
  // Each vertex is of the part of the lowest one that it hangs together with.
  std::vector<std::uint32_t> part(mesh.vertices.size());
  std::iota(part.begin(), part.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (part[v] != v) v = part[v] = part[part[v]];
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : {t[1], t[2]}) {
      const std::uint32_t a = root(t[0]), b = root(v);
      part[std::max(a, b)] = std::min(a, b);
    }
  std::vector<HullMesh> parts;
  std::map<std::uint32_t, std::size_t> known;
  std::vector<std::uint32_t> now(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto [found, is_new] = known.emplace(root(v), parts.size());
    if (is_new) parts.emplace_back();
    HullMesh& own = parts[found->second];
    now[v] = std::uint32_t(own.vertices.size());
    own.vertices.push_back(mesh.vertices[v]);
  }
  for (const auto& t : mesh.triangles)
    parts[known.at(root(t[0]))].triangles.push_back({now[t[0]], now[t[1]], now[t[2]]});
  return parts;
}

std::shared_ptr<SeaBodies> scene_bodies(const Scene& scene) {
  const SceneObjects& objects = scene.objects;
  if (objects.floating.empty() || !calls_for(scene.effects, "boats")) return nullptr;
  std::vector<std::optional<BoatModel>> models(objects.models.size());
  std::vector<BodySpec> specs;
  std::vector<BoatSpec> boats;
  BodySurroundings surroundings;
  BodySettings settings;
  settings.media = body_media(scene.settings);
  std::map<std::tuple<std::size_t, double, double>, std::shared_ptr<const HullCourse>> known;  // by model, size, mass
  std::vector<std::shared_ptr<const HullCourse>> courses;
  const bool makes_waves = calls_for(scene.effects, "wakes") || calls_for(scene.effects, "foam");
  std::map<std::tuple<std::size_t, double, double>, std::shared_ptr<const HullWake>> known_wakes;
  std::vector<std::shared_ptr<const HullWake>> wakes;
  for (const FloatingThing& one : objects.floating) {
    const SolidThing& thing = objects.things[one.thing];
    std::optional<BoatModel>& model = models[thing.model];
    if (!model) model = boat_model(objects.models[thing.model].model(), one.at);
    BodySpec spec = body_spec(*model, one.floats, thing.scale, one.at);
    spec.name = objects.names[one.thing];
    if (one.floats.fills) spec.inside = inside_of(objects.models[thing.model], thing.scale, one.floats.bail_kg_s);
    spec.at_m = thing.pose.position_m;
    spec.orientation = thing.pose.orientation;
    auto& course = known[{thing.model, thing.scale, spec.mass.mass_kg}];
    if (course == nullptr && model->is_boat && spec.level != BodyLevel::follow)
      course = course_of(spec, settings.media);
    courses.push_back(course);
    auto& wake = known_wakes[{thing.model, thing.scale, 0.0}];
    if (wake == nullptr && makes_waves && model->is_boat && spec.level != BodyLevel::follow) {
      HullMesh mesh = *spec.hull;
      for (glm::dvec3& v : mesh.vertices) v -= spec.mass_centre_m;
      wake = std::make_shared<const HullWake>(mesh);
    }
    wakes.push_back(model->is_boat ? wake : nullptr);
    specs.push_back(std::move(spec));
    boats.push_back(scaled(model->boat, thing.scale));
    surroundings.fittings.push_back(fittings_of(*model, thing.scale));
    for (const glm::dvec2& to : one.floats.moored_m)
      surroundings.moorings.push_back({boats.size() - 1, made_fast_at(*model, thing.scale, thing.pose, to), to});
  }
  surroundings.still = still_colliders(scene);
  surroundings.points = points_of(scene);
  surroundings.land = calls_for(scene.effects, "sea_depth");
  auto bodies = std::make_shared<SeaBodies>(settings, std::move(specs), std::move(boats), std::move(courses),
                                            insides_of(scene), surroundings);
  for (std::size_t n = 0; n < objects.floating.size(); ++n) {
    bodies->ask(n, objects.floating[n].floats.controls);
    bodies->trim(n);
    if (objects.floating[n].floats.towed) bodies->tow(n);
    if (const auto& course = objects.floating[n].floats.course_m; !course.empty())
      bodies->keep_to(n,
                      Helmsman(course, length_of(*bodies->bodies().spec(n).hull), objects.floating[n].floats.controls));
    if (wakes[n] != nullptr) bodies->makes_waves(n, wakes[n], 8.0 * scene.settings.wakes.waves.windows.texel_m);
  }
  return bodies;
}

}  // namespace seascape
