// What the CPU's sea costs: the transform of a band beside FFTW's of the whole grid, a sea's tiles, and the answers to queries.
#include <benchmark/benchmark.h>
#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "app/quality.h"
#include "ocean/waves/fft.h"
#include "ocean/waves/query.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

// A band of random amplitudes, the same for both transforms.
struct Spectrum {
  explicit Spectrum(int band) : re(std::size_t(band) * std::size_t(band)), im(re.size()) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (float& value : re) value = uniform(random);
    for (float& value : im) value = uniform(random);
  }
  std::vector<float> re, im;
};

struct OurTransform {
  explicit OurTransform(int size) : plan(make_fft_plan(size)), n(size), stride(size + 16), re(std::size_t(n) * std::size_t(stride)), im(re.size()) {}
  void run(const Spectrum& spectrum) { inverse_fft(plan, spectrum.re.data(), spectrum.im.data(), re.data(), im.data(), stride); }
  FftPlan plan;
  int n, stride;
  std::vector<float> re, im;
};

// One thread, in place, every bin of the grid: what a general library is asked for a spectrum that is mostly zero.
struct FftwTransform {
  explicit FftwTransform(int size) : n(size), grid(fftwf_alloc_complex(std::size_t(n) * std::size_t(n)), &fftwf_free) {
    plan = fftwf_plan_dft_2d(n, n, grid.get(), grid.get(), FFTW_BACKWARD, FFTW_MEASURE);
  }
  ~FftwTransform() { fftwf_destroy_plan(plan); }
  FftwTransform(const FftwTransform&) = delete;
  FftwTransform& operator=(const FftwTransform&) = delete;
  void fill(const Spectrum& spectrum, int band) {
    std::fill_n(&grid.get()[0][0], std::size_t(n) * std::size_t(n) * 2, 0.0f);
    for (int z = 0; z < band; ++z)
      for (int x = 0; x < band; ++x) {
        const std::size_t to = std::size_t((z - band / 2 + n) % n) * std::size_t(n) + std::size_t((x - band / 2 + n) % n);
        const std::size_t from = std::size_t(z) * std::size_t(band) + std::size_t(x);
        grid.get()[to][0] = spectrum.re[from];
        grid.get()[to][1] = spectrum.im[from];
      }
  }
  int n;
  std::unique_ptr<fftwf_complex, decltype(&fftwf_free)> grid;
  fftwf_plan plan;
};

// The largest difference of the two, relative to the largest value: a fast transform of something else is no yardstick.
double disagreement(int n) {
  OurTransform ours(n);
  FftwTransform theirs(n);
  const Spectrum spectrum(ours.plan.band);
  ours.run(spectrum);
  theirs.fill(spectrum, ours.plan.band);
  fftwf_execute(theirs.plan);
  double difference = 0.0, largest = 0.0;
  for (int z = 0; z < n; ++z)
    for (int x = 0; x < n; ++x) {
      const std::size_t a = std::size_t(z) * std::size_t(ours.stride) + std::size_t(x), b = std::size_t(z) * std::size_t(n) + std::size_t(x);
      const double re = theirs.grid.get()[b][0], im = theirs.grid.get()[b][1];
      difference = std::max(difference, std::hypot(ours.re[a] - re, ours.im[a] - im));
      largest = std::max(largest, std::hypot(re, im));
    }
  return difference / largest;
}

void transform_ours(benchmark::State& state) {
  const int n = int(state.range(0));
  OurTransform transform(n);
  const Spectrum spectrum(transform.plan.band);
  for (auto _ : state) {
    transform.run(spectrum);
    benchmark::DoNotOptimize(transform.re.data());
    benchmark::ClobberMemory();
  }
  const double difference = disagreement(n);
  if (!(difference < 1e-5)) state.SkipWithError("differs from FFTW");
  state.counters["difference"] = difference;
}
BENCHMARK(transform_ours)->Arg(64)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMicrosecond);

// With the filling of its grid, which the band's transform does on its way.
void transform_fftw(benchmark::State& state) {
  const int n = int(state.range(0)), band = std::min(n, 64);
  FftwTransform transform(n);
  const Spectrum spectrum(band);
  for (auto _ : state) {
    transform.fill(spectrum, band);
    fftwf_execute(transform.plan);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(transform_fftw)->Arg(64)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMicrosecond);

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
