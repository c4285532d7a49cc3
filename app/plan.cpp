// `seascape plan`: builds a scene and says what is there, why, and what it costs. It reads the objects and not the
// request.
#include "app/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/boats/path_on_body.h"
#include "app/commands.h"
#include "app/effect_costs.h"
#include "app/frame.h"
#include "app/measured_presets.h"
#include "app/preset_costs.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/quality.h"
#include "app/scene_hulls.h"
#include "app/sea_remarks.h"
#include "app/sea_time.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/output_folder.h"
#include "ocean/effects.h"

namespace seascape {

namespace {

// Parts that every scene has, by the tag of their EffectScope.
struct Part {
  const char *name, *because;
};
constexpr Part parts[] = {
    {"surface", "the sea is drawn by it"},
    {"sky", "the sea mirrors it and is lit by it"},
    {"frame", "every frame needs targets, and room for what the processor writes for it"},
};

PlanEffect& effect_named(Plan& plan, const std::string& name) {
  const auto found =
      std::find_if(plan.effects.begin(), plan.effects.end(), [&](const PlanEffect& e) { return e.name == name; });
  if (found != plan.effects.end()) return *found;
  plan.effects.push_back({});
  plan.effects.back().name = name;
  plan.effects.back().because = "built, though the scene does not name it";
  return plan.effects.back();
}

void add_object(PlanEffect& effect, const ObjectRecord& object) {
  switch (object.type) {
    case VK_OBJECT_TYPE_PIPELINE:
      effect.pipelines.push_back(object.name);
      break;
    case VK_OBJECT_TYPE_SHADER_MODULE:
      effect.modules.push_back({object.name, object.bytes / 4, ""});
      break;
    case VK_OBJECT_TYPE_IMAGE:
    case VK_OBJECT_TYPE_BUFFER:
      effect.resources.push_back({object.type == VK_OBJECT_TYPE_IMAGE ? "image" : "buffer", object.name, object.bytes});
      effect.bytes += object.bytes;
      break;
    default:
      ++effect.other_objects;
  }
}

// The effect a pass works for is the one its pipeline belongs to, or else the image that it copies into; a pass that
// has neither belongs to the frame.
std::string owner_of(const PipelineWork& work, const std::vector<ObjectRecord>& objects) {
  for (const ObjectRecord& object : objects)
    if (work.pipeline ? object.type == VK_OBJECT_TYPE_PIPELINE && object.handle == std::uint64_t(work.pipeline)
                      : object.type == VK_OBJECT_TYPE_IMAGE && object.handle == std::uint64_t(work.copied_to))
      return object.effect;
  return "frame";
}

// Adds what one frame recorded. `first`: it is the first of the experience.
void add_work(Plan& plan, const std::vector<PipelineWork>& frame, const std::vector<ObjectRecord>& objects,
              bool first) {
  std::vector<PlanEffect> found;  // this frame's passes by effect, for a pass may come several times
  std::vector<std::pair<std::uint32_t, std::string>> counted;
  for (const PipelineWork& work : frame) {
    const std::string owner = owner_of(work, objects);
    auto effect = std::find_if(found.begin(), found.end(), [&](const PlanEffect& e) { return e.name == owner; });
    if (effect == found.end()) {
      found.push_back({});
      found.back().name = owner;
      effect = found.end() - 1;
    }
    auto pass = std::find_if(effect->passes.begin(), effect->passes.end(),
                             [&](const PlanPass& p) { return p.name == work.pass; });
    if (pass == effect->passes.end()) {
      effect->passes.push_back({work.pass, first});
      pass = effect->passes.end() - 1;
    }
    if (const std::pair key(work.pass_number, owner); std::find(counted.begin(), counted.end(), key) == counted.end()) {
      counted.push_back(key);
      ++pass->times;
    }
    pass->draws += work.draws;
    pass->triangles += work.triangles;
    pass->dispatches += work.dispatches;
    pass->copies += work.copies;
    pass->moved.loaded += work.moved.loaded;
    pass->moved.stored += work.moved.stored;
    pass->moved.copied += work.moved.copied;
  }
  for (const PlanEffect& part : found)
    for (const PlanPass& pass : part.passes) {
      std::vector<PlanPass>& passes = effect_named(plan, part.name).passes;
      const auto same =
          std::find_if(passes.begin(), passes.end(), [&](const PlanPass& p) { return p.name == pass.name; });
      if (same == passes.end())
        passes.push_back(pass);
      else
        *same = pass;  // the second frame has it too: it is every frame's
    }
}

// What effects are of code in the surface's shaders: the words that a shader would lack without the effect.
void add_code(Plan& plan, ShaderLibrary& library, const Surface& surface) {
  std::vector<std::shared_ptr<const Shader>> shaders = surface.pipeline().shaders();
  if (&surface.lighting() != &surface.pipeline())
    shaders.insert(shaders.end(), surface.lighting().shaders().begin(), surface.lighting().shaders().end());
  for (const auto& shader : shaders) {
    for (const auto& [effect, code] : surface.effect_values()) {
      std::vector<SpecValue> without = shader->values;
      for (SpecValue& value : without)
        if (value.id == code) value.value = 0;
      const std::size_t lacking = library.load(shader->name, without)->words.size();
      if (lacking < shader->words.size())
        effect_named(plan, effect).modules.push_back({shader->name, shader->words.size() - lacking, "surface"});
    }
  }
}

void draw_once(Experience& experience, Headless& display, double time_s) {
  Frame& frame = experience.frame();
  display.begin();
  frame.begin();
  draw_frame(experience, frame, display.viewpoint(experience.scene().start), time_s);
  display.end(frame, &experience.picture());
  frame.finish();
}

Plan plan_of(const Arguments& arguments, const std::string& preset) {
  Program program = make_program(arguments, preset, device_options());
  const HeadlessOptions options = headless_options(arguments, program.scene.settings.render);
  const bool per_eye =
      draw_per_eye(*program.device, program.shaders, program.scene.settings.render.stereo, options.views);
  Experience experience(*program.device, program.shaders, program.scene,
                        {options.width, options.height, options.views, per_eye, false});
  Plan plan = make_plan(*program.device, program.shaders, experience, program.preset);
  expect_no_validation_messages(*program.device);
  return plan;
}

// Of all effects that are built: time, memory and work of each beside each other.
void write_costs(const Arguments& arguments) {
  Program program = make_program(arguments, arguments.preset, device_options());
  const HeadlessOptions options = headless_options(arguments, program.scene.settings.render);
  const bool per_eye =
      draw_per_eye(*program.device, program.shaders, program.scene.settings.render.stereo, options.views);
  std::vector<std::string> effects;
  for (const std::string_view name : effect_names())
    if (effect_is_built(name)) effects.emplace_back(name);
  std::optional<Progress> progress;
  const CostMatrix matrix =
      measure_costs(*program.device, program.shaders, program.scene, effects,
                    {options.width, options.height, options.views, per_eye, false}, program.preset,
                    arguments.frames > 0 ? arguments.frames : 24, [&](std::size_t done, std::size_t all) {
                      if (!progress) progress.emplace("plan: cost", all);
                      progress->step(done);
                    });
  expect_no_validation_messages(*program.device);
  const std::string name = fmt::format("matrix_{}_{}", matrix.scene, matrix.preset);
  write_atomically(std::filesystem::path(arguments.matrix) / (name + ".csv"), matrix_csv(matrix));
  write_atomically(std::filesystem::path(arguments.matrix) / (name + ".svg"), matrix_svg(matrix));
}

// Puts the scene's rows into the file.
void write_preset_costs(const Arguments& arguments) {
  const std::filesystem::path file = arguments.presets;
  std::vector<PresetCosts> known;
  if (std::filesystem::exists(file)) known = parse_preset_costs(read_text(file), file.string());
  write_atomically(file, preset_costs_csv(known));  // what cannot be written is told before the long work
  std::array<Scene, 4> scenes;
  Program program = make_program(arguments, std::string(preset_names().front()), device_options());
  const DeviceClass device = device_class(program.device->facts());
  for (std::size_t p = 0; p < scenes.size(); ++p) scenes[p] = scene_from(arguments, preset_names()[p], device);
  const HeadlessOptions options = headless_options(arguments, program.scene.settings.render);
  const bool per_eye =
      draw_per_eye(*program.device, program.shaders, program.scene.settings.render.stereo, options.views);
  std::optional<CameraPath> path;
  try {
    path = path_from(arguments, program.scene);
  } catch (const Error&) {
    if (!arguments.path.empty()) throw;  // a scene need not have one
  }
  if (path) validate_rider(*path, program.scene);
  std::optional<Progress> progress;
  PresetCosts costs = measure_presets(
      *program.device, program.shaders, scenes, {options.width, options.height, options.views, per_eye, false},
      path ? &*path : nullptr, arguments.frames > 0 ? arguments.frames : 24, [&](std::size_t done, std::size_t all) {
        if (!progress) progress.emplace("plan: presets", all);
        progress->step(done);
      });
  expect_no_validation_messages(*program.device);
  costs.date = machine_of(program.device->facts(), 0).date.substr(0, std::string_view("2026-11-28").size());
  put(known, std::move(costs));
  write_atomically(file, preset_costs_csv(known));
}

}  // namespace

Plan make_plan(Device& device, ShaderLibrary& shaders, Experience& experience, const std::string& preset) {
  const Scene& scene = experience.scene();
  Plan plan;
  plan.scene = scene.name;
  plan.preset = preset;
  plan.device = device.facts().name;
  plan.width = int(experience.options().width);
  plan.height = int(experience.options().height);
  plan.views = experience.options().views;
  plan.msaa = scene.settings.render.msaa;
  plan.remarks = remarks_of(scene);
  for (const EffectEntry& entry : called_for(scene)) effect_named(plan, entry.name).because = entry.because;
  for (const Part& part : parts) effect_named(plan, part.name).because = part.because;

  HeadlessOptions options;
  options.width = experience.options().width;
  options.height = experience.options().height;
  options.views = plan.views;
  options.vertical_fov_deg = scene.settings.render.vertical_fov_deg;
  options.eye_distance_m = scene.settings.render.eye_distance_m;
  Headless display(options);
  const std::vector<ObjectRecord> objects = device.objects();
  for (const bool first : {true, false}) {
    draw_once(experience, display, sea_time_s(scene.settings, 0.0) + (first ? 0.0 : 0.1));
    add_work(plan, experience.frame().work(), objects, first);
  }
  plan.passes = experience.frame().counts().passes;
  for (const ObjectRecord& object : device.objects()) add_object(effect_named(plan, object.effect), object);
  for (const auto& source : experience.ocean().sources())
    if (const std::size_t bytes = source->source().bytes(); bytes > 0)
      effect_named(plan, std::string(source->source().name())).resources.push_back({"host", "recorded frames", bytes});
  add_code(plan, shaders, experience.surface());
  return plan;
}

int run_plan(const Arguments& arguments) {
  tell_remarks(scene_from(arguments, "high"));  // a faulty scene is told before a folder is made
  if (!arguments.matrix.empty()) {
    const OutputFolder held(arguments.matrix);
    Progress progress("plan: preset", preset_names().size());
    std::size_t done = 0;
    for (const std::string_view preset : preset_names()) {
      const Plan plan = plan_of(arguments, std::string(preset));
      write_atomically(std::filesystem::path(arguments.matrix) / fmt::format("plan_{}_{}.csv", plan.scene, preset),
                       plan_csv(plan));
      progress.step(++done);
    }
    write_costs(arguments);
  }
  if (!arguments.presets.empty()) write_preset_costs(arguments);
  const std::vector<PresetCosts> costs = arguments.presets.empty()
                                             ? shipped_preset_costs()
                                             : parse_preset_costs(read_text(arguments.presets), arguments.presets);
  const Plan plan = plan_of(arguments, arguments.preset);
  const PresetCosts* of_scene = costs_of(costs, plan.scene);
  if (arguments.json)
    fmt::print("{}", plan_json(plan, of_scene));
  else
    fmt::print("{}\n{}", plan_text(plan), preset_table(of_scene, plan.scene));
  return 0;
}

}  // namespace seascape
