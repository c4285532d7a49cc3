// What the tiles of sources beside the spectrum cost: Gerstner waves by their number, recorded loops by their size; one
// thread and two.
#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "ocean/waves/baked.h"
#include "ocean/waves/gerstner.h"
#include "tests/support/source_tile.h"

namespace seascape {
namespace {

GerstnerSettings waves_of(std::int64_t count) {
  GerstnerSettings s;
  s.chop = 0.2;
  s.set1 = {.height_m = 0.5, .wavelength_m = 60.0, .spread_deg = 60.0};
  if (count > 1) s.set1.octaves = count >= 16 ? 3 : 1, s.set1.waves = int(count >= 16 ? count / 3 : count);
  return s;
}

// The tile of 256^2 with its whole mip chain by the transform, as it is filled; waves, threads.
void gerstner_tile(benchmark::State& state) {
  const Gerstner source(waves_of(state.range(0)));
  test::SourceTile tile(source, 0);
  std::int64_t ticks = 0;
  tbb::task_arena arena(int(state.range(1)));
  for (auto _ : state) arena.execute([&] { tile.evaluate(source, ticks += 11650); });
  state.counters["waves"] = double(source.waves().size());
}
BENCHMARK(gerstner_tile)->ArgsProduct({{1, 4, 8, 24, 48}, {1, 2}})->Unit(benchmark::kMicrosecond)->UseRealTime();

// The same texels summed wave by wave: each is a product of two complex numbers, of its column and its row, and eight
// fields take a part of it. Its rival: without mip chain and moments, on one thread.
void gerstner_direct(benchmark::State& state) {
  const Gerstner source(waves_of(state.range(0)));
  constexpr int n = Gerstner::tile_samples;
  std::vector<float> fields(8 * n * n);
  const std::size_t count = source.waves().size();
  std::vector<float> column(2 * n * count), row(2 * n * count);
  double time_s = 0.0;
  for (auto _ : state) {
    time_s += 1.0 / 90.0;
    for (std::size_t w = 0; w < count; ++w) {
      const GerstnerWave& wave = source.waves()[w];
      const double frequency = std::sqrt(9.81 * glm::length(source.drawn(wave)));
      for (int i = 0; i < n; ++i) {
        const double x = 2.0 * std::numbers::pi * wave.mx * i / n,
                     z = 2.0 * std::numbers::pi * wave.mz * i / n - frequency * time_s;
        column[(2 * w) * n + i] = float(std::cos(x)), column[(2 * w + 1) * n + i] = float(std::sin(x));
        row[(2 * w) * n + i] = float(wave.amplitude_m * std::cos(z)),
                          row[(2 * w + 1) * n + i] = float(wave.amplitude_m * std::sin(z));
      }
    }
    for (int z = 0; z < n; ++z) {
      float* const to = fields.data() + 8 * std::size_t(n) * std::size_t(z);
      std::fill_n(to, 8 * n, 0.0f);
      for (std::size_t w = 0; w < count; ++w) {
        const glm::vec2 k(source.drawn(source.waves()[w])), u = k / glm::length(k);
        const float* c = &column[(2 * w) * n];
        const float *s = c + n, rc = row[(2 * w) * n + z], rs = row[(2 * w + 1) * n + z];
        for (int x = 0; x < n; ++x) {
          const float cosine = c[x] * rc - s[x] * rs, sine = c[x] * rs + s[x] * rc;
          to[x] -= u.x * sine, to[n + x] += cosine, to[2 * n + x] -= u.y * sine, to[3 * n + x] -= u.x * k.y * cosine;
          to[4 * n + x] -= k.x * sine, to[5 * n + x] -= k.y * sine, to[6 * n + x] -= u.x * k.x * cosine,
              to[7 * n + x] -= u.y * k.y * cosine;
        }
      }
    }
    benchmark::DoNotOptimize(fields.data());
    benchmark::ClobberMemory();
  }
  state.counters["waves"] = double(count);
}
BENCHMARK(gerstner_direct)->Arg(1)->Arg(4)->Arg(8)->Arg(24)->Arg(48)->Unit(benchmark::kMicrosecond)->UseRealTime();

// A recorded loop's tile between two frames; texels a side, threads.
void baked_tile(benchmark::State& state) {
  const int n = int(state.range(0));
  BakedLoop loop{n, 16, 4.0, 100.0, {}};
  loop.texels.resize(16 * loop.frame_floats());
  for (std::size_t i = 0; i < loop.texels.size(); ++i)
    loop.texels[i] = float(std::sin(0.3 * double(i % std::size_t(n))));
  const Baked source(std::move(loop), {});
  test::SourceTile tile(source, 0);
  std::int64_t ticks = 0;
  tbb::task_arena arena(int(state.range(1)));
  for (auto _ : state) arena.execute([&] { tile.evaluate(source, ticks += 11650); });
  state.counters["bytes"] = double(source.bytes());
}
BENCHMARK(baked_tile)->ArgsProduct({{64, 128, 256}, {1, 2}})->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace
}  // namespace seascape
