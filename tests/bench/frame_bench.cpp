// What a frame costs the processor without the GPU, by scene and preset, on one thread and on two, with the waves made
// on the processor and on the GPU: the sea's steps, the water felt at the camera, foam, spray, culling, the selection
// of patches, and recording. The GPU is waited for between frames and does not count. A driver that is software works
// at rest meanwhile. On one thread its own time counts, which others on the machine do not lengthen.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "app/experience.h"
#include "app/frame.h"
#include "platform/headless.h"
#include "tests/bench/gpu.h"

namespace seascape::bench {
namespace {

constexpr const char* scenes[] = {"open_sea",  "calm",   "storm",  "swell",        "rain_pool", "gerstner",  "baked",
                                  "whirlpool", "lagoon", "rivers", "harbour_clip", "harbour",   "still_life"};
constexpr int warm_up = 20, frames = 90;
constexpr double rate_hz = 72.0, pixels_per_radian = 1100.0;

double now_ms(int threads) {
  timespec time{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

void cpu_frame(benchmark::State& state, const char* scene_name, const std::string& preset, WavePlace where,
               int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  Scene scene = load_scene(scene_name, preset);
  scene.settings.wave_place = where;
  std::vector<double> ms;
  for (auto _ : state) {
    Experience experience(gpu().device, gpu().shaders, scene, {.width = 96, .height = 54, .views = 2});
    Headless display({.width = 96, .height = 54, .views = 2});
    Frame& frame = experience.frame();
    for (int n = 0; n < warm_up + frames; ++n) {
      const double time_s = scene.settings.time_start_s + n / rate_hz;
      // Slowly ahead, so that windows move.
      Pose pose = scene.start;
      pose.position_m.z -= 2.0 * n / rate_hz;
      display.begin();
      frame.begin();
      Viewpoint seen = display.viewpoint(pose);
      seen.pixels_per_radian = pixels_per_radian;
      const double start_ms = now_ms(threads);
      benchmark::DoNotOptimize(water_at_camera(experience, pose.position_m, time_s));
      draw_frame(experience, frame, seen, time_s);
      if (n >= warm_up) ms.push_back(now_ms(threads) - start_ms);
      display.end(frame, &experience.picture());
      frame.finish();
    }
  }
  std::sort(ms.begin(), ms.end());
  double sum = 0.0;
  for (const double one : ms) sum += one;
  const auto at = [&](double share) { return ms[std::size_t(share * double(ms.size() - 1))]; };
  state.counters["mean_ms"] = sum / double(ms.size());
  state.counters["p50_ms"] = at(0.5);
  state.counters["p95_ms"] = at(0.95);
}

[[maybe_unused]] const bool registered = [] {
  for (const char* scene : scenes)
    for (const std::string preset : {"low", "medium", "high", "ultra"})
      for (const auto& [where, name] : {std::pair(WavePlace::cpu, "cpu"), std::pair(WavePlace::gpu, "gpu")})
        for (const int threads : {1, 2})
          benchmark::RegisterBenchmark(
              ("cpu_frame/" + std::string(scene) + "/" + preset + "/waves_on_" + name + "/" + std::to_string(threads))
                  .c_str(),
              [=](benchmark::State& state) { cpu_frame(state, scene, preset, where, threads); })
              ->Iterations(1)
              ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace seascape::bench
