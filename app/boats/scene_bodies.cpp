#include "app/boats/scene_bodies.h"

#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "app/scene_hulls.h"
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

std::shared_ptr<const HullCourse> course_of(const BodySpec& spec, const HullMedia& media) {
  HullMesh mesh = *spec.hull;
  for (glm::dvec3& v : mesh.vertices) v -= spec.mass_centre_m;
  const FloatingUpright upright = float_upright(mesh, spec.mass.mass_kg, media);
  return upright.floats ? std::make_shared<const HullCourse>(mesh, upright.waterline_m, media) : nullptr;
}

}  // namespace

std::shared_ptr<SeaBodies> scene_bodies(const Scene& scene) {
  const SceneObjects& objects = scene.objects;
  if (objects.floating.empty() || !calls_for(scene.effects, "boats")) return nullptr;
  std::vector<std::optional<BoatModel>> models(objects.models.size());
  std::vector<BodySpec> specs;
  std::vector<BoatSpec> boats;
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
  }
  auto bodies =
      std::make_shared<SeaBodies>(settings, std::move(specs), std::move(boats), std::move(courses), insides_of(scene));
  for (std::size_t n = 0; n < objects.floating.size(); ++n) {
    bodies->ask(n, objects.floating[n].floats.controls);
    if (objects.floating[n].floats.towed) bodies->tow(n);
    if (wakes[n] != nullptr) bodies->makes_waves(n, wakes[n], 8.0 * scene.settings.wakes.waves.windows.texel_m);
  }
  return bodies;
}

}  // namespace seascape
