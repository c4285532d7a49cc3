// What answers to queries cost: single calls beside batches on one thread and on all cores, and time against error for
// each number of steps, by fixed point and by Newton.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "app/quality.h"
#include "ocean/sea/query.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

constexpr std::size_t asked = 4096;

enum Order { hulls, scattered };  // 64 hulls of 20 m by 5 m, 64 points each; or points over a square kilometre

struct Sea {
  explicit Sea(std::int64_t preset, std::int64_t order = scattered, double time_s = 10.0)
      : name(preset_names()[std::size_t(preset)]) {
    Settings settings;
    apply_preset(settings, name);
    field.emplace(settings.sea, settings.waves);
    field->evaluate(ticks_from_seconds(time_s), tiles);
    std::mt19937 random(2);
    const auto within = [&](double half) { return std::uniform_real_distribution<double>(-half, half)(random); };
    glm::dvec2 hull(0.0);
    for (std::size_t i = 0; i < asked; ++i) {
      if (i % 64 == 0) hull = {within(500.0), within(500.0)};
      places.push_back(order == hulls ? hull + glm::dvec2(within(2.5), within(10.0))
                                      : glm::dvec2(within(500.0), within(500.0)));
    }
    name += order == hulls ? " hulls" : " scattered";
  }
  std::string name;
  std::optional<WaveField> field;
  WaveTiles tiles{true};
  std::vector<glm::dvec2> places;
  std::vector<QueryAnswer> answers{asked};
};

void count(benchmark::State& state, const Sea& sea) {
  std::int64_t steps = 0, converged = 0;
  for (const QueryAnswer& answer : sea.answers) {
    steps += answer.iterations;
    converged += answer.converged;
  }
  state.counters["time/point"] = benchmark::Counter(double(state.iterations()) * double(asked),
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["steps"] = double(steps) / double(asked);
  state.counters["converged"] = double(converged) / double(asked);
  state.SetLabel(sea.name);
}

void query_single(benchmark::State& state) {
  Sea sea(state.range(0), state.range(1));
  for (auto _ : state)
    for (std::size_t i = 0; i < asked; ++i) query(*sea.field, sea.tiles, {&sea.places[i], 1}, {&sea.answers[i], 1});
  count(state, sea);
}
BENCHMARK(query_single)->ArgsProduct({{0, 1, 2, 3}, {hulls, scattered}})->Unit(benchmark::kMillisecond)->UseRealTime();

void query_batch(benchmark::State& state, bool one_thread, QueryOptions options) {
  std::optional<tbb::global_control> limit;
  if (one_thread) limit.emplace(tbb::global_control::max_allowed_parallelism, 1);
  Sea sea(state.range(0), state.range(1));
  for (auto _ : state) query(*sea.field, sea.tiles, sea.places, sea.answers, options);
  count(state, sea);
}
BENCHMARK_CAPTURE(query_batch, one_thread, true, {})
    ->ArgsProduct({{0, 1, 2, 3}, {hulls, scattered}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(query_batch, all_cores, false, {})
    ->ArgsProduct({{0, 1, 2, 3}, {hulls, scattered}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// From the answers of 1/90 s before.
void query_batch_from_previous(benchmark::State& state) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  Sea sea(state.range(0), state.range(1), 10.0 - 1.0 / 90.0);
  std::vector<QueryAnswer> before(asked);
  query(*sea.field, sea.tiles, sea.places, before);
  sea.field->evaluate(ticks_from_seconds(10.0), sea.tiles);
  for (auto _ : state) query(*sea.field, sea.tiles, sea.places, sea.answers, {.previous = before});
  count(state, sea);
}
BENCHMARK(query_batch_from_previous)
    ->ArgsProduct({{0, 1, 2, 3}, {hulls, scattered}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// The rest positions, by so many steps in double on the tiles' own field that nothing more changes.
std::vector<glm::dvec2> rests_of(const Sea& sea) {
  std::vector<glm::dvec2> rests = sea.places;
  const WaveField::Filter filter = sea.field->filter(0.0);
  for (std::size_t i = 0; i < asked; ++i)
    for (int step = 0; step < 200; ++step) {
      const glm::dvec3 d = sea.field->displacement(sea.tiles, rests[i], filter);
      rests[i] = sea.places[i] - glm::dvec2(d.x, d.z);
    }
  return rests;
}

// The share of Hs that heights miss by, root of mean square.
template <class Height>
double error_of(const Sea& sea, Height height) {
  const std::vector<glm::dvec2> rests = rests_of(sea);
  double sum = 0.0;
  for (std::size_t i = 0; i < asked; ++i) {
    const double miss = height(i) - sea.field->displacement(sea.tiles, rests[i], 0.0).y;
    sum += miss * miss;
  }
  return std::sqrt(sum / double(asked)) / (4.0 * std::sqrt(sea.field->statistics().height_variance));
}

// So many steps for every point. error: of height_m; error_plain: of the found point's own height, without the slope.
void query_steps(benchmark::State& state) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  Sea sea(state.range(0));
  for (auto _ : state)
    query(*sea.field, sea.tiles, sea.places, sea.answers, {.most_iterations = int(state.range(1)), .tolerance_m = 0.0});
  count(state, sea);
  state.counters["error"] = error_of(sea, [&](std::size_t i) { return sea.answers[i].height_m; });
  state.counters["error_plain"] = error_of(sea, [&](std::size_t i) { return sea.answers[i].displacement.y; });
}
BENCHMARK(query_steps)
    ->ArgsProduct({{0, 2}, benchmark::CreateDenseRange(0, 8, 1)})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// The same search in plain loops, a point after another, so that the two kinds of step compare.
template <bool Newton>
void plain_steps(benchmark::State& state) {
  Sea sea(state.range(0));
  const WaveField::Filter filter = sea.field->filter(0.0);
  std::vector<double> heights(asked);
  for (auto _ : state)
    for (std::size_t i = 0; i < asked; ++i) {
      glm::dvec2 rest = sea.places[i];
      for (int step = 0; step < state.range(1); ++step) {
        if constexpr (Newton) {
          const SeaSample at = sea.field->sea(sea.tiles, rest, filter);
          const glm::dvec2 miss = sea.places[i] - rest - glm::dvec2(at.displacement.x, at.displacement.z);
          const glm::dvec3 g = at.shift_gradient;
          const double j = at.jacobian();
          rest += glm::dvec2((1.0 + g.y) * miss.x - g.z * miss.y, (1.0 + g.x) * miss.y - g.z * miss.x) /
                  (j > 0.1 ? j : 1.0);
        } else {
          const glm::dvec3 d = sea.field->displacement(sea.tiles, rest, filter);
          rest = sea.places[i] - glm::dvec2(d.x, d.z);
        }
      }
      heights[i] = sea.field->displacement(sea.tiles, rest, filter).y;
    }
  count(state, sea);
  state.counters["error"] = error_of(sea, [&](std::size_t i) { return heights[i]; });
}
void plain_fixed_point(benchmark::State& state) { plain_steps<false>(state); }
void plain_newton(benchmark::State& state) { plain_steps<true>(state); }
BENCHMARK(plain_fixed_point)
    ->ArgsProduct({{2}, benchmark::CreateDenseRange(0, 8, 1)})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(plain_newton)
    ->ArgsProduct({{2}, benchmark::CreateDenseRange(0, 4, 1)})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace seascape
