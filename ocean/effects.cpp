#include "ocean/effects.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace seascape {

namespace {

struct Effect {
  std::string_view name;
  bool built;
  std::string_view needs;  // one other effect, or ""
};

constexpr Effect effects[] = {
    {"waves", true, ""},
    {"gerstner", true, "waves"},
    {"wave_particles", true, "waves"},
    {"baked", true, "waves"},
    {"dynamic_waves", true, ""},
    {"foam", true, "waves"},
    {"spray", true, "waves"},
    {"flow", true, ""},
    {"sea_depth", true, ""},
    {"level", true, ""},
    {"clip", true, ""},
    {"shadow", true, ""},
    {"albedo", true, ""},
    {"models", true, ""},
    {"reflections", false, ""},
    {"refraction", false, ""},
    {"caustics", false, ""},
    {"underwater", true, ""},
    {"portals", true, "underwater"},
    {"boats", true, "models"},
    {"wakes", true, "boats"},
    {"clouds", false, ""},
    {"sound", false, ""},
    {"planet", false, ""},
};

constexpr auto names = [] {
  std::array<std::string_view, std::size(effects)> result;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = effects[i].name;
  return result;
}();

const Effect* find(std::string_view name) {
  const auto found =
      std::find_if(std::begin(effects), std::end(effects), [&](const Effect& e) { return e.name == name; });
  return found == std::end(effects) ? nullptr : found;
}

void add(std::vector<EffectEntry>& entries, std::string_view name, const std::string& because) {
  if (std::any_of(entries.begin(), entries.end(), [&](const EffectEntry& entry) { return entry.name == name; })) return;
  const Effect* effect = find(name);
  assert(effect != nullptr);
  if (!effect->needs.empty()) add(entries, effect->needs, std::string(name) + " needs it");
  entries.push_back({std::string(name), because});
}

}  // namespace

std::span<const std::string_view> effect_names() { return names; }
bool effect_is_known(std::string_view name) { return find(name) != nullptr; }
bool effect_is_built(std::string_view name) {
  const Effect* effect = find(name);
  return effect != nullptr && effect->built;
}

std::vector<EffectEntry> closure(const std::vector<std::string>& named) {
  std::vector<EffectEntry> entries;
  for (const std::string& name : named) add(entries, name, "the scene names it");
  // What the scene names is there for the scene's sake, even where another effect came first and needed it.
  for (EffectEntry& entry : entries)
    if (std::find(named.begin(), named.end(), entry.name) != named.end()) entry.because = "the scene names it";
  return entries;
}

bool calls_for(const std::vector<std::string>& named, std::string_view effect) {
  const std::vector<EffectEntry> entries = closure(named);
  return std::any_of(entries.begin(), entries.end(), [&](const EffectEntry& entry) { return entry.name == effect; });
}

}  // namespace seascape
