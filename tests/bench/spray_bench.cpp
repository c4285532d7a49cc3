// What a step of the spray costs by how much is aloft, its waves apart, and what telling a frame of it does; beside one
// cascade of 256 x 256 samples of the wave field. Minima; one thread.
#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

#include "ocean/foam/spray.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

void spray_step(benchmark::State& state) {
  SpraySettings settings;
  settings.most = int(state.range(0));
  settings.amount = 4.0;  // thinned to the most
  SeaState sea;
  sea.wind_speed_mps = 23.0;
  sea.chop = 1.15;
  const glm::dvec3 viewer{0.0, 6.0, 0.0};
  std::vector<gpu::SprayPuff> shown(std::size_t(settings.most));
  double step = 1e30, waves = 1e30, drawn = 1e30, cascade = 1e30, aloft = 0.0, time_s = 100.0;
  tbb::task_arena one(1);
  one.execute([&] {
    test::OwnSpray spray(settings, sea, SeaSpec{}.crests, 3.85);
    Sea waves_alone(test::spec_of(sea, SeaSpec{}.crests));
    Breaking breaking(waves_alone, 3.85);
    const WaveField field(sea, {64, 1});  // the first cascade has four times the samples
    WaveTiles tiles;
    const auto take = [](double& least_ms, const auto& work) {
      const auto before = std::chrono::steady_clock::now();
      work();
      least_ms = std::min(least_ms,
                          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count());
    };
    spray.update(time_s, viewer);
    for (auto _ : state) {
      time_s += 1.0 / settings.rate_hz;
      take(step, [&] { spray.update(time_s, viewer); });
      take(waves, [&] {
        breaking.evaluate(ticks_from_seconds(time_s));
        benchmark::DoNotOptimize(&breaking.tiles());
      });
      take(drawn, [&] { benchmark::DoNotOptimize(spray.drawn(time_s + 0.01, viewer, shown)); });
      take(cascade, [&] { field.evaluate(ticks_from_seconds(time_s), tiles); });
      aloft += double(spray.puffs().size());
    }
  });
  state.counters["aloft"] = aloft / double(state.iterations());
  state.counters["step_ms"] = step;
  state.counters["of_waves_ms"] = waves;
  state.counters["drawn_ms"] = drawn;
  state.counters["cascade_ms"] = cascade;
  state.counters["step_of_cascade"] = step / cascade;
}
BENCHMARK(spray_step)
    ->ArgName("most")
    ->Arg(500)
    ->Arg(2000)
    ->Arg(8000)
    ->Iterations(60)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace seascape
