// What answers of a Sea's views cost in the shipped scenes, tiles ready, beside the open sea's: 1 to 10,000 points on
// one thread and on two.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <random>
#include <string>
#include <vector>

#include "app/scene.h"
#include "app/sea_spec.h"
#include "ocean/sea/sea.h"

namespace seascape {
namespace {

struct Spot {
  const char* scene;
  glm::dvec2 middle_m;  // of the points
  double half_m;        // side of their square, halved
};
constexpr Spot spots[] = {{"open_sea", {0.0, 0.0}, 50.0},
                          {"lagoon", {-30.0, -180.0}, 50.0},
                          {"rivers", {0.0, -130.0}, 50.0},
                          {"rain_pool", {0.0, 0.0}, 4.0},
                          {"whirlpool", {0.0, -60.0}, 50.0}};

// Arguments: which spot, how many points, how many threads, which detail.
void sea_query(benchmark::State& state) {
  const Spot& spot = spots[std::size_t(state.range(0))];
  const auto detail = SeaDetail(state.range(3));
  const Scene scene = load_scene(spot.scene, "high");
  SeaSpec spec = sea_spec(scene);
  spec.drawn_velocity = spec.felt_velocity = true;
  Sea sea(std::move(spec));
  const glm::dvec3 eye = scene.start.position_m;
  for (int step = 0; step <= 60; ++step) sea.advance(step / 60.0, eye);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> within(-spot.half_m, spot.half_m);
  std::vector<glm::dvec2> places;
  for (std::int64_t i = 0; i < state.range(1); ++i) {
    const double x = within(random);
    places.push_back(spot.middle_m + glm::dvec2(x, within(random)));
  }
  std::vector<QueryAnswer> answers(places.size());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(state.range(2)));
  const SeaView view = sea.view_at(1.0, detail);
  view.query(places, answers);
  for (auto _ : state) view.query(places, answers);
  double steps = 0.0, converged = 0.0;
  for (const QueryAnswer& answer : answers) steps += answer.iterations, converged += answer.converged;
  state.counters["time/point"] = benchmark::Counter(double(state.iterations()) * double(places.size()),
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["steps"] = steps / double(places.size());
  state.counters["converged"] = converged / double(places.size());
  state.SetLabel(std::string(spot.scene) + (detail == SeaDetail::felt ? " felt" : " drawn"));
}
BENCHMARK(sea_query)
    ->ArgsProduct({{0, 1, 2, 3, 4},
                   {1, 100, 1000, 10000},
                   {1, 2},
                   {std::int64_t(SeaDetail::drawn), std::int64_t(SeaDetail::felt)}})
    ->UseRealTime();

}  // namespace
}  // namespace seascape
