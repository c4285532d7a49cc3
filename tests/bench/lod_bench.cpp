// What the selection of patches costs, by preset and by how high the viewer stands; how it grows with the size of the ocean, the levels and the views.
#include <benchmark/benchmark.h>

#include "app/camera_path.h"
#include "app/quality.h"
#include "ocean/lod/water_below.h"
#include "ocean/lod/quadtree.h"

namespace seascape {
namespace {

// A fresh breeze, as a preset draws it, at one time.
struct Sea {
  explicit Sea(std::string_view preset) : field(state(), quality(preset)) { field.evaluate(ticks_from_seconds(12.0), tiles); }
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

// Viewpoints on a way and what an ocean would tell of its water there, made beforehand so that only selecting is timed: `eyes`
// side by side, 1280 x 720 each, 60 degrees.
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
    bounds = {s.largest_height_m, s.largest_shift_m, s.mesh_error, water_below(sea.field, sea.tiles, viewpoint.viewer.position_m, s.near_motion)};
  }
  return way;
}

// Selects along the way. A patch of the result is what the issue calls a selected node. `by_water`: near patches are culled by the water that
// stands there too.
void select_along(benchmark::State& state, const LodSettings& settings, std::string_view preset, double height_m, int eyes, bool by_water = false) {
  Quadtree tree(settings);
  const Sea sea(preset);
  const std::vector<Step> way = on_a_way(sea, height_m, eyes);
  std::int64_t visited = 0, patches = 0;
  std::size_t at = 0;
  for (auto _ : state) {
    const Step& step = way[at++ % way.size()];
    const SurfaceSelection& selection = tree.select(step.viewpoint, step.bounds, by_water ? &sea.field : nullptr, by_water ? &sea.tiles : nullptr);
    benchmark::DoNotOptimize(selection.patches.data());
    visited += selection.visited_nodes;
    patches += std::int64_t(selection.patches.size());
  }
  state.SetItemsProcessed(patches);
  const auto each = [](std::int64_t count) { return benchmark::Counter(double(count), benchmark::Counter::kIsRate | benchmark::Counter::kInvert); };
  state.counters["time/patch"] = each(patches);
  state.counters["time/visited"] = each(visited);
  state.counters["patches"] = benchmark::Counter(double(patches), benchmark::Counter::kAvgIterations);
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
BENCHMARK(select_by_water)->ArgsProduct({{0, 1, 2, 3}, {2}})->Unit(benchmark::kMicrosecond);

// By the threshold instead of pixels.
void select_by_threshold(benchmark::State& state) {
  LodSettings settings = of_preset(state.range(0));
  settings.pixel_error = 0.0;
  select_along(state, settings, name_of(state), double(state.range(1)), 2);
  state.SetLabel(std::string(name_of(state)));
}
BENCHMARK(select_by_threshold)->ArgsProduct({{0, 1, 2, 3}, {2}})->Unit(benchmark::kMicrosecond);

// How it grows: with the ocean's size in metres, with the depth of the tree, with the number of eyes. At high, from 2 m.
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
BENCHMARK(select_by_views)->ArgName("views")->Arg(0)->Arg(1)->Arg(2)->Arg(4)->Arg(8)->Arg(12)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace seascape
