// What the selection of patches costs, by preset and by how high the viewer stands; how it grows with the size of the ocean, the levels and the views.
#include <benchmark/benchmark.h>

#include "app/camera_path.h"
#include "app/quality.h"
#include "ocean/lod/quadtree.h"

namespace seascape {
namespace {

// Viewpoints on a way, made beforehand so that only selecting is timed: `eyes` side by side, 1280 x 720 each, 60 degrees.
std::vector<Viewpoint> on_a_way(double height_m, int eyes) {
  std::vector<Viewpoint> way(256);
  double along = 0.0;
  for (Viewpoint& viewpoint : way) {
    along += 3.7;  // a viewer on the move: a selection is never the last one
    viewpoint.viewer.position_m = {along, height_m, -2.0 * along};
    viewpoint.viewer.orientation = orientation_from_angles({0.5 * along, -5.0, 0.0});
    for (int e = 0; e < eyes; ++e) {
      Pose pose = viewpoint.viewer;
      pose.position_m += pose.orientation * glm::dvec3(0.064 * (e - 0.5 * (eyes - 1)), 0.0, 0.0);
      viewpoint.eyes.push_back({pose, symmetric_fov(60.0, 1280.0 / 720.0)});
    }
  }
  return way;
}

// Selects along the way. A patch of the result is what the issue calls a selected node.
void select_along(benchmark::State& state, const LodSettings& settings, double height_m, int eyes) {
  Quadtree tree(settings);
  const std::vector<Viewpoint> way = on_a_way(height_m, eyes);
  std::int64_t visited = 0, patches = 0;
  std::size_t at = 0;
  for (auto _ : state) {
    const SurfaceSelection& selection = tree.select(way[at++ % way.size()], {3.0, 2.0});
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

// Arguments: the preset's number, the viewer's height in metres. Two eyes.
void select_patches(benchmark::State& state) {
  select_along(state, of_preset(state.range(0)), double(state.range(1)), 2);
  state.SetLabel(std::string(preset_names()[std::size_t(state.range(0))]));
}
BENCHMARK(select_patches)->ArgsProduct({{0, 1, 2, 3}, {2, 200}})->Unit(benchmark::kMicrosecond);

// How it grows: with the ocean's size in metres, with the depth of the tree, with the number of eyes. At high, from 2 m.
void select_by_size(benchmark::State& state) {
  LodSettings settings = of_preset(2);
  settings.ocean_size_m = double(state.range(0));
  select_along(state, settings, 2.0, 2);
}
BENCHMARK(select_by_size)->ArgName("size_m")->RangeMultiplier(2)->Range(256, 8192)->Unit(benchmark::kMicrosecond);

void select_by_levels(benchmark::State& state) {
  LodSettings settings = of_preset(2);
  settings.levels = int(state.range(0));
  select_along(state, settings, 2.0, 2);
}
BENCHMARK(select_by_levels)->ArgName("levels")->DenseRange(2, 12, 2)->Unit(benchmark::kMicrosecond);

void select_by_views(benchmark::State& state) { select_along(state, of_preset(2), 2.0, int(state.range(0))); }
BENCHMARK(select_by_views)->ArgName("views")->Arg(0)->Arg(1)->Arg(2)->Arg(4)->Arg(8)->Arg(12)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace seascape
