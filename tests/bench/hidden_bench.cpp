// What leaving out the pixels that no eye sees is worth: frames of two eyes with a headset's mask and without, in turn.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "app/frame.h"
#include "app/program.h"
#include "platform/headless.h"

namespace seascape::bench {
namespace {

constexpr std::uint32_t width = 640, height = 400;
constexpr int rounds = 40;

// Outside the largest ellipse of the field.
HiddenMesh outside_of_ellipse(const Fov& fov) {
  HiddenMesh mesh;
  mesh.version = 1;
  constexpr int sides = 48;
  const auto at = [&](int side, double out) {
    const double about = glm::radians(360.0) * side / sides;
    return glm::vec2(
        glm::dvec2(0.5 * (fov.left + fov.right), 0.5 * (fov.up + fov.down)) +
        out * glm::dvec2(0.5 * (fov.right - fov.left) * std::cos(about), 0.5 * (fov.up - fov.down) * std::sin(about)));
  };
  for (auto& corners : mesh.corners)
    for (int side = 0; side < sides; ++side)
      for (const glm::vec2& corner :
           {at(side, 1.0), at(side, 2.0), at(side + 1, 1.0), at(side + 1, 1.0), at(side, 2.0), at(side + 1, 2.0)})
        corners.push_back(corner);
  return mesh;
}

void hidden(benchmark::State& state, const char* samples) {
  Device device{DeviceOptions{}};
  ShaderLibrary shaders;
  Scene scene = load_scene("open_sea", "medium");
  set_from_text(scene.settings, "msaa", samples, "bench");
  ExperienceOptions eyes{width, height, 2};
  Experience without(device, shaders, scene, eyes);
  eyes.hidden = true;
  Experience with(device, shaders, scene, eyes);
  const Viewpoint viewpoint = Headless({.width = width, .height = height, .views = 2}).viewpoint(scene.start);
  with.hide(outside_of_ellipse(viewpoint.eyes[0].fov));
  double least_ms[2] = {1e9, 1e9};
  for (auto _ : state)
    for (int round = 0; round < rounds; ++round)
      for (Experience* one : {&without, &with}) {
        Frame& frame = one->frame();
        frame.begin();
        draw_frame(*one, frame, viewpoint, 4.0 + round / 72.0);
        frame.submit();
        frame.finish();
        double& least = least_ms[one == &with];
        if (round > 3) least = std::min(least, frame.gpu_ms());
      }
  const Image8 picture = picture_of(device, with, 0);
  std::size_t black = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
    black += picture.pixels[i] + picture.pixels[i + 1] + picture.pixels[i + 2] == 0;
  state.counters["hidden_share"] = double(black) / (width * height);
  state.counters["without_min_ms"] = least_ms[0];
  state.counters["with_min_ms"] = least_ms[1];
  state.counters["ratio"] = least_ms[1] / least_ms[0];
}
BENCHMARK_CAPTURE(hidden, msaa_1, "1")->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hidden, msaa_4, "4")->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace seascape::bench
