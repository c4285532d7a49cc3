// Any bytes as a scene: read or refused, and what is read lies in every range.
#include <cmath>

#include "app/scene.h"
#include "app/scene_inputs.h"
#include "ocean/effects.h"
#include "ocean/inputs/inputs.h"
#include "ocean/places/shore_lines.h"
#include "tests/fuzz/fuzz.h"

using namespace seascape;

namespace {

// Inputs of every effect, those too that no scene may name yet: what is read gives finite values of its range
// everywhere. Seen to be caught: sums that are not clamped.
void ask_inputs(std::string_view text) {
  fuzz::reads([&] {
    const LocatedJson json = parse_located_json(text, "scene.json");
    const LocatedJson* list = json.member("inputs");
    if (list == nullptr) return;
    std::vector<std::string> effects;
    for (const InputTargetTraits& target : input_targets) effects.emplace_back(target.name);
    Faults faults(true);
    const std::vector<InputSpec> specs = read_inputs(*list, effects, "scene.json", faults);
    for (const std::string& remark : remarks_of(specs))
      fuzz::require(remark.find('\n') == std::string::npos, "a remark is one line");
    const ShoreLines shore(specs, 40.0);
    for (std::size_t t = 0; t < input_targets.size(); ++t) {
      const Inputs inputs(InputTarget(t), specs);
      const InputBounds box = inputs.bounds();
      for (int i = 0; i < 16; ++i) {
        const glm::dvec2 share{(i % 4) / 3.0, (i / 4) / 3.0},
            place = box.empty() ? share : box.least + (box.most - box.least) * share;
        const glm::vec4 value = inputs.value(place, i % 3, 10.0 * i, glm::vec4(0.0f));
        for (int c = 0; c < input_targets[t].channels; ++c)
          fuzz::require(value[c] >= input_targets[t].least && value[c] <= input_targets[t].most,
                        "inputs give what is in their range");
        if (InputTarget(t) != InputTarget::gerstner) continue;
        const ShorePlace along = shore.at(place, i % 3);
        fuzz::require(along.share >= 0.0f && along.share <= 1.0f && std::isfinite(along.bent_m.x + along.bent_m.y),
                      "waves along splines are finite");
      }
    }
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  Faults faults(true);
  parse_scene(text, "scene.json", "low", faults);
  const bool read = fuzz::reads([&] {
    const Scene scene = parse_scene(text, "scene.json", "low");
    for (const Setting& setting : settings_table()) {
      const SettingValue value = value_of(scene.settings, setting);
      if (const double* number = std::get_if<double>(&value))
        fuzz::require(*number >= setting.least && *number <= setting.most, "numbers are in their range");
      Settings again;
      set_value(again, setting, value, "a value that was read");
    }
    for (const EffectEntry& effect : closure(scene.effects))
      fuzz::require(effect_is_built(effect.name), "effects are built");
    fuzz::require(glm::all(glm::lessThanEqual(glm::abs(scene.start.position_m), glm::dvec3(1e7))),
                  "the camera is near");
  });
  ask_inputs(text);
  fuzz::require(read == faults.list().empty(), "collecting and throwing agree on whether there is a fault");
  return 0;
}
