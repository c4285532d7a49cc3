// The effects a scene can name, which of them exist, and the closure that adds what they need.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seascape {

// Every effect name of the design, built or not.
std::span<const std::string_view> effect_names();
bool effect_is_known(std::string_view name);
bool effect_is_built(std::string_view name);

struct EffectEntry {
  std::string name;
  std::string because;  // "the scene names it" or "foam needs it"
};

// What the named effects call for: each effect once, what is needed before what needs it. Unknown names are a
// programmer's mistake here: scenes are checked when they are read.
std::vector<EffectEntry> closure(const std::vector<std::string>& named);
// Whether it holds `effect`.
bool calls_for(const std::vector<std::string>& named, std::string_view effect);

}  // namespace seascape
