// What `seascape plan` found built: by effect, its passes, pipelines, shader code and memory; and its text forms.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/preset_costs.h"

namespace seascape {

// What commands move through the device's memory (BytesMoved of engine/frame.h).
struct PlanMoved {
  std::uint64_t loaded = 0, stored = 0;  // for attachments
  std::uint64_t copied = 0;
};

// What one pass records with this effect's pipelines in one frame.
struct PlanPass {
  std::string name;
  bool once = false;        // recorded by the first frame only, and again when what it depends on changes
  std::uint64_t times = 0;  // how many passes of this name
  std::uint64_t draws = 0, triangles = 0, dispatches = 0;
  std::uint64_t copies = 0;  // uploads into images
  PlanMoved moved = {};
};

struct PlanModule {
  std::string name;
  std::uint64_t words = 0;  // of SPIR-V, as loaded
  std::string part_of;      // not empty: these words lie in a module of that part, and are counted there
};

struct PlanResource {
  std::string kind, name;  // "image" or "buffer"; "host": memory of the processor, not in PlanEffect::bytes
  std::uint64_t bytes = 0;
};

// An effect of the scene, or a part that every scene has.
struct PlanEffect {
  std::string name, because;
  std::vector<PlanPass> passes;
  std::vector<std::string> pipelines;
  std::vector<PlanModule> modules;
  std::vector<PlanResource> resources;
  std::uint64_t other_objects = 0;  // views, samplers, layouts, descriptor pools and the like
  std::uint64_t bytes = 0;          // device memory of all resources
};

struct Plan {
  std::string scene, preset, device;
  int width = 0, height = 0;  // per view
  int views = 0, msaa = 1;
  std::uint64_t passes = 0;  // of a frame: fewer than the effects' sum where two of them draw in one pass
  std::vector<PlanEffect> effects;
  std::vector<std::string> remarks = {};  // what is not as the scene asks (remarks_of)
};

struct PlanTotals {
  std::uint64_t passes = 0, draws = 0, triangles = 0, dispatches = 0;  // of a frame, what is done once left out
  PlanMoved moved = {};                                                // likewise
  std::uint64_t pipelines = 0, modules = 0, words = 0, resources = 0, other_objects = 0, bytes = 0;
};

PlanTotals totals_of(const PlanEffect& effect);
PlanTotals totals_of(const Plan& plan);

// Aligned tables for a person.
std::string plan_text(const Plan& plan);
// `costs`: of its scene's presets; null: not known.
std::string plan_json(const Plan& plan, const PresetCosts* costs = nullptr);
// One row an effect:
// "scene,preset,effect,because,passes,draws,triangles,dispatches,pipelines,modules,words,resources,bytes".
std::string plan_csv(const Plan& plan);

}  // namespace seascape
