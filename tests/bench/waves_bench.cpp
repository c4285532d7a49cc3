// What the CPU's sea costs: its tiles, and the answers to queries.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "app/quality.h"
#include "ocean/waves/query.h"
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

// Answers at places without order, one thread.
void query_points(benchmark::State& state) {
  const Settings settings = settings_of(state.range(0));
  const WaveField field(settings.sea, settings.waves);
  WaveTiles tiles(true);
  field.evaluate(ticks_from_seconds(10.0), tiles);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-500.0, 500.0);
  std::vector<glm::dvec2> places(4096);
  for (glm::dvec2& place : places) place = {uniform(random), uniform(random)};
  std::vector<QueryAnswer> answers(places.size());
  for (auto _ : state) {
    query(field, tiles, places, answers);
    benchmark::DoNotOptimize(answers.data());
  }
  std::int64_t steps = 0, converged = 0;
  for (const QueryAnswer& answer : answers) {
    steps += answer.iterations;
    converged += answer.converged;
  }
  const auto asked = double(state.iterations()) * double(places.size());
  state.counters["time/point"] = benchmark::Counter(asked, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["steps"] = double(steps) / double(places.size());
  state.counters["converged"] = double(converged) / double(places.size());
  state.SetLabel(std::string(preset_names()[std::size_t(state.range(0))]));
}
BENCHMARK(query_points)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace seascape
