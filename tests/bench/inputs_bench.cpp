// What it costs to fill windows of local data from inputs, 1 to 1,000 of them, beside windows that have none: what
// counts are the ratios of minima.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "ocean/inputs/inputs.h"
#include "ocean/places/lod_windows.h"

namespace seascape {
namespace {

// A mixed lot around the viewer, as a harbour or an archipelago would have it: every fifth a river of eight points.
std::vector<InputSpec> lot(int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1500.0, 1500.0), share(0.0, 1.0);
  std::vector<InputSpec> specs;
  for (int i = 0; i < count; ++i) {
    InputSpec& spec = specs.emplace_back();
    spec.to = InputTarget::level;
    spec.value = {1.0f, 0.0f, 0.0f, 0.0f};
    spec.feather_m = 2.0;
    const glm::dvec2 at = i == 0 ? glm::dvec2(0.0) : glm::dvec2(place(random), place(random));
    const double size = 10.0 + 90.0 * share(random);
    if (i % 5 == 4) {
      SplineInput spline;
      for (int k = 0; k < 8; ++k)
        spline.points.push_back(
            {at + glm::dvec2(0.3 * size * k, 0.4 * size * share(random)), 0.2 * size, glm::vec4(1.0f)});
      spec.shape = std::move(spline);
    } else {
      spec.shape =
          AreaInput{.round = i % 2 == 0, .at_m = at, .size_m = {size, 0.5 * size}, .turn_deg = 360.0 * share(random)};
    }
  }
  return specs;
}

// Windows of 256^2 texels, 8 slices, one thread. The rate at which windows move says how much of this a frame needs: at
// 10 m/s, of slice 0 some 80 columns in a second.
void inputs_fill(benchmark::State& state) {
  const LodWindowSettings settings{.resolution = 256, .slices = 8};
  const LodPlacement placement = lod_placement(settings, {0.0, 0.0}, {});
  const Inputs inputs(InputTarget::level, lot(int(state.range(0))));
  double least_us = 1e30;
  for (auto _ : state) {
    const auto before = std::chrono::steady_clock::now();
    float sum = 0.0f;
    for (int slice = 0; slice < settings.slices; ++slice) {
      const double texel = lod_texel_m(settings, placement, slice);
      for (int z = 0; z < settings.resolution; ++z)
        for (int x = 0; x < settings.resolution; ++x)
          sum += inputs
                     .value((glm::dvec2(placement.first[std::size_t(slice)] + LodIndex(x, z)) + 0.5) * texel, texel,
                            0.0, glm::vec4(0.0f))
                     .x;
    }
    benchmark::DoNotOptimize(sum);
    least_us = std::min(least_us,
                        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - before).count());
  }
  state.counters["fill_ms"] = least_us / 1000.0;
  state.counters["ns_a_texel"] = 1000.0 * least_us / (256.0 * 256.0 * 8.0);
}
BENCHMARK(inputs_fill)
    ->ArgName("inputs")
    ->Arg(0)
    ->Arg(1)
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// Making them: what a scene's loading waits for.
void inputs_make(benchmark::State& state) {
  const std::vector<InputSpec> specs = lot(int(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(Inputs(InputTarget::level, specs).size());
}
BENCHMARK(inputs_make)
    ->ArgName("inputs")
    ->Arg(1)
    ->Arg(1000)
    ->Iterations(20)
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

}  // namespace
}  // namespace seascape
