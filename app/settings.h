// Every setting of the program in one table: its key, unit, default, range and one sentence. The same rows serve scene
// files, --set, the panel of explore and the generated docs.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/render_settings.h"
#include "app/sky_settings.h"
#include "ocean/lod/lod_settings.h"
#include "ocean/surface/water_settings.h"
#include "ocean/waves/sea_state.h"

namespace seascape {

enum class WavesWhere { automatic, gpu, cpu };

struct Settings {
  SeaState sea;          // keys waves.*
  WaveQuality waves;     // keys waves.resolution, waves.cascades, waves.half_storage
  LodSettings lod;       // keys lod.*, debug.drop_patch
  WaterSettings water;   // keys water.*
  SkySettings sky;       // keys sky.*
  RenderSettings render; // keys msaa, frame.*, stereo.*, camera.*
  double time_scale = 1.0;   // key time.scale
  double time_start_s = 0.0; // key time.start_s
};

// One row. `member` finds the value inside a Settings; an enum or choice row reads and writes its name.
struct Setting {
  std::string_view key;
  std::string_view unit;      // "m", "m/s", "deg", "" ...
  std::string_view sentence;  // what it does
  std::variant<std::function<double&(Settings&)>, std::function<int&(Settings&)>, std::function<bool&(Settings&)>,
               std::function<std::uint32_t&(Settings&)>, std::function<std::string(Settings&, const std::string*)>> member;
  double least = 0.0, most = 0.0;           // range of a number, both allowed
  std::vector<std::string_view> choices{};  // of a name, or the only numbers allowed ("16", "32", "64")
  bool quality = false;                     // set by presets
  bool rebuild = false;                     // a change makes GPU objects anew
};

std::span<const Setting> settings_table();
const Setting* find_setting(std::string_view key);

// Sets one value from text ("--set key=value") or throws Error naming `where`, key, value and range; `settings` is
// unchanged then.
void set_from_text(Settings& settings, std::string_view key, std::string_view value, const std::string& where);

// "low", "medium", "high", "ultra"; "auto" picks by device class (see quality.h). Applies the preset's rows.
void apply_preset(Settings& settings, std::string_view preset);

}  // namespace seascape
