// What the selection of patches costs, by preset and by how high the viewer stands; how it grows with the size of the
// ocean, the levels and the views.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <numeric>
#include <string>

#include "app/camera_path.h"
#include "app/quality.h"
#include "ocean/mesh/quadtree.h"
#include "ocean/mesh/water_below.h"

namespace seascape {
namespace {

// A fresh breeze, as a preset draws it, at one time.
struct Sea {
  explicit Sea(std::string_view preset) : field(state(), quality(preset)) {
    field.evaluate(ticks_from_seconds(12.0), tiles);
  }
  static SeaState state() {
    SeaState sea;
    sea.wind_speed_mps = 9.5;
    sea.fetch_m = 160e3;
    sea.swell_height_m = 0.6;
    return sea;
  }
  static WaveQuality quality(std::string_view preset) {
    Settings settings;
    apply_preset(settings, preset);
    return settings.waves;
  }
  WaveField field;
  WaveTiles tiles;
};

const Sea& sea_of(std::string_view preset) {
  static std::map<std::string, Sea, std::less<>> seas;
  const auto known = seas.find(preset);
  return known != seas.end() ? known->second : seas.try_emplace(std::string(preset), preset).first->second;
}

// Viewpoints on a way and what an ocean would tell of its water there, made beforehand so that only selecting is timed:
// `eyes` side by side, 1280 x 720 each, 60 degrees.
struct Step {
  Viewpoint viewpoint;
  DisplacementBounds bounds;
};
std::vector<Step> on_a_way(const Sea& sea, double height_m, int eyes) {
  std::vector<Step> way(256);
  double along = 0.0;
  for (auto& [viewpoint, bounds] : way) {
    along += 3.7;  // a viewer on the move: a selection is never the last one
    viewpoint.viewer.position_m = {along, height_m, -2.0 * along};
    viewpoint.viewer.orientation = orientation_from_angles({0.5 * along, -5.0, 0.0});
    for (int e = 0; e < eyes; ++e) {
      Pose pose = viewpoint.viewer;
      pose.position_m += pose.orientation * glm::dvec3(0.064 * (e - 0.5 * (eyes - 1)), 0.0, 0.0);
      viewpoint.eyes.push_back({pose, symmetric_fov(60.0, 1280.0 / 720.0)});
    }
    viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, 720.0);
    const SeaStatistics& s = sea.field.statistics();
    bounds = {s.largest_height_m, s.largest_shift_m, s.mesh_error,
              water_below(sea.field, sea.tiles, viewpoint.viewer.position_m, s.near_motion)};
  }
  return way;
}

// Selects along the way, an iteration once along it. A patch of the result is what the issue calls a selected node.
// `by_water`: near patches are culled by the water that stands there too. "ns/patch" is of the quietest rounds: of each
// of 32 parts of the way the least of all iterations.
void select_along(benchmark::State& state, const LodSettings& settings, std::string_view preset, double height_m,
                  int eyes, bool by_water = false) {
  Quadtree tree(settings);
  const Sea& sea = sea_of(preset);
  const std::vector<Step> way = on_a_way(sea, height_m, eyes);
  constexpr std::size_t parts = 32;
  std::array<double, parts> least_s;
  least_s.fill(1e9);
  std::int64_t visited = 0, patches = 0;
  for (auto _ : state)
    for (std::size_t part = 0; part < parts; ++part) {
      const auto from = std::chrono::steady_clock::now();
      for (std::size_t at = part * way.size() / parts; at < (part + 1) * way.size() / parts; ++at) {
        const SurfaceSelection& selection =
            tree.select(way[at].viewpoint,
                        MeshWater(way[at].bounds, by_water ? &sea.field : nullptr, by_water ? &sea.tiles : nullptr));
        benchmark::DoNotOptimize(selection.patches.data());
        visited += selection.visited_nodes;
        patches += std::int64_t(selection.patches.size());
      }
      least_s[part] =
          std::min(least_s[part], std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count());
    }
  const double steps = double(way.size()), selections = steps * double(state.iterations());
  const double least = std::accumulate(least_s.begin(), least_s.end(), 0.0);
  state.counters["us/selection"] = 1e6 * least / steps;
  state.counters["ns/patch"] = 1e9 * least * double(state.iterations()) / double(patches);
  state.counters["patches"] = double(patches) / selections;
  state.counters["visited"] = double(visited) / selections;
}

LodSettings of_preset(std::int64_t preset) {
  Settings settings;
  apply_preset(settings, preset_names()[std::size_t(preset)]);
  return settings.lod;
}

std::string_view name_of(const benchmark::State& state) { return preset_names()[std::size_t(state.range(0))]; }

// Arguments: the preset's number, the viewer's height in metres. Two eyes.
void select_patches(benchmark::State& state) {
  select_along(state, of_preset(state.range(0)), name_of(state), double(state.range(1)), 2);
  state.SetLabel(std::string(name_of(state)));
}
BENCHMARK(select_patches)->ArgsProduct({{0, 1, 2, 3}, {2, 200}})->Unit(benchmark::kMicrosecond);

// The same with the culling by the water that stands there, which software drivers gain from.
void select_by_water(benchmark::State& state) {
  select_along(state, of_preset(state.range(0)), name_of(state), double(state.range(1)), 2, true);
  state.SetLabel(std::string(name_of(state)));
}
BENCHMARK(select_by_water)->ArgsProduct({{0, 1, 2, 3}, {2, 200}})->Unit(benchmark::kMicrosecond);

// By the threshold instead of pixels.
void select_by_threshold(benchmark::State& state) {
  LodSettings settings = of_preset(state.range(0));
  settings.by = LodLaw::threshold;
  select_along(state, settings, name_of(state), double(state.range(1)), 2);
  state.SetLabel(std::string(name_of(state)));
}
BENCHMARK(select_by_threshold)->ArgsProduct({{0, 1, 2, 3}, {2}})->Unit(benchmark::kMicrosecond);

// How it grows: with the ocean's size in metres, with the depth of the tree, with the number of eyes. At high, from 2
// m.
void select_by_size(benchmark::State& state) {
  LodSettings settings = of_preset(2);
  settings.ocean_size_m = double(state.range(0));
  select_along(state, settings, "high", 2.0, 2);
}
BENCHMARK(select_by_size)->ArgName("size_m")->RangeMultiplier(2)->Range(256, 8192)->Unit(benchmark::kMicrosecond);

void select_by_levels(benchmark::State& state) {
  LodSettings settings = of_preset(2);
  settings.levels = int(state.range(0));
  select_along(state, settings, "high", 2.0, 2);
}
BENCHMARK(select_by_levels)->ArgName("levels")->DenseRange(2, 12, 2)->Unit(benchmark::kMicrosecond);

void select_by_views(benchmark::State& state) { select_along(state, of_preset(2), "high", 2.0, int(state.range(0))); }
BENCHMARK(select_by_views)
    ->ArgName("views")
    ->Arg(0)
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Arg(8)
    ->Arg(12)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace seascape
