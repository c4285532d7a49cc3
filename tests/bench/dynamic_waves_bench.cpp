// What a step of the dynamic waves costs, and their surface, beside one cascade of 256^2 of the wave field in the same
// loop: what counts are the ratios of minima.
#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "ocean/places/dynamic_surface.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

template <class Work>
void take(double& least_us, const Work& work) {
  const auto before = std::chrono::steady_clock::now();
  work();
  least_us =
      std::min(least_us, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - before).count());
}

// Resolution, levels and sources. One thread, as the cascade.
void dynamic_waves(benchmark::State& state) {
  DynamicWavesSettings s;
  s.windows.resolution = int(state.range(0));
  s.windows.slices = int(state.range(1));
  s.idle_m = 0.0;
  DynamicWaves waves(s);
  DynamicSurface surface(s);
  std::vector<WaveSource> sources;
  for (int i = 0; i < int(state.range(2)); ++i)
    sources.push_back({.place_m = {0.3 * (i % 10) - 1.5, 0.3 * (i / 10) - 1.5},
                       .velocity_mps = {1.0, 0.0},
                       .length_m = 1.5,
                       .head_m = 0.02});
  const LodPlacement placement = lod_placement(s.windows, {0.0, 0.0}, {});
  // The first cascade's tile is larger: a cascade of 256^2 is what two take more than one.
  WaveQuality one_cascade, two_cascades;
  one_cascade.cascades = 1, two_cascades.cascades = 2;
  one_cascade.resolution = two_cascades.resolution = 256;
  const WaveField first(SeaState{}, one_cascade), both(SeaState{}, two_cascades);
  WaveTiles first_tiles, both_tiles;
  double step = 1e30, planes = 1e30, first_us = 1e30, both_us = 1e30, time_s = 0.0;
  tbb::task_arena one(1);
  one.execute([&] {
    waves.advance(1.0 / s.rate_hz, placement, sources);
    for (auto _ : state) {
      take(step, [&] { waves.advance(1.0 / s.rate_hz, placement, sources); });
      take(planes, [&] { surface.evaluate(waves); });
      const std::int64_t ticks = ticks_from_seconds(time_s += 1.0 / 60.0);
      take(first_us, [&] { first.evaluate(ticks, first_tiles); });
      take(both_us, [&] { both.evaluate(ticks, both_tiles); });
    }
  });
  const double cascade = both_us - first_us;
  state.counters["step_us"] = step;
  state.counters["surface_us"] = planes;
  state.counters["cascade_us"] = cascade;
  state.counters["step_ratio"] = step / cascade;
  state.counters["level_ratio"] = step / cascade / double(state.range(1));
  state.counters["surface_ratio"] = planes / cascade;
}
BENCHMARK(dynamic_waves)
    ->ArgNames({"n", "levels", "sources"})
    ->Args({64, 5, 1})
    ->Args({128, 5, 1})
    ->Args({256, 2, 1})
    ->Args({256, 5, 1})
    ->Args({256, 7, 1})
    ->Args({512, 5, 1})
    ->Iterations(60)
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

// What sources add to a step of 6 windows: resolution, sources, and how they are summed (0 wave by wave, 1 through a
// texture, 2 as the program does), on so many threads. They lie around the viewer as the stations of boats' hulls do.
void wave_sources(benchmark::State& state) {
  DynamicWavesSettings s;
  s.windows.resolution = int(state.range(0));
  s.idle_m = 0.0;
  DynamicWaves waves(s), without(s);
  std::vector<WaveSource> sources;
  for (int i = 0; i < int(state.range(1)); ++i)
    sources.push_back({.place_m = {0.3 * (i % 32) - 4.5, 0.3 * (i / 32 % 32) - 4.5},
                       .velocity_mps = {1.0, 0.0},
                       .length_m = 1.0,
                       .rise_mps = 0.02 * (i % 3 - 1.5),
                       .depth_m = i % 2 == 0 ? 0.3 : 0.0});
  for (int i = 0; i < waves.levels(); ++i) waves.level(i).sums().by = state.range(2) == 2 ? -1 : int(state.range(2));
  const LodPlacement placement = lod_placement(s.windows, {0.0, 0.0}, {});
  double step = 1e30, still = 1e30;
  tbb::task_arena arena(int(state.range(3)));
  arena.execute([&] {
    without.advance(1.0 / s.rate_hz, placement, {sources.data(), 1});
    waves.advance(1.0 / s.rate_hz, placement, sources);
    for (auto _ : state) {
      take(step, [&] { waves.advance(1.0 / s.rate_hz, placement, sources); });
      take(still, [&] { without.advance(1.0 / s.rate_hz, placement, {}); });
    }
  });
  state.counters["step_us"] = step;
  state.counters["sources_us"] = step - still;
}
BENCHMARK(wave_sources)
    ->ArgNames({"n", "sources", "by", "threads"})
    ->ArgsProduct({{128, 256}, {1, 2, 4, 8, 10}, {0, 1}, {1}})
    ->ArgsProduct({{128, 256}, {1, 10, 100, 1000}, {2}, {1, 2}})
    ->Iterations(60)
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

}  // namespace
}  // namespace seascape
