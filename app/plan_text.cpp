#include "app/plan_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/csv.h"
#include "app/quality.h"

namespace seascape {

namespace {

using nlohmann::ordered_json;

std::string mebibytes(std::uint64_t bytes) { return fmt::format("{:.2f}", double(bytes) / 1048576.0); }

// What of it there is.
std::string moved_text(const PlanMoved& moved) {
  std::string text;
  const auto add = [&](const char* what, std::uint64_t bytes) {
    if (bytes > 0) text += fmt::format("{}{} {} MiB", text.empty() ? "; " : ", ", what, mebibytes(bytes));
  };
  add("loads", moved.loaded);
  add("stores", moved.stored);
  add("copies", moved.copied);
  return text;
}

std::string pass_line(const PlanPass& pass) {
  std::string text = fmt::format("    {:<18}", pass.name);
  text += pass.once ? "once         " : "every frame  ";
  if (pass.times > 1) text += fmt::format("{} passes, ", pass.times);
  if (pass.draws) text += fmt::format("{} draw{}, {} triangles", pass.draws, pass.draws > 1 ? "s" : "", pass.triangles);
  if (pass.draws && pass.dispatches) text += ", ";
  if (pass.dispatches) text += fmt::format("{} dispatch{}", pass.dispatches, pass.dispatches > 1 ? "es" : "");
  if ((pass.draws || pass.dispatches) && pass.copies) text += ", ";
  if (pass.copies) text += fmt::format("{} cop{} into images", pass.copies, pass.copies > 1 ? "ies" : "y");
  return text + moved_text(pass.moved) + "\n";
}

std::string effect_text(const PlanEffect& effect) {
  std::string text = fmt::format("{}: {}\n", effect.name, effect.because);
  if (effect.passes.empty())
    text += "  passes     none of its own\n";
  else
    text += "  passes\n";
  for (const PlanPass& pass : effect.passes) text += pass_line(pass);
  if (!effect.pipelines.empty()) {
    text += "  pipelines  ";
    for (std::size_t i = 0; i < effect.pipelines.size(); ++i) text += (i ? ", " : "") + effect.pipelines[i];
    text += '\n';
  }
  if (!effect.modules.empty()) text += "  modules\n";
  for (const PlanModule& module : effect.modules)
    text += fmt::format("    {:<24} {:>7} words{}\n", module.name, module.words,
                        module.part_of.empty() ? "" : ", within the module of " + module.part_of);
  if (!effect.resources.empty()) text += "  memory\n";
  for (const PlanResource& resource : effect.resources)
    text += fmt::format("    {:<6} {:<24} {:>9} MiB\n", resource.kind, resource.name, mebibytes(resource.bytes));
  return text + '\n';
}

std::string total_line(const std::string& name, const PlanTotals& t) {
  return fmt::format("{:<16} {:>6} {:>6} {:>10} {:>10} {:>9} {:>7} {:>7} {:>9} {:>9}\n", name, t.passes, t.draws,
                     t.triangles, t.dispatches, t.pipelines, t.modules, t.words, t.resources, mebibytes(t.bytes));
}

ordered_json moved_json(const PlanMoved& moved) {
  return {{"loaded_bytes", moved.loaded}, {"stored_bytes", moved.stored}, {"copied_bytes", moved.copied}};
}

ordered_json totals_json(const PlanTotals& t) {
  return {{"passes", t.passes},
          {"draws", t.draws},
          {"triangles", t.triangles},
          {"dispatches", t.dispatches},
          {"moved", moved_json(t.moved)},
          {"pipelines", t.pipelines},
          {"modules", t.modules},
          {"words", t.words},
          {"resources", t.resources},
          {"other_objects", t.other_objects},
          {"bytes", t.bytes}};
}

ordered_json effect_json(const PlanEffect& effect) {
  ordered_json passes = ordered_json::array(), modules = ordered_json::array(), resources = ordered_json::array();
  for (const PlanPass& pass : effect.passes)
    passes.push_back({{"name", pass.name},
                      {"when", pass.once ? "once" : "every frame"},
                      {"times", pass.times},
                      {"draws", pass.draws},
                      {"triangles", pass.triangles},
                      {"dispatches", pass.dispatches},
                      {"copies", pass.copies},
                      {"moved", moved_json(pass.moved)}});
  for (const PlanModule& module : effect.modules) {
    ordered_json entry = {{"name", module.name}, {"words", module.words}};
    if (!module.part_of.empty()) entry["part_of"] = module.part_of;
    modules.push_back(std::move(entry));
  }
  for (const PlanResource& resource : effect.resources)
    resources.push_back({{"kind", resource.kind}, {"name", resource.name}, {"bytes", resource.bytes}});
  return {{"name", effect.name},
          {"because", effect.because},
          {"passes", std::move(passes)},
          {"pipelines", effect.pipelines},
          {"modules", std::move(modules)},
          {"resources", std::move(resources)},
          {"other_objects", effect.other_objects},
          {"bytes", effect.bytes}};
}

// The settings of each preset, and its costs where the scene was measured.
ordered_json presets_json(const PresetCosts* costs) {
  ordered_json presets = ordered_json::object();
  const std::span<const std::string_view> names = preset_names();
  for (std::size_t p = 0; p < names.size(); ++p) {
    ordered_json settings = ordered_json::object(), figures = ordered_json::array();
    for (const PresetLine& line : setting_lines()) settings[line.what] = line.of[p];
    if (costs != nullptr)
      for (const PresetCost& row : costs->rows)
        figures.push_back({{"what", row.what}, {"unit", row.unit}, {"value", row.of[p]}});
    presets[std::string(names[p])] = {{"settings", std::move(settings)}, {"costs", std::move(figures)}};
  }
  if (costs != nullptr) presets["measured"] = measured_how(*costs);
  return presets;
}

void add(PlanMoved& sum, const PlanMoved& moved) {
  sum.loaded += moved.loaded;
  sum.stored += moved.stored;
  sum.copied += moved.copied;
}

}  // namespace

PlanTotals totals_of(const PlanEffect& effect) {
  PlanTotals t;
  for (const PlanPass& pass : effect.passes) {
    if (pass.once) continue;
    t.passes += pass.times;
    t.draws += pass.draws;
    t.triangles += pass.triangles;
    t.dispatches += pass.dispatches;
    add(t.moved, pass.moved);
  }
  t.pipelines = effect.pipelines.size();
  for (const PlanModule& module : effect.modules) {
    if (!module.part_of.empty()) continue;  // counted with that part
    ++t.modules;
    t.words += module.words;
  }
  t.resources = effect.resources.size();
  t.other_objects = effect.other_objects;
  t.bytes = effect.bytes;
  return t;
}

PlanTotals totals_of(const Plan& plan) {
  PlanTotals sum;
  sum.passes = plan.passes;
  for (const PlanEffect& effect : plan.effects) {
    const PlanTotals t = totals_of(effect);
    sum.draws += t.draws;
    sum.triangles += t.triangles;
    sum.dispatches += t.dispatches;
    add(sum.moved, t.moved);
    sum.pipelines += t.pipelines;
    sum.modules += t.modules;
    sum.words += t.words;
    sum.resources += t.resources;
    sum.other_objects += t.other_objects;
    sum.bytes += t.bytes;
  }
  return sum;
}

std::string plan_text(const Plan& plan) {
  std::string text =
      fmt::format("{} at {}: {}x{}, {} view{}, {} x MSAA, on {}\n\n", plan.scene, plan.preset, plan.width, plan.height,
                  plan.views, plan.views > 1 ? "s" : "", plan.msaa, plan.device);
  for (const std::string& remark : plan.remarks) text += "warning: " + remark + "\n";
  if (!plan.remarks.empty()) text += '\n';
  for (const PlanEffect& effect : plan.effects) text += effect_text(effect);
  text += fmt::format("{:<16} {:>6} {:>6} {:>10} {:>10} {:>9} {:>7} {:>7} {:>9} {:>9}\n", "a frame", "passes", "draws",
                      "triangles", "dispatches", "pipelines", "modules", "words", "resources", "MiB");
  for (const PlanEffect& effect : plan.effects) text += total_line(effect.name, totals_of(effect));
  const PlanTotals all = totals_of(plan);
  text += total_line("all", all);
  return text + fmt::format("\na frame's attachments load {} MiB and store {} MiB; its copies move {} MiB\n",
                            mebibytes(all.moved.loaded), mebibytes(all.moved.stored), mebibytes(all.moved.copied));
}

std::string plan_json(const Plan& plan, const PresetCosts* costs) {
  ordered_json effects = ordered_json::array();
  for (const PlanEffect& effect : plan.effects) effects.push_back(effect_json(effect));
  ordered_json json = {{"version", 1},
                       {"scene", plan.scene},
                       {"preset", plan.preset},
                       {"device", plan.device},
                       {"width", plan.width},
                       {"height", plan.height},
                       {"views", plan.views},
                       {"msaa", plan.msaa},
                       {"warnings", plan.remarks},
                       {"effects", std::move(effects)},
                       {"totals", totals_json(totals_of(plan))},
                       {"presets", presets_json(costs)}};
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string plan_csv(const Plan& plan) {
  std::string text =
      "scene,preset,effect,because,passes,draws,triangles,dispatches,pipelines,modules,words,resources,bytes\n";
  for (const PlanEffect& effect : plan.effects) {
    const PlanTotals t = totals_of(effect);
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(plan.scene), plan.preset, effect.name,
                        csv_cell(effect.because), t.passes, t.draws, t.triangles, t.dispatches, t.pipelines, t.modules,
                        t.words, t.resources, t.bytes);
  }
  return text;
}

}  // namespace seascape
