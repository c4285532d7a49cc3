// What the shallows cost when a scene loads: the factors' tables, and bending and shelter over an archipelago by the
// grid's size. What counts are the minima; loads are once a scene, and never in a frame.
#include <benchmark/benchmark.h>

#include "ocean/inputs/inputs.h"
#include "ocean/places/refraction.h"

namespace seascape {
namespace {

struct Sea {
  Sea() { state.swell_height_m = 1.5, bins = make_wave_bins(state, WaveQuality{}); }
  SeaState state;
  WaveBins bins;
};

// Ten islands on a bank 12 m deep, two kilometres wide.
Inputs archipelago() {
  std::vector<InputSpec> specs;
  const auto add = [&](glm::dvec2 at, double size, float height, double feather) {
    InputSpec& spec = specs.emplace_back();
    spec.to = InputTarget::sea_depth, spec.blend = InputBlend::replace, spec.value.x = height, spec.feather_m = feather;
    spec.shape = AreaInput{.round = true, .at_m = at, .size_m = glm::dvec2(size)};
  };
  add({0.0, 0.0}, 2000.0, -12.0f, 300.0);
  for (int i = 0; i < 10; ++i)
    add({700.0 * std::cos(2.4 * i) * std::sqrt(i / 10.0), 700.0 * std::sin(2.4 * i) * std::sqrt(i / 10.0)},
        150.0 + 10.0 * i, 5.0f, 60.0);
  return Inputs(InputTarget::sea_depth, specs);
}

void shallows_tables(benchmark::State& state) {
  const Sea sea;
  for (auto _ : state) benchmark::DoNotOptimize(ShallowWater(sea.state, sea.bins, {30.0, 0.5}));
}
BENCHMARK(shallows_tables)->Unit(benchmark::kMillisecond);

void shallows_factor(benchmark::State& state) {
  const Sea sea;
  const ShallowWater water(sea.state, sea.bins);
  double depth = 0.01;
  for (auto _ : state) {
    benchmark::DoNotOptimize(water.factor(1, depth));
    depth = depth < 100.0 ? depth * 1.01 : 0.01;
  }
}
BENCHMARK(shallows_factor);

void shallows_refraction(benchmark::State& state) {
  const Sea sea;
  const ShallowWater water(sea.state, sea.bins);
  const Inputs bed = archipelago();
  const auto depth = [&](glm::dvec2 place, double footprint) {
    return -double(bed.value(place, footprint, 0.0, glm::vec4(float(-sea.state.depth_m))).x);
  };
  for (auto _ : state)
    benchmark::DoNotOptimize(
        Refraction(sea.state, sea.bins, water, bed.bounds(), depth, {.cells = int(state.range(0))}).empty());
}
BENCHMARK(shallows_refraction)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMillisecond)->UseRealTime();

void shallows_read(benchmark::State& state) {
  const Sea sea;
  const ShallowWater water(sea.state, sea.bins);
  const Inputs bed = archipelago();
  const auto depth = [&](glm::dvec2 place, double footprint) {
    return -double(bed.value(place, footprint, 0.0, glm::vec4(float(-sea.state.depth_m))).x);
  };
  const Refraction r(sea.state, sea.bins, water, bed.bounds(), depth);
  double x = -900.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(r.shift(0, {x, 100.0}));
    benchmark::DoNotOptimize(r.shelter(0, {x, 100.0}));
    x = x < 900.0 ? x + 0.37 : -900.0;
  }
}
BENCHMARK(shallows_read);

}  // namespace
}  // namespace seascape
