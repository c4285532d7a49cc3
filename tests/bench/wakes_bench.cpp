// What a step of the windows of waves that belong to bodies costs, and their surface, by how many there are.
#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "ocean/places/wake_windows.h"

namespace seascape {
namespace {

template <class Work>
void take(double& least_ms, const Work& work) {
  const auto before = std::chrono::steady_clock::now();
  work();
  least_ms =
      std::min(least_ms, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count());
}

// Bodies, sources each, and threads; the settings of the effect. `velocity`: the surface knows it, as bodies ask.
void wake_windows(benchmark::State& state) {
  WakeWindows windows{WakeSettings{}};
  windows.know_velocity(true);
  const double dt_s = 1.0 / 60.0;
  double step_ms = 1e30, surface_ms = 1e30, time_s = 0.0;
  std::vector<WaveSource> sources(std::size_t(state.range(1)));
  tbb::task_arena arena(int(state.range(2)));
  arena.execute([&] {
    const auto say = [&] {
      time_s += dt_s;
      for (std::int64_t body = 0; body < state.range(0); ++body) {
        const glm::dvec2 at(3.0 * time_s, 40.0 * double(body));
        for (std::size_t i = 0; i < sources.size(); ++i)
          sources[i] = {.place_m = at + glm::dvec2(0.3 * double(i % 8), 0.2 * double(i / 8)),
                        .velocity_mps = {3.0, 0.0},
                        .length_m = 3.0,
                        .head_m = 0.05};
        windows.add({.id = std::uint64_t(body + 1), .place_m = at, .velocity_mps = {3.0, 0.0}}, sources);
      }
    };
    // So that a body that has the windows to itself has one astern.
    for (int i = 0; i < 480; ++i) say(), windows.step(dt_s);
    for (auto _ : state) {
      say();
      take(step_ms, [&] { windows.step(dt_s); });
      take(surface_ms, [&] { benchmark::DoNotOptimize(windows.shared_surface()); });
    }
  });
  state.counters["step_ms"] = step_ms;
  state.counters["surface_ms"] = surface_ms;
}
BENCHMARK(wake_windows)
    ->ArgNames({"bodies", "sources", "threads"})
    ->Args({1, 1, 1})
    ->Args({2, 1, 1})
    ->Args({4, 1, 1})
    ->Args({4, 25, 1})
    ->Args({1, 1, 2})
    ->Args({4, 1, 2})
    ->Args({4, 25, 2})
    ->Iterations(120)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace seascape
