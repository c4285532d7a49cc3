#include "app/settings_doc.h"

#include <map>

#include "app/quality.h"
#include "app/settings.h"
#include "ocean/effects.h"

namespace seascape {

namespace {

std::string group_of(std::string_view key) {
  const std::size_t dot = key.find('.');
  return std::string(dot == std::string_view::npos ? "(no group)" : key.substr(0, dot));
}

std::string code(std::string_view text) { return "`" + std::string(text) + "`"; }

}  // namespace

std::string settings_document() {
  std::string text =
      "# Settings\n\n"
      "Written from the table in `app/settings_table.cpp` by `SEASCAPE_WRITE_DOCS=1 ctest --preset release -R "
      "SettingsDoc`;\n"
      "a test compares the two. In a scene file the part before the point is an object: `\"waves\": {\"chop\": 0.8}`. "
      "On the\n"
      "command line: `--set waves.chop=0.8`. Directions are degrees clockwise from -z seen from above and say where "
      "wind and\n"
      "waves go to; the sun's says where it stands. Quality settings are set by the preset unless the scene or `--set` "
      "says\n"
      "otherwise. Settings of an effect that the scene does not name give nothing; a warning says so.\n";
  const Settings defaults;
  std::string group;
  for (const Setting& setting : settings_table()) {
    if (group_of(setting.key) != group) {
      group = group_of(setting.key);
      text += "\n## " + group + "\n\n| Key | Default | Range | What it does |\n|---|---|---|---|\n";
    }
    text += "| " + code(setting.key) + " | " +
            (setting.quality                         ? "preset"
             : value_text(defaults, setting).empty() ? "none"
                                                     : value_text(defaults, setting)) +
            " | " + range_text(setting) + " | " + std::string(setting.sentence) + " |\n";
  }
  text +=
      "\n## Presets\n\n[presets.md](presets.md) has what each sets and what it costs. Low and medium suit a standalone "
      "headset, high and ultra PC VR. `auto` takes " +
      code(resolve_preset("auto", DeviceClass::software)) + " on a software driver, " +
      code(resolve_preset("auto", DeviceClass::integrated)) + " on an integrated GPU, " +
      code(resolve_preset("auto", DeviceClass::discrete)) +
      " on a discrete one, and `high` where there is no device (query). Before a window or a headset, which have a "
      "rate "
      "to hold, explore measures the device once, in two seconds of frames at most, and remembers it by device and "
      "driver; `auto` is then the finest preset that fits ([adaptive.md](adaptive.md)). On a software driver every "
      "preset takes `msaa` 1, unless the scene or `--set` asks for another number than the preset's.\n"
      "\n## Effects\n\nA scene names them in `\"effects\"`; without that key it has `[\"waves\"]`.\n\n";
  std::string built, planned;
  for (const std::string_view name : effect_names())
    (effect_is_built(name) ? built : planned) +=
        (effect_is_built(name) ? built : planned).empty() ? code(name) : ", " + code(name);
  std::map<std::string, std::string> bring;  // by what they need
  for (const std::string_view name : effect_names())
    if (effect_is_built(name))
      if (const auto all = closure({std::string(name)}); all.size() > 1) {
        std::string& list = bring[all[all.size() - 2].name];
        list += list.empty() ? code(name) : ", " + code(name);
      }
  text += "Built: " + built + ".\n";
  for (const auto& [needed, list] : bring)
    text += "Need " + code(needed) + ", which is there with them: " + list + ".\n";
  return text + "`waves.wind_speed_mps` 0 leaves out the wind sea.\nNames kept for later versions, an error today: " +
         planned + ".\n";
}

}  // namespace seascape
