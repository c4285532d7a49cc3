// What the CPU's sea costs: its waves and its tiles.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "app/quality.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

Settings settings_of(std::int64_t preset) {
  Settings settings;
  apply_preset(settings, preset_names()[std::size_t(preset)]);
  return settings;
}

// What a new wind costs before its first frame: its waves and their statistics, on all cores.
void new_sea(benchmark::State& state) {
  Settings settings = settings_of(state.range(0));
  settings.sea.swell_height_m = 0.6;
  for (auto _ : state) {
    ++settings.sea.seed;
    const WaveBins bins = make_wave_bins(settings.sea, settings.waves);
    benchmark::DoNotOptimize(sea_statistics(settings.sea, bins).height_variance);
  }
  state.SetLabel(std::string(preset_names()[std::size_t(state.range(0))]));
}
BENCHMARK(new_sea)->DenseRange(0, 3)->Unit(benchmark::kMillisecond)->UseRealTime();

// All tiles of a preset with their mip chains for one time, on all cores.
void evaluate_tiles(benchmark::State& state) {
  const Settings settings = settings_of(state.range(0));
  const WaveField field(settings.sea, settings.waves);
  WaveTiles tiles(true);
  double time_s = 0.0;
  for (auto _ : state) {
    field.evaluate(ticks_from_seconds(time_s += 1.0 / 90.0), tiles);
    benchmark::ClobberMemory();
  }
  state.SetLabel(std::string(preset_names()[std::size_t(state.range(0))]));
}
BENCHMARK(evaluate_tiles)->DenseRange(0, 3)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace seascape
