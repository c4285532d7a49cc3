#include "app/sea_spec.h"

#include <algorithm>
#include <array>

#include "app/place_inputs.h"
#include "app/scene_hulls.h"
#include "app/sea_remarks.h"
#include "app/tile_sources.h"
#include "ocean/effects.h"

namespace seascape {

namespace {
// Sections of the settings that describe the sea, but for those of their rows that only its picture asks for.
constexpr std::array<std::string_view, 10> sections{"waves.", "gerstner.",      "wave_particles.", "baked.",
                                                    "level.", "dynamic_waves.", "wakes.",          "flow.",
                                                    "clip.",  "sea_depth."};
constexpr std::array<std::string_view, 8> of_the_picture{"waves.change_s",     "waves.resolution",  "waves.cascades",
                                                         "waves.half_storage", "waves.where",       "baked.fade_m",
                                                         "sea_depth.sand",     "sea_depth.growth_m"};
constexpr std::array<std::string_view, 12> effects{"waves",         "gerstner",  "wave_particles", "baked",
                                                   "dynamic_waves", "wakes",     "level",          "flow",
                                                   "clip",          "sea_depth", "albedo",         "shadow"};
}  // namespace

SeaSpec sea_spec(const Scene& scene, const MadeBefore* before) {
  const Settings& s = scene.settings;
  SeaSpec spec;
  const LimitedSea limited = limited_sea(scene);
  spec.state = limited.sea;
  spec.has_waves = calls_for(scene.effects, "waves");
  spec.sources = tile_sources(scene, limited, before);
  spec.place = place_inputs(scene, before);
  if (calls_for(scene.effects, "dynamic_waves")) {
    spec.pressure = before != nullptr ? before->sea.pressure : nullptr;
    if (spec.pressure == nullptr)
      spec.pressure = std::make_shared<const Inputs>(InputTarget::dynamic_waves, scene.inputs);
    spec.dynamic_waves = s.dynamic_waves;
    spec.dynamic_waves->waves.gravity_mps2 = s.sea.gravity_mps2;
    spec.dynamic_waves->waves.depth_m = s.sea.depth_m;
    if (!scene.actors_press && still(*spec.dynamic_waves, !spec.pressure->empty())) spec.dynamic_waves.reset();
  }
  if (calls_for(scene.effects, "wakes")) {
    spec.wakes = s.wakes;
    spec.wakes->waves.gravity_mps2 = s.sea.gravity_mps2;
    spec.wakes->waves.depth_m = s.sea.depth_m;
  }
  const bool floats = calls_for(scene.effects, "boats") && !scene.objects.floating.empty();
  spec.actors_foam = (scene.actors_foam || floats) && calls_for(scene.effects, "foam");
  spec.drawn = s.waves;
  spec.crests_velocity = calls_for(scene.effects, "spray");
  spec.felt_velocity = floats;
  return spec;
}

std::string sea_key(const Scene& scene) {
  std::string key;
  for (const std::string_view effect : effects)
    if (calls_for(scene, effect)) key.append(effect).append(" ");
  if (!hulls_of(scene).still.empty()) key.append("hulls ");
  if (calls_for(scene.effects, "boats")) key.append("boats ");
  for (const Setting& row : settings_table()) {
    const std::string_view name = row.key;
    const auto begins = [&](std::string_view section) { return name.starts_with(section); };
    if (std::none_of(sections.begin(), sections.end(), begins)) continue;
    if (std::find(of_the_picture.begin(), of_the_picture.end(), name) != of_the_picture.end()) continue;
    key.append(name).append("=").append(value_text(scene.settings, row)).append("\n");
  }
  return key;
}

}  // namespace seascape
