#include "app/sea_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "app/scene_hulls.h"
#include "engine/text.h"
#include "ocean/effects.h"
#include "ocean/waves/dispersion.h"
#include "ocean/waves/spectrum.h"

namespace seascape {

namespace {
std::string metres(double value) { return fmt::format("{:.3g} m", value); }

// What a part of a LimitedSea is called: by its key, but for the wind sea, whose height has none.
constexpr std::array<std::string_view, 5> keys{"the wind sea", "waves.swell_height_m", "waves.swell2_height_m",
                                               "waves.swell3_height_m", "wave_particles.height_m"};

void add_limits(const Scene& scene, std::vector<std::string>& remarks) {
  const LimitedSea limited = limited_sea(scene);
  const double depth_m = scene.settings.sea.depth_m;
  std::string lowered;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const LimitedSea::Waves& waves = limited.waves[i];
    if (waves.too_high)
      lowered += fmt::format("{}{} {} is drawn with {}", lowered.empty() ? "" : ", ", keys[i], metres(waves.asked_m),
                             metres(waves.drawn_m));
    else if (waves.too_steep)
      remarks.push_back(
          fmt::format("{}: {} is steeper than water bears beside the other waves and is drawn with {}; "
                      "give lower or longer waves",
                      keys[i], metres(waves.asked_m), metres(waves.drawn_m)));
  }
  if (!lowered.empty() && depth_m > 0.0)
    remarks.push_back(
        fmt::format("waves.depth_m: {} of water bears waves of {} in all: {}; deepen it or give lower "
                    "waves",
                    metres(depth_m), metres(most_height_of_depth * depth_m), lowered));
}

// What has a time of its own, or comes of all that was before.
void add_unlooped(const Scene& scene, std::vector<std::string>& remarks) {
  const Settings& s = scene.settings;
  if (!(s.sea.loop_s > 0.0)) return;
  std::vector<std::string_view> kept;
  const auto has = [&](std::string_view effect) { return calls_for(scene.effects, effect); };
  if (has("dynamic_waves")) kept.push_back("dynamic waves");
  if (has("wakes")) kept.push_back("wakes");
  if (has("foam") && s.foam.simulated) kept.push_back("foam");
  if (has("spray") && s.spray.amount > 0.0) kept.push_back("spray");
  if (std::any_of(scene.inputs.begin(), scene.inputs.end(),
                  [](const InputSpec& input) { return std::holds_alternative<TrailInput>(input.shape); }))
    kept.push_back("inputs that move");
  if (kept.empty()) return;
  remarks.push_back(
      fmt::format("waves.loop_s: what keeps its own time does not repeat after {} s: {}; leave it out "
                  "where all of the sea has to repeat",
                  text_from(s.sea.loop_s), listed(kept, "and")));
}

// A wave longer than the loop gets the loop for its period, and its water moves faster than gravity has it.
void add_short_loop(const Scene& scene, std::vector<std::string>& remarks) {
  const SeaState& sea = scene.settings.sea;
  if (!(sea.loop_s > 0.0) || !(sea.depth_m > 0.0) || !calls_for(scene.effects, "waves")) return;
  const double longest_m = longest_peak_wave_m(sea);
  if (longest_m == 0.0) return;
  const double peak_s =
      2.0 * std::numbers::pi / airy_frequency(2.0 * std::numbers::pi / longest_m, sea.gravity_mps2, sea.depth_m);
  if (sea.loop_s < peak_s)
    remarks.push_back(
        fmt::format("waves.loop_s: {} s is shorter than the {:.3g} s of the longest waves, which then move too fast; "
                    "give several times that, or 0 for a sea that does not repeat",
                    text_from(sea.loop_s), peak_s));
}

// Only so many hulls of what floats can be cut out of the sea.
void add_wet_insides(const Scene& scene, std::vector<std::string>& remarks) {
  if (!calls_for(scene.effects, "boats")) return;
  const std::vector<BodyInsides> insides = insides_of(scene);
  const SceneObjects& objects = scene.objects;
  std::size_t wet = 0;
  std::string first;
  for (std::size_t n = 0; n < insides.size(); ++n) {
    const std::size_t thing = objects.floating[n].thing;
    if (!insides[n].hulls.empty() || objects.models[objects.things[thing].model].insides().empty()) continue;
    if (wet++ == 0) first = objects.names[thing];
  }
  if (wet == 0) return;
  remarks.push_back(
      fmt::format("objects: the sea is cut out of {} inside hulls of things that float, and water stands in {} more "
                  "things, from '{}' on; let fewer float, or give those first that are looked into",
                  most_clip_bodies, wet, first));
}
}  // namespace

LimitedSea limited_sea(const Scene& scene) {
  const Settings& s = scene.settings;
  if (!calls_for(scene.effects, "waves")) return {s.sea, std::nullopt, {}};
  return limited_sea(s.sea,
                     calls_for(scene.effects, "wave_particles") ? std::optional(s.wave_particles) : std::nullopt);
}

std::vector<std::string> remarks_of(const Scene& scene) {
  std::vector<std::string> remarks = scene.remarks;
  add_limits(scene, remarks);
  if (scene.settings.sea.depth_m <= 0.0 && calls_for(scene.effects, "waves") && !calls_for(scene.effects, "sea_depth"))
    remarks.push_back(
        fmt::format("waves.depth_m: {} is dry land, which is drawn as flat water without the effect "
                    "sea_depth; add it to the scene's effects or deepen the water",
                    metres(scene.settings.sea.depth_m)));
  add_short_loop(scene, remarks);
  add_unlooped(scene, remarks);
  add_wet_insides(scene, remarks);
  return remarks;
}

}  // namespace seascape
