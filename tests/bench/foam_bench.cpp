// What a step of the foam costs without the waves that it is made of, and these, by windows and by what feeds it: what
// counts are the minima. One thread.
#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <time.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "ocean/bodies/wake_foam.h"
#include "ocean/foam/foam_pattern.h"
#include "ocean/foam/foam_sea.h"
#include "ocean/waves/gerstner.h"
#include "tests/support/body_waves.h"
#include "tests/support/own_sea.h"

namespace seascape {
namespace {

// What a step has to do beside the open sea.
enum Place { open_sea, whirlpool, beach };  // carried in circles; along the shore of a bed, with waves of its own

// Resolution, slices, and the place.
void foam_step(benchmark::State& state) {
  FoamSpec spec;
  spec.settings.simulated = true;
  spec.settings.settle_s = 0.0;
  spec.settings.windows.resolution = int(state.range(0));
  spec.settings.windows.slices = int(state.range(1));
  InputSpec vortex;
  vortex.to = InputTarget::flow;
  vortex.shape =
      VortexInput{.at_m = {0.0, -60.0}, .core_m = 12.0, .reach_m = 120.0, .swirl_mps = 6.0, .inflow_mps = 0.6};
  if (state.range(2) == whirlpool) spec.flow = std::make_shared<const Inputs>(InputTarget::flow, std::span(&vortex, 1));
  SeaState sea;
  sea.wind_speed_mps = 15.0;
  TileSources sources;
  std::shared_ptr<const ShoreLines> shore;
  PlaceInputs places;
  if (state.range(2) == beach) {
    sea.wind_speed_mps = 7.5;
    GerstnerSettings waves;
    waves.set1 = {.height_m = 0.5, .wavelength_m = 15.0, .spread_deg = 18.0, .octaves = 1, .shore = true};
    auto tile = std::make_shared<const Gerstner>(waves, 9.81, 1e6, 0.0, true);
    InputSpec line;
    line.to = InputTarget::gerstner;
    line.feather_m = 20.0;
    SplineInput curve;
    for (const double x : {-400.0, 0.0, 400.0})
      curve.points.push_back({{x, 0.0}, 130.0, glm::vec4(1.0f, 0.0f, 0.0f, 0.0f)});
    line.shape = curve;
    shore = std::make_shared<const ShoreLines>(std::span(&line, 1), tile->side_m());
    sources = {tile};
    places = test::places_of({test::beach({0.0, 0.0}, {0.0, 1.0})});
  }
  test::OwnFoam foam(spec, sea, WaveQuality{}, sources, shore, places);
  double step = 1e30, waves = 1e30, time_s = 100.0;
  tbb::task_arena one(1);
  one.execute([&] {
    // The processor's time.
    const auto take = [](double& least_ms, const auto& work) {
      const auto now_ms = [] {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
      };
      const double before = now_ms();
      work();
      least_ms = std::min(least_ms, now_ms() - before);
    };
    // The first step has no foam to carry and none to keep.
    for (int i = 0; i < 12; ++i) foam.update(time_s += 1.0 / spec.settings.rate_hz, {0.0, 2.0, 0.0});
    for (auto _ : state) {
      time_s += 1.0 / spec.settings.rate_hz;
      // The crests are made once for whoever asks for them.
      SeaView crests;
      take(waves, [&] {
        crests = foam.own->view(ticks_from_seconds(time_s), SeaDetail::crests);
        benchmark::DoNotOptimize(&crests.tiles());
      });
      take(step, [&] { benchmark::DoNotOptimize(foam.update(time_s, {0.0, 2.0, 0.0})); });
    }
  });
  state.counters["step_ms"] = step;
  state.counters["of_waves_ms"] = waves;
  state.counters["ns_a_texel"] = 1e6 * step / double(state.range(0) * state.range(0) * state.range(1));
}
BENCHMARK(foam_step)
    ->ArgNames({"n", "slices", "place"})
    ->Args({64, 4, open_sea})
    ->Args({128, 4, open_sea})
    ->Args({128, 4, whirlpool})
    ->Args({128, 4, beach})
    ->Args({256, 2, open_sea})
    ->Args({256, 4, open_sea})
    ->Args({256, 6, open_sea})
    ->Args({256, 4, whirlpool})
    ->Args({256, 4, beach})
    ->Iterations(24)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// Boats in circles around the viewer, with the foam that each makes.
class Fleet : public SeaActor {
 public:
  explicit Fleet(int boats) : wake_(test::wigley_hull(6.0, 2.0, 0.6, 0.5, 12, 5), 12), cut_(12) {
    for (int i = 0; i < boats; ++i) foam_.emplace_back(0.1 * (i % 10));
  }
  void step(SeaStep& step) override {
    for (std::size_t i = 0; i < foam_.size(); ++i) {
      const double ring = 15.0 + 0.6 * double(i), angle = 4.0 * step.time_s / ring + 2.4 * double(i);
      HullMotion motion;
      motion.pose.centre_m = {ring * std::cos(angle), 0.0, ring * std::sin(angle)};
      motion.pose.to_world = test::about({0.0, 1.0, 0.0}, -angle - std::numbers::pi);
      motion.velocity.linear = -4.0 * motion.pose.to_world[2];
      wake_.cut(
          motion, [](const glm::dvec2&) { return 0.0; }, cut_);
      made_.clear();
      foam_[i].step(step.dt_s, motion, cut_, 0.5, {}, test::g, test::rho, made_);
      for (const FoamDisc& disc : made_.foam) left_out += step.foam(disc) ? 0 : 1;
    }
  }
  int left_out = 0;

 private:
  HullWake wake_;
  std::vector<HullSection> cut_;
  std::vector<WakeFoam> foam_;
  WakeFoam::Made made_;
};

// Foam of the sea and of so many boats, 256 texels a side and 4 slices: what a step takes, and what making it does.
void foam_boats(benchmark::State& state) {
  FoamSpec spec;
  spec.settings.settle_s = 0.0;
  SeaState calm;
  calm.wind_speed_mps = 5.0;
  SeaSpec sea_spec = test::spec_of(calm, WaveQuality{});
  sea_spec.actors_foam = true;
  Sea sea(sea_spec);
  FoamSea foam(spec, sea);
  const auto fleet = std::make_shared<Fleet>(int(state.range(0)));
  sea.add(fleet);
  double step = 1e30, made = 1e30, time_s = 100.0;
  tbb::task_arena one(1);
  one.execute([&] {
    const auto take = [](double& least_ms, const auto& work) {
      const auto now_ms = [] {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
      };
      const double before = now_ms();
      work();
      least_ms = std::min(least_ms, now_ms() - before);
    };
    const glm::dvec3 viewer(0.0, 2.0, 0.0);
    for (int i = 0; i < 240; ++i) {
      sea.advance(time_s += 1.0 / spec.settings.rate_hz, viewer);
      foam.update(time_s, viewer);
    }
    for (auto _ : state) {
      time_s += 1.0 / spec.settings.rate_hz;
      take(made, [&] { sea.advance(time_s, viewer); });
      benchmark::DoNotOptimize(&sea.view(ticks_from_seconds(time_s), SeaDetail::crests).tiles());
      take(step, [&] { benchmark::DoNotOptimize(foam.update(time_s, viewer)); });
    }
  });
  state.counters["step_ms"] = step;
  state.counters["made_ms"] = made;
  state.counters["left_out"] = fleet->left_out;
}
BENCHMARK(foam_boats)->Arg(0)->Arg(1)->Arg(10)->Arg(100)->Iterations(24)->Unit(benchmark::kMillisecond)->UseRealTime();

void foam_lace(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(foam_pattern(int(state.range(0))));
}
BENCHMARK(foam_lace)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace seascape
