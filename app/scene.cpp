#include "app/scene.h"

#include <algorithm>

#include "app/camera_path.h"
#include "app/located_json.h"
#include "app/loop_file.h"
#include "app/quality.h"
#include "app/scene_hulls.h"
#include "app/scene_inputs.h"
#include "engine/files.h"
#include "engine/text.h"
#include "ocean/effects.h"
#include "ocean/inputs/inputs.h"
#include "ocean/places/dynamic_sea.h"
#include "ocean/places/place_fields.h"
#include "ocean/waves/baked.h"
#include "ocean/waves/gerstner.h"
#include "ocean/waves/wave_particle_settings.h"

namespace seascape {

namespace {

// The part of a key before its point, "" for a key without a group.
std::string_view group_of(std::string_view key) {
  const std::size_t dot = key.find('.');
  return dot == std::string_view::npos ? std::string_view() : key.substr(0, dot);
}

void set_from_json(Settings& settings, const Setting& setting, const LocatedJson& json, const std::string& place) {
  SettingValue value;
  switch (json.kind) {
    case LocatedJson::Kind::flag:
      value = json.flag;
      break;
    case LocatedJson::Kind::number:
      value = json.number;
      break;
    case LocatedJson::Kind::text:
      value = json.text;
      break;
    default:
      throw Error(place, std::string(setting.key) + ": " + described(json) + " is not a single value",
                  "give " + range_text(setting));
  }
  set_value(settings, setting, value, place);
}

// Reads the settings of one group ("" for those without).
void read_group(Settings& settings, ObjectReader& reader, std::string_view group, Faults& faults) {
  for (const Setting& setting : settings_table()) {
    if (group_of(setting.key) != group) continue;
    const std::string_view key = group.empty() ? setting.key : setting.key.substr(group.size() + 1);
    if (const LocatedJson* json = reader.optional(key))
      faults.attempt([&] { set_from_json(settings, setting, *json, reader.place(*json)); });
  }
}

std::string effect_of(const LocatedJson& entry, const std::vector<std::string>& before, const std::string& place) {
  const std::string& name = entry.text;
  if (!entry.is(LocatedJson::Kind::text))
    throw Error(place, "effects: " + described(entry) + " is not a name", "write \"waves\"");
  if (!effect_is_known(name))
    throw Error(place, "effects: unknown effect " + in_quotes(name) + did_you_mean(name, effect_names()),
                "take one of: " + listed(effect_names(), "and"));
  if (!effect_is_built(name))
    throw Error(place, "effects: the effect " + in_quotes(name) + " is not built yet in this version", "remove it");
  if (std::find(before.begin(), before.end(), name) != before.end())
    throw Error(place, "effects: " + in_quotes(name) + " is given twice", "remove one of the two");
  return name;
}

std::vector<std::string> read_effects(const LocatedJson& json, const ObjectReader& reader, Faults& faults) {
  std::vector<std::string> effects;
  faults.attempt([&] {
    if (!json.is(LocatedJson::Kind::array))
      throw Error(reader.place(json), "effects: " + described(json) + " is not a list",
                  "write \"effects\": [\"waves\"]");
    for (const LocatedJson& entry : json.items)
      faults.attempt([&] { effects.push_back(effect_of(entry, effects, reader.place(entry))); });
  });
  return effects;
}

void read_camera(Scene& scene, ObjectReader& reader, const std::string& where, Faults& faults) {
  if (const LocatedJson* position = reader.optional("position_m"))
    faults.attempt([&] { scene.start.position_m = position_of(*position, "camera.position_m", where); });
  const double yaw = reader.number("yaw_deg", -360.0, 360.0, 0.0, "deg");
  const double pitch = reader.number("pitch_deg", -90.0, 90.0, 0.0, "deg");
  scene.start.orientation = orientation_from_angles({yaw, pitch, 0.0});
}

// Whether the settings of a group are those of an effect that a scene does not have. Those of waves are the sea's own.
bool lacks_effect_of(const std::vector<std::string>& effects, std::string_view group) {
  return group != "waves" && effect_is_built(group) && !calls_for(effects, group);
}

std::string gives_nothing(std::string_view key, std::string_view effect) {
  return std::string(key) + " gives nothing, for the scene does not name the effect " + in_quotes(effect) + "; add \"" +
         std::string(effect) + "\" to its \"effects\"";
}

void read_scene(Scene& scene, const LocatedJson& json, const std::string& where, Faults& faults) {
  if (const LocatedJson* keys = json.member("keys"); keys != nullptr && keys->is(LocatedJson::Kind::array))
    throw Error(where, "this is a camera path, not a scene", "give it to --path");
  ObjectReader file(json, "", where, faults);
  file.version();
  scene.title = file.text("title", "");
  if (const LocatedJson* effects = file.optional("effects")) scene.effects = read_effects(*effects, file, faults);
  const bool effects_read = faults.list().empty();
  read_group(scene.settings, file, "", faults);
  std::vector<std::string_view> groups;
  for (const Setting& setting : settings_table()) {
    const std::string_view group = group_of(setting.key);
    if (group.empty() || std::find(groups.begin(), groups.end(), group) != groups.end()) continue;
    groups.push_back(group);
    const LocatedJson* members = file.optional(group);
    if (members == nullptr) continue;
    if (effects_read && lacks_effect_of(scene.effects, group))
      scene.remarks.push_back(file.place(*members) + ": " + gives_nothing(group, group));
    ObjectReader reader(*members, std::string(group), where, faults);
    read_group(scene.settings, reader, group, faults);
    if (group == "camera") read_camera(scene, reader, where, faults);
    reader.finish();
  }
  if (const LocatedJson* inputs = file.optional("inputs")) {
    scene.inputs = read_inputs(*inputs, scene.effects, where, faults);
    for (std::string& remark : remarks_of(scene.inputs)) scene.remarks.push_back(std::move(remark));
  }
  if (const LocatedJson* objects = file.optional("objects"))
    scene.objects = read_objects(*objects, scene.effects, where, faults);
  if (const LocatedJson* air = file.optional("air"))
    read_air(*air, scene.effects, scene.objects, where, faults, scene.shapes);
  if (const LocatedJson* portals = file.optional("portals"))
    read_portals(*portals, scene.effects, scene.objects, where, faults, scene.shapes);
  faults.attempt([&] { validate_hulls(scene, where); });
  file.finish();
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& where, std::string_view preset, Faults& faults) {
  Scene scene;
  scene.start.position_m = {0.0, 1.7, 0.0};  // eye height of somebody standing on the still sea
  apply_preset(scene.settings, preset);
  faults.attempt([&] { read_scene(scene, parse_located_json(text, where), where, faults); });
  // What one value alone does not show: whether an effect's settings go together.
  const auto check = [&](std::string_view effect, auto together) {
    if (std::find(scene.effects.begin(), scene.effects.end(), effect) == scene.effects.end()) return;
    faults.attempt([&] {
      try {
        together();
      } catch (const Error& error) {
        throw Error(where, error.where() + ": " + error.fault(), error.remedy());
      }
    });
  };
  const SeaState& sea = scene.settings.sea;
  check("baked", [&] { Baked(read_loop(loop_folder(scene.settings.baked.loop, where)), scene.settings.baked); });
  check("gerstner", [&] {
    const GerstnerSettings& g = scene.settings.gerstner;
    validate_together(Gerstner(g, sea.gravity_mps2, sea.depth_m), Gerstner(g, sea.gravity_mps2, sea.depth_m, 0.0, true),
                      g.chop);
    const bool sets = (g.set1.shore && g.set1.height_m > 0.0) || (g.set2.shore && g.set2.height_m > 0.0);
    const bool splines = std::any_of(scene.inputs.begin(), scene.inputs.end(),
                                     [](const InputSpec& spec) { return spec.to == InputTarget::gerstner; });
    if (!faults.list().empty()) return;  // an input with a fault is not among them
    if (splines && !sets)
      scene.remarks.push_back(
          where + ": inputs to gerstner give nothing, for no set of waves is for them; set gerstner.set1_shore");
    if (sets && !splines)
      scene.remarks.push_back(
          where +
          ": a set of gerstner is for splines and there are none, so that it is nowhere; add an input to gerstner");
  });
  check("dynamic_waves", [&] { validate(scene.settings.dynamic_waves); });
  check("wakes", [&] { validate(scene.settings.wakes); });
  check("foam", [&] { validate(scene.settings.foam); });
  check("spray", [&] { validate(scene.settings.spray); });
  for (const std::string_view effect : {"level", "flow", "clip", "albedo", "shadow"})
    check(effect, [&] { validate(scene.settings.place); });
  check("wave_particles", [&] { validate(scene.settings.wave_particles); });
  return scene;
}

void set_over_file(Scene& scene, const std::string& option, std::string_view key, std::string_view value) {
  set_from_text(scene.settings, key, value, option, 2);
  if (lacks_effect_of(scene.effects, group_of(key)))
    scene.remarks.push_back(option + ": " + gives_nothing(key, group_of(key)));
}

Scene parse_scene(std::string_view text, const std::string& where, std::string_view preset) {
  Faults thrown;
  return parse_scene(text, where, preset, thrown);
}

Scene load_scene(const std::string& name_or_file, std::string_view preset) {
  const std::filesystem::path file = content_file(name_or_file, "scenes");
  Scene scene = parse_scene(read_text(file, largest_json_bytes), file.string(), preset);
  scene.file = file;
  scene.name = file.stem().string();
  return scene;
}

}  // namespace seascape
