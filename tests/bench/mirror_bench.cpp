// What the mirror costs a headset's frames: without one, with an eye's picture, with both, and with the view from
// behind, in turn. Needs a desktop (DISPLAY); a virtual one will do.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "app/frame.h"
#include "app/mirror.h"
#include "platform/headless.h"

namespace seascape::bench {
namespace {

constexpr std::array views{MirrorView::off, MirrorView::left, MirrorView::both, MirrorView::third};
constexpr std::array names{"off", "left", "both", "third"};
constexpr int side = 480, rounds = 24, frames = 12;
constexpr double rate_hz = 72.0;

double thread_ms() {  // of this thread, which others on the machine do not lengthen
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void mirror(benchmark::State& state) {
  if (std::getenv("DISPLAY") == nullptr) return state.SkipWithError("there is no desktop");
  WindowSystem desktop;
  DeviceOptions options;
  options.present = true;
  options.instance_extensions = desktop.instance_extensions();
  Device device(options);
  ShaderLibrary shaders;
  Scene scene = load_scene("open_sea", "medium");
  scene.settings.render.msaa = 1;
  ExperienceOptions eyes{side, side, 2};
  eyes.seen_elsewhere = true;
  Experience experience(device, shaders, scene, eyes);
  PictureCopy copy(device);
  Mirror mirror(desktop, device, shaders, WindowOptions{});
  const Headless display({.width = side, .height = side, .views = 2});
  struct Times {
    std::vector<double> round_ms;         // a frame of the headset, from one to the next: the mean of each round
    std::vector<double> gpu_ms, keep_ms;  // its frames on the GPU, and the copies among them
    std::vector<double> mirror_gpu_ms;    // the mirror's own frames there
    double show_ms = 0.0;                 // of the processor, a picture of the mirror
    int shown = 0;
  };
  std::array<Times, views.size()> times;
  int number = 0;
  const auto frame = [&](std::size_t which) {
    MirrorSettings settings;
    settings.view = views[which];
    const double time_s = ++number / rate_hz;
    mirror.begin(time_s, settings);
    Frame& drawn = experience.frame();
    drawn.begin();
    Times& to = times[which];
    to.gpu_ms.push_back(drawn.gpu_ms());
    for (const PassTime& pass : drawn.times())
      if (std::string_view(pass.name) == "keep") to.keep_ms.push_back(pass.ms);
    draw_frame(experience, drawn, display.viewpoint(scene.start), time_s);
    if (mirror.wants_copy()) copy.record(drawn, experience.picture());
    drawn.submit();
    mirror.follow(scene.start, 1.0 / rate_hz);
    if (!mirror.due()) return;
    const PanelFacts facts;
    const double began_ms = thread_ms();
    mirror.show({copy, experience, time_s, scene.settings, facts, ""});
    to.show_ms += thread_ms() - began_ms;
    to.mirror_gpu_ms.push_back(mirror.gpu_ms());
    ++to.shown;
  };
  for (auto _ : state)
    for (int round = 0; round < rounds; ++round)
      for (std::size_t which = 0; which < views.size(); ++which) {
        while (views[which] == MirrorView::third && !mirror.third()) frame(which);
        for (int i = 0; i < 6; ++i) frame(which);  // the last view's pictures leave the GPU
        const double began_ms = now_ms();
        for (int i = 0; i < frames; ++i) frame(which);
        times[which].round_ms.push_back((now_ms() - began_ms) / frames);
      }
  const std::vector<double> rounds_off_ms = times[0].round_ms;
  for (std::size_t which = 0; which < views.size(); ++which) {
    Times& of = times[which];
    const auto count = [&](const char* what, double ms) {
      state.counters[std::string(names[which]) + "_" + what] = ms;
    };
    const auto least = [](const std::vector<double>& list) {
      return list.empty() ? 0.0 : *std::min_element(list.begin(), list.end());
    };
    const auto middle = [](std::vector<double>& list) {
      std::sort(list.begin(), list.end());
      return list.empty() ? 0.0 : list[list.size() / 2];
    };
    std::vector<double> to_off;  // round by round, for the machine's load changes
    for (std::size_t round = 0; round < of.round_ms.size(); ++round)
      to_off.push_back(of.round_ms[round] / rounds_off_ms[round]);
    count("frame_to_off", middle(to_off));
    count("frame_min_ms", least(of.round_ms));
    count("frame_p50_ms", middle(of.round_ms));
    count("gpu_p50_ms", middle(of.gpu_ms));
    count("keep_p50_ms", middle(of.keep_ms));
    count("mirror_gpu_p50_ms", middle(of.mirror_gpu_ms));
    count("show_mean_ms", of.shown > 0 ? of.show_ms / of.shown : 0.0);
    count("pictures", of.shown);
  }
}
BENCHMARK(mirror)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace seascape::bench
