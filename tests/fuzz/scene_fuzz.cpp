// Any bytes as a scene: read or refused, and what is read lies in every range.
#include "app/scene.h"
#include "ocean/effects.h"
#include "tests/fuzz/fuzz.h"

using namespace seascape;

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
    for (const EffectEntry& effect : closure(scene.effects)) fuzz::require(effect_is_built(effect.name), "effects are built");
    fuzz::require(glm::all(glm::lessThanEqual(glm::abs(scene.start.position_m), glm::dvec3(1e7))), "the camera is near");
  });
  fuzz::require(read == faults.list().empty(), "collecting and throwing agree on whether there is a fault");
  return 0;
}
