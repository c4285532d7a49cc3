// The shaders' transforms alone: time by the device's own timers, with what they move and compute.
#include <benchmark/benchmark.h>

#include <memory>
#include <random>

#include "tests/support/gpu/gpu_transform.h"

namespace seascape::bench {
namespace {

// Made once: a device takes a third of a second, and ends with the program.
struct Gpu {
  Device device{DeviceOptions{}};
  ShaderLibrary shaders;
};
Gpu& gpu() {
  static Gpu all;
  return all;
}

// One complex field of n x n samples from band x band bins, none of them zero.
void gpu_transform(benchmark::State& state) {
  const int n = int(state.range(0)), band = int(state.range(1)), radix = int(state.range(2)), slots = int(state.range(3));
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.1f, 1.0f);
  std::vector<std::complex<float>> bins(std::size_t(band) * std::size_t(band));
  for (std::complex<float>& bin : bins) bin = {uniform(random), -uniform(random)};
  Frame frame(gpu().device, 4096);
  test::GpuTransform transform(gpu().device, gpu().shaders, n, band, radix, slots, bins);
  const auto run = [&] {
    frame.begin();
    transform.record(frame);
    frame.submit();
    frame.finish();
    double ms = 0.0;
    for (const PassTime& pass : frame.times()) ms += pass.ms;
    return ms;
  };
  state.counters["first_ms"] = run();  // a software driver compiles now
  double least = 1e30;
  for (auto _ : state) {
    const double ms = run();
    least = std::min(least, ms);
    state.SetIterationTime(1e-3 * ms);
  }
  state.counters["least_ms"] = least;
  state.SetLabel(gpu().device.facts().name);
}
BENCHMARK(gpu_transform)
    ->ArgNames({"n", "band", "radix", "slots"})
    ->Args({256, 256, 16, 8})->Args({256, 256, 16, 4})->Args({256, 256, 8, 8})->Args({512, 512, 16, 8})->Args({512, 512, 16, 4})
    ->Args({512, 256, 16, 8})->Args({256, 64, 8, 8})->Args({512, 64, 8, 8})
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

}  // namespace
}  // namespace seascape::bench
