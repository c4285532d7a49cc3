#include "tests/support/gpu/settings_that_act.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/text.h"
#include "tests/support/wake_maker.h"

namespace seascape::test {

std::string another(const Settings& settings, const Setting& row) {
  if (std::holds_alternative<FlagMember>(row.member)) return value_text(settings, row) == "true" ? "false" : "true";
  if (!row.choices.empty()) return std::string(row.choices[value_text(settings, row) == row.choices[0] ? 1 : 0]);
  const double now = std::get<double>(value_of(settings, row));
  const double wanted = now == 0.0 ? std::min(2.0, row.most) : now * 0.5 >= row.least ? now * 0.5 : now * 2.0;
  const double value = std::clamp(wanted, row.least, row.most);
  return text_from(std::holds_alternative<RealMember>(row.member) ? value : std::floor(value));
}

namespace {
// One that is there all the time, and two that come later: one that moves and pushes little, and one that stands and
// pushes hard. No window reaches another of them.
std::shared_ptr<SeaActor> boats_apart() {
  return std::make_shared<WakeMaker>(std::vector<WakeMade>{
      {.id = 1, .at_m = {40.0, -110.0}, .velocity_mps = {2.0, 0.0}, .length_m = 5.0, .head_m = 1.0},
      {.id = 2, .at_m = {2.0, -5.0}, .velocity_mps = {0.0, -1.0}, .length_m = 3.0, .head_m = 0.02, .starts_s = 4.4},
      {.id = 3, .at_m = {-60.0, -90.0}, .length_m = 6.0, .head_m = 0.0, .starts_s = 4.4, .rise_mps = 3.0}});
}
}  // namespace

ShotOptions where_it_acts(std::string_view key) {
  const auto begins = [&](const char* with) { return key.starts_with(with); };
  ShotOptions options{.scene = "storm",
                      .preset = "low",
                      .width = 64,
                      .height = 48,
                      // On GPUs too: where the GPU makes the waves, eyes are known to be in the air from higher up
                      // alone, and fewer patches are left out.
                      .set = {{"waves.where", "cpu"},
                              {"waves.resolution", "32"},
                              {"waves.cascades", "3"},
                              {"msaa", "1"},
                              {"foam.simulated", "true"},
                              {"foam.resolution", "64"},
                              {"foam.settle_s", "1"},
                              {"foam.texel_m", "1"}}};
  const auto set = [&](const char* name, const char* value) { options.set.emplace_back(name, value); };
  if (begins("sea_depth.") || begins("foam.shore_")) options.scene = "lagoon";
  if (begins("gerstner.")) {
    options.scene = "gerstner";
    for (const std::string of : {"gerstner.set1_", "gerstner.set2_"})
      for (const auto& [name, value] : {std::pair("octaves", "1"), {"waves", "4"}, {"spread_deg", "40"}})
        options.set.emplace_back(of + name, value);
  }
  if (begins("wave_particles.") || begins("dynamic_waves.")) options.scene = "rain_pool";
  if (begins("wakes.")) {
    options.scene = "open_sea";
    options.effects = std::vector<std::string>{"waves", "wakes"};
    options.actor = boats_apart;
  }
  if (key == "dynamic_waves.idle_m") set("dynamic_waves.rain_per_m2_s", "0.02");  // steps rest
  if (begins("level.") || begins("flow.")) {
    options.scene = "whirlpool";
    set("flow.speed_mps", "1");
  }
  if (begins("clip.")) options.scene = "harbour_clip";
  if (begins("models.")) {
    options.scene = "still_life";
    set("models.shadow_texels", "1024");
  }
  if (begins("dive_light.")) {
    options.scene = "lagoon";
    set("sky.sun_elevation_deg", "-4");
    if (key != "dive_light.on") set("dive_light.on", "true");
  }
  if (begins("place.")) options.scene = "rivers";
  if (begins("baked.")) {
    options.scene = "baked";
    options.set = {{"waves.where", "cpu"}, {"baked.fade_m", "100"}};
  }
  if (begins("waves."))
    for (const char* swell : {"waves.swell_height_m", "waves.swell2_height_m", "waves.swell3_height_m"})
      set(swell, "1");
  if (begins("lod.") && key != "lod.pixel_error" && key != "lod.by") {
    set("lod.by", "threshold");
    set("lod.ocean_size_m", "256");  // doubled as far as the skirt's multiplier says
  }
  if (begins("stereo.")) options.views = 2;
  if (key == "water.red" || key == "water.green" || key == "water.blue" || key == "water.sight_m")
    set("water.type", "colour");
  if (key == "water.anisotropy") {
    set("waves.resolution", "128");
    set("waves.cascades", "5");
  }
  return options;
}

std::string value_in(const Settings& settings, const Setting& row) {
  const std::map<std::string_view, const char*> chosen{
      {"lod.ocean_size_m", "300"},
      {"lod.skirt_multiplier", "1"},
      {"dynamic_waves.idle_m", "0.1"},
      {"wakes.sharpening", "0"},  // where folds limit it, less of it is the same
      {"wakes.least_speed_mps", "10"},
      {"wakes.least_push_m3ps", "100"},
      {"waves.depth_m", "5"},
      {"gerstner.set2_wavelength_m", "60"},
      {"wave_particles.radius_m", "0.3"},
      {"waves.fetch_m", "5000"},
      {"waves.gravity_mps2", "4"},
      {"waves.loop_s", "10"},
      {"msaa", "4"},
      {"stereo.mode", "per-eye"},
      {"waves.where", "gpu"},
      {"frame.lighting", "forward"},
      {"frame.shape", "desktop"},
      {"debug.view", "normals"},
      {"debug.drop_patch", "20"},
      {"foam.simulated", "false"},
      {"camera.near_m", "10"},
      {"water.anisotropy", "16"},
      {"water.type", "9C"},
      {"water.red", "0.2"},
      {"water.green", "0.2"},
      {"water.blue", "0.2"},
      {"water.sight_m", "1"}};
  const auto found = chosen.find(row.key);
  return found == chosen.end() ? another(settings, row) : found->second;
}

}  // namespace seascape::test
