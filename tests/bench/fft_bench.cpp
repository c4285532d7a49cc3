// Our transforms beside FFTW's, one after the other within the same loop, so that a slow moment of the machine slows
// both: what counts is the ratio of their medians.
#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "tests/bench/rivals.h"

namespace seascape::bench {
namespace {

// The largest difference of the two, relative to the largest value: a fast transform of something else is no yardstick.
double disagreement(OurTransform& ours, FftwTransform& theirs, const Spectrum& spectrum) {
  ours.run(spectrum);
  theirs.fill(spectrum);
  theirs.run();
  double difference = 0.0, largest = 0.0;
  for (int z = 0; z < ours.n; ++z)
    for (int x = 0; x < ours.n; ++x) {
      const std::size_t a = std::size_t(z) * std::size_t(ours.stride) + std::size_t(x),
                        b = std::size_t(z) * std::size_t(ours.n) + std::size_t(x);
      const double re = theirs.result()[b][0], im = theirs.result()[b][1];
      difference = std::max(difference, std::hypot(ours.re[a] - re, ours.im[a] - im));
      largest = std::max(largest, std::hypot(re, im));
    }
  return difference / largest;
}

// Four complex fields of n x n samples from a band: ours on one thread and over two, FFTW's in place and out of place
// on one thread and, by the faster of these, over two. Ratios are to the faster FFTW.
void four_fields(benchmark::State& state) {
  const int n = int(state.range(0)), band = int(state.range(1));
  std::vector<Spectrum> spectra;
  std::vector<OurTransform> ours;
  std::vector<FftwTransform> in_place, out_of_place;
  for (int i = 0; i < fields; ++i) {
    spectra.emplace_back(band, unsigned(i + 1));
    ours.emplace_back(n, band);
    in_place.emplace_back(n, Layout::in_place);
    out_of_place.emplace_back(n, Layout::out_of_place);
  }
  double difference = 0.0;
  for (int i = 0; i < fields; ++i) {
    const auto at = std::size_t(i);
    difference = std::max({difference, disagreement(ours[at], in_place[at], spectra[at]),
                           disagreement(ours[at], out_of_place[at], spectra[at])});
  }
  tbb::task_arena two(2);
  const auto share = [&](auto work) {
    two.execute([&] { tbb::parallel_for(0, fields, work, tbb::simple_partitioner()); });
  };
  Times ours_1, ours_2, in_1, out_1, in_2, out_2;
  for (auto _ : state) {
    ours_1.take([&] {
      for (std::size_t i = 0; i < fields; ++i) ours[i].run(spectra[i]);
    });
    out_1.take([&] {
      for (FftwTransform& transform : out_of_place) transform.run();
    });
    // In place a transform eats its input; sums of sums would overflow after a few.
    for (std::size_t i = 0; i < fields; ++i) in_place[i].fill(spectra[i]);
    in_1.take([&] {
      for (FftwTransform& transform : in_place) transform.run();
    });
    ours_2.take([&] { share([&](int i) { ours[std::size_t(i)].run(spectra[std::size_t(i)]); }); });
    out_2.take([&] { share([&](int i) { out_of_place[std::size_t(i)].run(); }); });
    for (std::size_t i = 0; i < fields; ++i) in_place[i].fill(spectra[i]);
    in_2.take([&] { share([&](int i) { in_place[std::size_t(i)].run(); }); });
  }
  if (!(difference < 1e-5)) state.SkipWithError("differs from FFTW");
  Times& best_1 = in_1.median() < out_1.median() ? in_1 : out_1;
  Times& best_2 = in_2.median() < out_2.median() ? in_2 : out_2;
  state.counters["ours_us"] = ours_1.median();
  state.counters["fftw_us"] = best_1.median();
  state.counters["ours_min"] = ours_1.least();
  state.counters["fftw_min"] = best_1.least();
  state.counters["ratio"] = ours_1.median() / best_1.median();
  state.counters["ratio_min"] = ours_1.least() / best_1.least();
  state.counters["ours2_us"] = ours_2.median();
  state.counters["ratio2"] = ours_2.median() / best_1.median();
  state.counters["ratio2_min"] = ours_2.least() / best_1.least();
  state.counters["ratio2_fftw2"] = ours_2.median() / best_2.median();
  state.counters["difference"] = difference;
}
BENCHMARK(four_fields)
    ->ArgNames({"n", "band"})
    ->Args({16, 16})
    ->Args({32, 32})
    ->Args({64, 64})
    ->Args({128, 128})
    ->Args({256, 256})
    ->Args({512, 512})
    ->Args({1024, 1024})
    ->Args({128, 64})
    ->Args({256, 64})
    ->Args({512, 64})
    ->Args({512, 256})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

}  // namespace
}  // namespace seascape::bench
