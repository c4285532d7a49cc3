// What the selection of patches costs, by preset and by how high the viewer stands.
#include <benchmark/benchmark.h>

#include "app/camera_path.h"
#include "app/quality.h"
#include "ocean/lod/quadtree.h"

namespace seascape {
namespace {

// Arguments: the preset's number, the viewer's height in metres. Two eyes side by side at 1280 x 720 each.
void select_patches(benchmark::State& state) {
  const std::string_view preset = preset_names()[std::size_t(state.range(0))];
  Settings settings;
  apply_preset(settings, preset);
  Quadtree tree(settings.lod);
  const DisplacementBounds bounds{3.0, 2.0};
  const Fov fov = symmetric_fov(60.0, 1280.0 / 720.0);
  std::int64_t nodes = 0, patches = 0;
  double along = 0.0;
  for (auto _ : state) {
    along += 0.37;  // a viewer on the move: the selection is never the last one
    Viewpoint viewpoint;
    viewpoint.viewer.position_m = {along, double(state.range(1)), -2.0 * along};
    viewpoint.viewer.orientation = orientation_from_angles({0.5 * along, -5.0, 0.0});
    viewpoint.eyes = stereo_views(viewpoint.viewer, fov, 0.064);
    const SurfaceSelection& selection = tree.select(viewpoint, bounds);
    benchmark::DoNotOptimize(selection.patches.data());
    nodes += selection.visited_nodes;
    patches += std::int64_t(selection.patches.size());
  }
  state.SetLabel(std::string(preset));
  state.SetItemsProcessed(nodes);
  state.counters["time/node"] = benchmark::Counter(double(nodes), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["patches"] = benchmark::Counter(double(patches), benchmark::Counter::kAvgIterations);
}
BENCHMARK(select_patches)->ArgsProduct({{0, 1, 2, 3}, {2, 200}})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace seascape
