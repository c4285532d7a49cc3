// The timing proof of effects: a scene that had one and lost it takes as long as one that never had it (truths.md,
// section 5: 1,000 frames of either in turn; the 95 % interval of the median difference lies within the greater of 1 %
// and 5 us): 6,000 frames of either, in sixty rounds of scenes built anew. Control in the same run, with a fifteenth of
// the frames: with the effect they take longer than that.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "app/effect_costs.h"
#include "engine/error.h"
#include "ocean/effects.h"
#include "tests/bench/gpu.h"

namespace seascape::bench {
namespace {

constexpr int frames_a_round = 100, rounds = 60, control_rounds = 4;
const ExperienceOptions small{96, 54, 1, false, false};

// The first scene of ours that names the effect (the last from the root of the project).
std::string scene_of(const std::string& effect) {
  for (const char* name : {"open_sea", "storm", "rain_pool", "gerstner", "baked", "whirlpool", "rivers", "lagoon",
                           "harbour_clip", "docs/data/every_effect.json"})
    try {
      const Scene scene = load_scene(name, "low");
      if (std::find(scene.effects.begin(), scene.effects.end(), effect) != scene.effects.end()) return name;
    } catch (const Error&) {
    }
  return {};
}

// `present`: the control, the effect is not taken away.
void effect_time(benchmark::State& state, const std::string& effect, bool present) {
  const std::string name = scene_of(effect);
  if (name.empty()) return state.SkipWithError("no scene names it");
  Scene with = load_scene(name, "low");
  if (name.find('/') != std::string::npos) with.effects = {"waves", effect};  // of the scene that has all
  Scene without = with;
  std::erase(without.effects, effect);
  for (auto _ : state) {
    double frame_ms = 1e30;
    const Cost cost = difference(
        [&] {
          auto absent = std::make_unique<CostSubject>(gpu().device, gpu().shaders, with, small);
          if (!present) absent->experience().apply_effects(without.effects);
          for (int n = 0; n < 3; ++n) absent->draw_ms(n);
          return absent;
        },
        [&] {
          auto never = std::make_unique<CostSubject>(gpu().device, gpu().shaders, without, small);
          for (int n = 0; n < 3; ++n) frame_ms = std::min(frame_ms, never->draw_ms(n));
          return never;
        },
        frames_a_round, present ? control_rounds : rounds);
    const double bound_ms = std::max(0.01 * frame_ms, 0.005);
    state.counters["frame_us"] = 1e3 * frame_ms;
    state.counters["median_us"] = 1e3 * cost.ms.middle;
    state.counters["low_us"] = 1e3 * cost.ms.low;
    state.counters["high_us"] = 1e3 * cost.ms.high;
    state.counters["bound_us"] = 1e3 * bound_ms;
    state.counters["within"] = cost.ms.low > -bound_ms && cost.ms.high < bound_ms;
  }
  state.SetLabel(name + ", " + gpu().device.facts().name);
}

[[maybe_unused]] const int registered = [] {
  for (const std::string_view effect : effect_names()) {
    if (!effect_is_built(effect)) continue;
    for (const bool present : {false, true})
      benchmark::RegisterBenchmark(
          (std::string(present ? "effect_present/" : "effect_absent/") + std::string(effect)).c_str(), effect_time,
          std::string(effect), present)
          ->Iterations(1)
          ->Unit(benchmark::kSecond);
  }
  return 0;
}();

}  // namespace
}  // namespace seascape::bench
