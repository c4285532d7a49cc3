// A whole cascade of the wave field beside its transforms alone and one of FFTW's, in turn within the same loop.
#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "ocean/waves/wave_particles.h"
#include "ocean/waves/wave_tiles_simd.h"
#include "tests/bench/rivals.h"

namespace seascape::bench {
namespace {

// Waves of no sea in particular: what is done with them does not depend on their values.
WaveTable random_waves(int band) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  WaveTable table;
  for (int i = 0; i < band * band; ++i) {
    for (std::vector<float>* column : {&table.amplitude_re, &table.amplitude_im, &table.kx, &table.kz, &table.shift_x,
                                       &table.shift_z, &table.frequency})
      column->push_back(uniform(random));
    table.turns.push_back(random() >> 16);
  }
  return table;
}

// Spectrum, displacement, derivatives, Jacobian (from the derivatives) and second moments of one cascade, over two
// threads.
struct WholeCascade {
  WholeCascade(int n, int band)
      : plan(make_fft_plan(n, band)), table(random_waves(band)), workspace(workspace_floats(plan, {})) {
    for (int level = 0; level <= strip_levels; ++level) {
      const int size = n >> level, stride = size + 4;
      levels[level].stride = stride;
      for (int plane = 0; plane < 3; ++plane) {
        texels.emplace_back(std::size_t(stride) * std::size_t(size));
        levels[level].texels[plane] = texels.back().data();
      }
    }
  }
  void run(std::int64_t ticks, bool mips) {
    const int pairs = row_pairs(plan), piece = 16;
    tbb::parallel_for(0, (pairs + piece - 1) / piece, [&](int i) {
      waves_along_x(table, plan, ticks, {}, i * piece, std::min((i + 1) * piece, pairs), workspace.data());
    });
    tbb::parallel_for(0, plan.n / strip_width, [&](int i) {
      strip_along_z(table, plan, workspace.data(), {}, i * strip_width, levels[0]);
      if (mips) strip_mips(plan, i * strip_width, levels);
    });
  }
  FftPlan plan;
  WaveTable table;
  Floats workspace;
  std::vector<std::vector<glm::vec4, tbb::cache_aligned_allocator<glm::vec4>>> texels;
  PlaneLevel levels[strip_levels + 1]{};
};

// The bars: whole / transforms <= 1.6 and whole / FFTW <= 6, on two threads.
void whole_cascade(benchmark::State& state) {
  const int n = int(state.range(0)), band = int(state.range(1));
  WholeCascade cascade(n, band);
  std::vector<Spectrum> spectra;
  std::vector<OurTransform> transforms;
  for (unsigned i = 0; i < fields; ++i) {
    spectra.emplace_back(band, i);
    transforms.emplace_back(n, band);
  }
  FftwTransform fftw(n, Layout::out_of_place);
  fftw.fill(Spectrum(n, 1));
  tbb::task_arena two(2);
  Times whole, with_mips, alone, one, whole_1, alone_1;
  std::int64_t ticks = 0;
  for (auto _ : state) {
    alone.take([&] {
      two.execute([&] {
        tbb::parallel_for(
            0, fields, [&](int i) { transforms[std::size_t(i)].run(spectra[std::size_t(i)]); },
            tbb::simple_partitioner());
      });
    });
    whole.take([&] { two.execute([&] { cascade.run(ticks += 11650, false); }); });
    with_mips.take([&] { two.execute([&] { cascade.run(ticks += 11650, true); }); });
    one.take([&] { fftw.run(); });
    alone_1.take([&] {
      for (std::size_t i = 0; i < fields; ++i) transforms[i].run(spectra[i]);
    });
    tbb::task_arena(1).execute([&] { whole_1.take([&] { cascade.run(ticks += 11650, false); }); });
  }
  state.counters["alone_us"] = alone.median();
  state.counters["whole_us"] = whole.median();
  state.counters["mips_us"] = with_mips.median();
  state.counters["fftw_us"] = one.median();
  state.counters["to_alone"] = whole.median() / alone.median();
  state.counters["to_fftw"] = whole.median() / one.median();
  state.counters["to_alone_min"] = whole.least() / alone.least();
  state.counters["to_fftw_min"] = whole.least() / one.least();
  state.counters["mips_to_alone_min"] = with_mips.least() / alone.least();
  state.counters["alone_1thread_min"] = alone_1.least();
  state.counters["whole_1thread_min"] = whole_1.least();
  state.counters["to_alone_1thread"] = whole_1.median() / alone_1.median();
}
BENCHMARK(whole_cascade)
    ->ArgNames({"n", "band"})
    ->Args({512, 64})
    ->Args({512, 256})
    ->Args({256, 64})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

// The tile of wave particles, 256^2 with its whole mip chain, beside a cascade of 64 bins into 256^2 with four levels
// of it, on two threads. The bar: of 10,000 particles it costs less (to_cascade below 1).
void wave_particles(benchmark::State& state) {
  WaveParticleSettings settings;
  settings.count = int(state.range(0));
  const WaveParticles source(settings);
  Floats workspace(source.workspace_floats(false));
  std::vector<std::vector<glm::vec4, tbb::cache_aligned_allocator<glm::vec4>>> texels;
  std::vector<PlaneLevel> levels;
  for (int size = WaveParticles::tile_samples; size >= 1; size /= 2) {
    PlaneLevel level{};
    level.stride = size >= 32 ? size + 4 : size;
    for (int plane = 0; plane < 3; ++plane) {
      texels.emplace_back(std::size_t(level.stride) * std::size_t(size));
      level.texels[plane] = texels.back().data();
    }
    levels.push_back(level);
  }
  WholeCascade cascade(256, 64);
  tbb::task_arena two(2);
  Times particles, with_mips, without, particles_1, with_mips_1;
  std::int64_t ticks = 0;
  for (auto _ : state) {
    particles.take([&] { two.execute([&] { source.evaluate(ticks += 11650, false, levels, workspace); }); });
    with_mips.take([&] { two.execute([&] { cascade.run(ticks += 11650, true); }); });
    without.take([&] { two.execute([&] { cascade.run(ticks += 11650, false); }); });
    tbb::task_arena(1).execute(
        [&] { particles_1.take([&] { source.evaluate(ticks += 11650, false, levels, workspace); }); });
    tbb::task_arena(1).execute([&] { with_mips_1.take([&] { cascade.run(ticks += 11650, true); }); });
  }
  state.counters["us"] = particles.median();
  state.counters["us_min"] = particles.least();
  state.counters["cascade_min"] = with_mips.least();
  state.counters["bare_min"] = without.least();
  state.counters["to_cascade"] = particles.median() / with_mips.median();
  state.counters["to_cascade_min"] = particles.least() / with_mips.least();
  state.counters["us_1thread_min"] = particles_1.least();
  state.counters["to_cascade_1thread"] = particles_1.median() / with_mips_1.median();
}
BENCHMARK(wave_particles)
    ->ArgName("count")
    ->Arg(800)
    ->Arg(2048)
    ->Arg(2049)
    ->Arg(10000)
    ->Arg(30000)
    ->Arg(100000)
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

}  // namespace
}  // namespace seascape::bench
