// Every setting of the program in one table: its key, unit, default, range and one sentence. The same rows serve scene
// files, --set, the panel of explore and the generated docs.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/adaptive/adaptive_settings.h"
#include "app/comfort_settings.h"
#include "app/headset_settings.h"
#include "app/lamp_settings.h"
#include "app/mirror_settings.h"
#include "app/render_settings.h"
#include "app/sky_settings.h"
#include "app/solids/model_settings.h"
#include "ocean/foam/foam_settings.h"
#include "ocean/foam/spray_settings.h"
#include "ocean/mesh/lod_settings.h"
#include "ocean/places/dynamic_sea_settings.h"
#include "ocean/places/place_settings.h"
#include "ocean/places/wake_settings.h"
#include "ocean/surface/breath_settings.h"
#include "ocean/surface/water_settings.h"
#include "ocean/waves/baked_settings.h"
#include "ocean/waves/gerstner_settings.h"
#include "ocean/waves/sea_state.h"
#include "ocean/waves/wave_particle_settings.h"
#include "ocean/waves/wave_place.h"

namespace seascape {

struct Settings {
  SeaState sea;                                       // keys waves.*
  WaveQuality waves;                                  // keys waves.resolution, waves.cascades, waves.half_storage
  WavePlace wave_place = WavePlace::automatic;        // key waves.where
  BakedSettings baked;                                // keys baked.*
  GerstnerSettings gerstner;                          // keys gerstner.*
  WaveParticleSettings wave_particles;                // keys wave_particles.*
  DynamicSeaSettings dynamic_waves;                   // keys dynamic_waves.*
  WakeSettings wakes;                                 // keys wakes.*
  FoamSettings foam;                                  // keys foam.*
  SpraySettings spray;                                // keys spray.*
  PlaceSettings place;                                // keys place.*, level.*, flow.*, clip.*
  LodSettings lod;                                    // keys lod.*, debug.freeze, debug.drop_patch
  WaterSettings water;                                // keys water.*
  ModelSettings models;                               // keys models.*
  LampSettings dive_light;                            // keys dive_light.*
  BreathSettings breath;                              // keys breath.*
  SkySettings sky;                                    // keys sky.*
  RenderSettings render;                              // keys msaa, frame.*, stereo.*, camera.*, debug.view
  ComfortSettings comfort;                            // keys comfort.*
  HeadsetSettings headset;                            // keys headset.*
  MirrorSettings mirror;                              // keys mirror.*
  AdaptiveUse adaptive_use = AdaptiveUse::automatic;  // key adaptive.use
  AdaptiveSettings adaptive;                          // keys adaptive.*; `on` follows from adaptive_use and the display
  double sea_change_s = 6.0;                          // key waves.change_s
  double time_scale = 1.0;                            // key time.scale
  double time_start_s = 0.0;                          // key time.start_s
  double time_offset_s = 0.0;                         // key time.offset_s
  bool follow_clock = false;                          // key time.follow_clock
};

// Where a row's value lies inside a Settings. An enum is read and written by the number of its name in
// Setting::choices.
using RealMember = double& (*)(Settings&);
using IntegerMember = int& (*)(Settings&);
using SeedMember = std::uint32_t& (*)(Settings&);
using FlagMember = bool& (*)(Settings&);
using TextMember = std::string& (*)(Settings&);
struct ChoiceMember {
  int (*get)(const Settings&);
  void (*set)(Settings&, int);
};

struct Setting {
  std::string_view key;       // "waves.wind_speed_mps": group, point, name; "msaa" has no group
  std::string_view unit;      // "m", "m/s", "deg", "" ...
  std::string_view sentence;  // what it does
  std::variant<RealMember, IntegerMember, SeedMember, FlagMember, ChoiceMember, TextMember> member;
  double least = 0.0, most = 0.0;           // range of a number, both allowed
  std::vector<std::string_view> choices{};  // names of an enum, or the only numbers allowed ("16", "32", "64")
  bool quality = false;                     // set by presets
  std::string_view rebuild{};               // why a change makes objects anew; empty: it is taken as it runs
  bool grows = false;                       // unless waves.change_s lets it grow out of the sea that is there
};

std::span<const Setting> settings_table();
const Setting* find_setting(std::string_view key);

// Whether all rows of a group ("gerstner") have the same values in both.
bool same_group(const Settings& a, const Settings& b, std::string_view group);

using SettingValue = std::variant<bool, double, std::string>;

// The value as it is now: bool of a flag, double of a number, name of a choice or a text.
SettingValue value_of(const Settings& settings, const Setting& setting);
std::string value_text(const Settings& settings, const Setting& setting);
// "0 to 64 m/s", "16, 32 or 64", "true or false", "text".
std::string range_text(const Setting& setting);

// Sets one value or throws Error naming `where`, key, value and range; `settings` is unchanged then.
void set_value(Settings& settings, const Setting& setting, const SettingValue& value, const std::string& where,
               int exit_code = 1);
// The same from text ("--set key=value"); an unknown key is an Error that names the nearest known one.
void set_from_text(Settings& settings, std::string_view key, std::string_view value, const std::string& where,
                   int exit_code = 1);

[[noreturn]] void throw_unknown_key(std::string_view key, const std::string& where, int exit_code = 1);

}  // namespace seascape
