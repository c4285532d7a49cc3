// What bodies cost a step at each level, 1 to 1,000 of them, and how far the cheap levels' heights are off the hull's
// on the same waves. The water is of a formula, so that only the bodies' own work counts.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "ocean/bodies/hull_wake.h"
#include "tests/support/body_waves.h"

namespace seascape {
namespace {

test::FormulaWater swell() {
  test::FormulaWater water;
  water.waves = {{0.5, 40.0, {0.6, 0.8}}, {0.15, 12.0, {0.0, 1.0}, 1.0}};
  return water;
}

std::vector<BodySpec> fleet(std::size_t count, BodyLevel level) {
  BodySpec spec = test::even_body(test::wigley_hull(6.0, 2.0, 0.6, 0.5, 10, 5), 0.4 * test::rho);
  spec.drag = HullDrag{};
  spec.level = level;
  const double m = spec.mass.mass_kg;
  spec.mass.added = Matrix6::diagonal({0.05 * m, m, m, 0.5 * m, 0.5 * m, 0.2 * m});
  spec.damping = Matrix6::diagonal({0.0, 2.0 * m, 0.0, m, m, m});
  std::vector<BodySpec> specs(count, spec);
  for (std::size_t n = 0; n < count; ++n) specs[n].at_m = {10.0 * double(n % 32), 0.0, 10.0 * double(n / 32)};
  return specs;
}

// The water's answers once, for all: asking is the sea's cost, not the bodies'.
struct OneAnswer : test::FormulaWater {
  // None of them sleeps.
  std::optional<CalmWater> calm(double, const glm::dvec2&, double) const override { return std::nullopt; }
  void ask(double t, double, std::span<const glm::dvec2> places, std::span<WaterHere> answers) const override {
    for (std::size_t n = 0; n < places.size(); ++n) {
      answers[n] = {};
      answers[n].height_m = 0.3 * (places[n].x * 0.01 - std::floor(places[n].x * 0.01)) + 0.01 * t;
    }
  }
};

void step(benchmark::State& state) {
  Bodies bodies({}, fleet(std::size_t(state.range(1)), BodyLevel(state.range(0))));
  const OneAnswer water;
  int n = 0;
  for (auto _ : state) {
    ++n;
    bodies.step(n / 60.0, 1.0 / 60.0, water);
  }
  state.counters["time/body"] = benchmark::Counter(double(state.iterations()) * double(state.range(1)),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.SetLabel(std::array{"hull", "probes", "follow"}[std::size_t(state.range(0))]);
}
BENCHMARK(step)
    ->Name("bodies/step")
    ->ArgsProduct({{0, 1, 2}, {1, 10, 100, 1000}})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

// Hulls under way whose bottoms lift them, beside the same that do not.
void planing(benchmark::State& state) {
  std::vector<BodySpec> specs = fleet(100, BodyLevel::hull);
  for (BodySpec& spec : specs) spec.planes = state.range(0) != 0, spec.velocity_mps.z = -5.0;
  Bodies bodies({}, specs);
  const OneAnswer water;
  int n = 0;
  for (auto _ : state) {
    ++n;
    bodies.step(n / 60.0, 1.0 / 60.0, water);
  }
  state.SetLabel(state.range(0) != 0 ? "planing" : "without");
}
BENCHMARK(planing)->Name("bodies/planing")->DenseRange(0, 1)->Unit(benchmark::kMicrosecond)->UseRealTime();

// The sources of hulls of so many sections, on waves of a formula, each hull of 300 triangles.
void wakes(benchmark::State& state) {
  const HullWake wake(test::wigley_hull(6.0, 2.0, 0.6, 0.5, 12, 5), int(state.range(0)));
  HullMotion motion;
  motion.velocity = {{0.3, 0.1, -4.0}, {0.1, 0.05, 0.0}};
  std::vector<HullSection> cut(std::size_t(wake.sections()));
  std::vector<WaveSource> sources;
  for (auto _ : state) {
    sources.clear();
    for (int i = 0; i < int(state.range(1)); ++i) {
      motion.pose.centre_m.x = 10.0 * i;
      wake.cut(
          motion, [](const glm::dvec2& at) { return 0.1 * (at.x * 0.1 - std::floor(at.x * 0.1)); }, cut);
      wake.add_sources(motion, cut, 1.0, sources);
    }
    benchmark::DoNotOptimize(sources.data());
  }
  state.counters["sources"] = double(sources.size());
  state.counters["time/hull"] = benchmark::Counter(double(state.iterations()) * double(state.range(1)),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(wakes)
    ->Name("bodies/wakes")
    ->ArgNames({"sections", "hulls"})
    ->ArgsProduct({{12, 20}, {1, 10, 100, 1000}})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

// One hull by its triangles.
void triangles(benchmark::State& state) {
  std::vector<BodySpec> specs = fleet(1, BodyLevel::hull);
  specs[0].hull =
      std::make_shared<HullMesh>(test::wigley_hull(6.0, 2.0, 0.6, 0.5, int(state.range(0)), int(state.range(0)) / 2));
  Bodies bodies({}, specs);
  const OneAnswer water;
  int n = 0;
  for (auto _ : state) {
    ++n;
    bodies.step(n / 60.0, 1.0 / 60.0, water);
  }
  state.counters["triangles"] = double(specs[0].hull->triangles.size());
}
BENCHMARK(triangles)->Name("bodies/triangles")->RangeMultiplier(2)->Range(5, 80)->Unit(benchmark::kMicrosecond);

// A raft of boxes, each of which touches its neighbours, and the same apart from each other: what contacts cost.
void contacts(benchmark::State& state) {
  const bool touch = state.range(1) != 0;
  BodySpec spec = test::even_body(box_hull({1.0, 1.0, 1.0}), 0.5 * test::rho);
  const double m = spec.mass.mass_kg;
  spec.level = BodyLevel::probes;
  spec.drag = HullDrag{};
  spec.damping = Matrix6::diagonal({m, m, m, m, m, m});
  std::vector<BodySpec> specs(std::size_t(state.range(0)), spec);
  for (std::size_t n = 0; n < specs.size(); ++n)
    specs[n].at_m = (touch ? 0.999 : 3.0) * glm::dvec3(double(n % 32), 0.0, double(n / 32));
  struct Awake : test::FormulaWater {
    std::optional<CalmWater> calm(double, const glm::dvec2&, double) const override { return std::nullopt; }
  } water;
  Bodies bodies({}, specs, ContactSettings{}), alone({}, specs);
  int n = 0;
  double with_s = 0.0, without_s = 0.0;
  const auto timed = [&](Bodies& of) {
    const auto start = std::chrono::steady_clock::now();
    of.step(n / 60.0, 1.0 / 60.0, water);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (auto _ : state) {
    ++n;
    with_s += timed(bodies), without_s += timed(alone);
  }
  state.counters["us_for_contacts"] = 1e6 * (with_s - without_s) / double(n);
  state.SetLabel(touch ? "touching" : "apart");
}
BENCHMARK(contacts)->Name("bodies/contacts")->ArgsProduct({{10, 100, 1000}, {0, 1}})->Unit(benchmark::kMicrosecond);

void sleepers(benchmark::State& state) {
  Bodies bodies({}, fleet(1000, BodyLevel::hull));
  const test::FormulaWater water;
  for (int n = 0; n < 60 * 60; ++n) bodies.step(n / 60.0, 1.0 / 60.0, water);
  for (auto _ : state) bodies.step(61.0, 1.0 / 60.0, water);
  int asleep = 0;
  for (const BodyState& body : bodies.result()) asleep += body.asleep;
  state.counters["asleep"] = asleep;
}
BENCHMARK(sleepers)->Name("bodies/1000 asleep")->Unit(benchmark::kMicrosecond)->UseRealTime();

// The greatest and the mean square of how far a level's height is off the hull's, relative to the water at each, m.
void error(benchmark::State& state) {
  const test::FormulaWater water = swell();
  double most = 0.0, squares = 0.0;
  int count = 0;
  for (auto _ : state) {
    std::vector<BodySpec> specs = fleet(2, BodyLevel::hull);
    specs[1].at_m = specs[0].at_m;
    specs[1].level = BodyLevel(state.range(0));
    Bodies bodies({}, specs);
    for (int n = 0; n < 60 * 40; ++n) {
      const double t = (n + 1) / 60.0;
      bodies.step(t, 1.0 / 60.0, water);
      if (n < 60 * 10) continue;
      const auto over = [&](std::size_t body) {
        const glm::dvec3 at = bodies.result()[body].motion.centre_m;
        return at.y - water.height(t, {at.x, at.z});
      };
      const double off = over(1) - over(0);
      most = std::max(most, std::abs(off)), squares += off * off, ++count;
    }
  }
  state.counters["most_m"] = most;
  state.counters["rms_m"] = std::sqrt(squares / count);
  state.SetLabel(std::array{"hull", "probes", "follow"}[std::size_t(state.range(0))]);
}
BENCHMARK(error)->Name("bodies/error")->DenseRange(1, 2)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace seascape
