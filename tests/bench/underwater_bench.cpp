// What eyes in the water cost against eyes on deck, in one run: frames of one scene from 1.7 m above the surface, from
// the surface and from 3 m below it, at the same place and heading, in turn. And what the dive light costs, on and off,
// against shaders that were never told of it. Times are the GPU's, of the passes in which the sea, things and the light
// of all pixels are made. Where others use the machine the least of many frames is the steadiest: ratios are of it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "app/frame.h"
#include "app/program.h"
#include "app/quality.h"
#include "app/settings.h"
#include "platform/headless.h"
#include "tests/bench/gpu.h"

namespace seascape::bench {
namespace {

constexpr double rate_hz = 72.0;
constexpr int warm_up = 4, rounds = 16;

// How frames are drawn: as suits the device, or as a headset's GPU draws them, samples and all, where each pixel is lit
// with its triangle; and how wide pictures are (four to three).
struct Kind {
  bool forward = false;
  std::uint32_t width = 240;
  std::uint32_t height() const { return width * 3 / 4; }
  std::string name() const { return (forward ? "/forward" : "") + (width == 240 ? "" : "/" + std::to_string(width)); }
  HeadlessOptions display() const { return {.width = width, .height = height(), .views = 1, .vertical_fov_deg = 80.0}; }
  ExperienceOptions picture() const { return {.width = width, .height = height(), .views = 1}; }
};

// Water deep enough for eyes 3 m down, and where they look.
struct Place {
  const char* scene;
  glm::dvec2 at_m;
  double yaw_deg;
};
constexpr std::array places{Place{"open_sea", {0.0, 0.0}, 20.0},     Place{"storm", {0.0, 0.0}, 0.0},
                            Place{"lagoon", {-30.0, -100.0}, 66.0},  Place{"harbour", {2.0, -2.0}, 340.0},
                            Place{"wreck", {8.0, 16.0}, 330.0},      Place{"waterline", {0.9, 0.4}, 0.0},
                            Place{"diving_bell", {6.5, 6.5}, 315.0}, Place{"porthole", {0.2, 0.5}, 0.0}};

// Of one kind of frame: the least that each part took.
struct Least {
  double surface_ms = 1e9, light_ms = 1e9, below_ms = 1e9, near_ms = 1e9, drawing_ms = 1e9, frame_ms = 1e9;
  double triangles = 0.0, patches = 0.0;
};

void take_least(double& least, double ms) { least = std::min(least, ms); }

// Draws one frame and, with `into`, keeps what it took.
void draw(Experience& experience, const Headless& display, const Pose& from, double time_s, Least* into) {
  Frame& frame = experience.frame();
  frame.begin();
  draw_frame(experience, frame, display.viewpoint(from), time_s);
  frame.submit();
  frame.finish();
  if (into == nullptr) return;
  const auto took = [&](std::initializer_list<std::string_view> names) {
    double ms = 0.0;
    for (const PassTime& pass : frame.times())
      if (std::find(names.begin(), names.end(), pass.name) != names.end()) ms += pass.ms;
    return ms;
  };
  take_least(into->surface_ms, took({"surface"}));
  take_least(into->light_ms, took({"light"}));
  take_least(into->below_ms, took({"below", "above"}));
  take_least(into->near_ms, took({"near corners", "near lines"}));
  take_least(into->drawing_ms, took({"surface", "light", "below", "above", "near corners", "near lines"}));
  into->triangles = double(frame.counts().triangles);
  if (experience.lens() != nullptr) into->patches = double(experience.lens()->patches());
  take_least(into->frame_ms, frame.gpu_ms());
}

Scene scene_of(const Place& place, const std::string& preset, Kind kind) {
  Scene scene = load_scene(place.scene, preset);
  if (kind.forward)
    set_from_text(scene.settings, "frame.lighting", "forward", "bench");
  else
    suit_device(scene.settings, preset, device_class(gpu().device.facts()));
  return scene;
}

// `over_m`: of the eyes over the surface that is felt there.
Pose eyes_at(Experience& experience, const Place& place, double over_m, double time_s) {
  const glm::dvec3 camera(place.at_m.x, 0.0, place.at_m.y);
  experience.sea()->advance(time_s, camera);
  const double water_m = experience.sea()->view_at(time_s, SeaDetail::felt).query(place.at_m).height_m;
  return {{camera.x, water_m + over_m, camera.z},
          glm::angleAxis(glm::radians(-place.yaw_deg), glm::dvec3(0.0, 1.0, 0.0))};
}

void wet_eyes(benchmark::State& state, const Place& place, const std::string& preset, Kind kind) {
  Scene scene = scene_of(place, preset, kind);
  Experience experience(gpu().device, gpu().shaders, scene, kind.picture());
  // In a scene with portals no sea is drawn from deck: there the same sea without them is what one compares with.
  const bool portals = !scene.shapes.portals.empty();
  Scene open = scene;
  if (portals) open.shapes = {};
  Experience without(gpu().device, gpu().shaders, open, kind.picture());
  // And the same room from the same place on dry land, which has no sea to compare with.
  Scene on_land = open;
  on_land.effects = {"models"};
  Experience dry(gpu().device, gpu().shaders, portals ? on_land : open, kind.picture());
  Least least_dry;
  const Headless display(kind.display());
  constexpr std::array<const char*, 3> names{"deck", "half", "under"};
  constexpr std::array over_m{1.7, 0.0, -3.0};
  std::array<Least, 3> least;
  int number = 0, half_either = 0, under_either = 0, deck_either = 0;
  for (auto _ : state)
    for (int round = 0; round < warm_up + rounds; ++round)
      for (int n = 0; n < 3; ++n) {
        const int which = round % 2 == 0 ? n : 2 - n;  // whatever drifts, drifts for all alike
        if (portals && which == 1) continue;           // eyes in the sea are in no dry place
        Experience& of = which == 0 && portals ? without : experience;
        const double time_s = 20.0 + double(number++) / rate_hz;
        Pose from = eyes_at(of, place, over_m[std::size_t(which)], time_s);
        if (portals && which == 2) from = scene.start;
        draw(of, display, from, time_s, round < warm_up ? nullptr : &least[std::size_t(which)]);
        if (portals && which == 2) draw(dry, display, from, time_s, round < warm_up ? nullptr : &least_dry);
        const double reach_m = 0.2;
        const bool either = of.ocean().eyes_in(display.viewpoint(from), reach_m).eyes == EyesIn::either;
        (which == 0 ? deck_either : which == 1 ? half_either : under_either) += either;
      }
  for (std::size_t n = 0; n < 3; ++n) {
    if (portals && n == 1) continue;
    const std::string name(names[n]);
    state.counters[name + "_surface_ms"] = least[n].surface_ms;
    state.counters[name + "_light_ms"] = least[n].light_ms;
    state.counters[name + "_below_ms"] = least[n].below_ms;
    state.counters[name + "_near_ms"] = least[n].near_ms;
    state.counters[name + "_frame_ms"] = least[n].frame_ms;
    state.counters[name + "_triangles"] = least[n].triangles;
    if (n == 1) state.counters["half_patches"] = least[n].patches;
    if (n > 0) state.counters[name + "_to_deck"] = least[n].drawing_ms / least[0].drawing_ms;
    if (n > 0) state.counters[name + "_frame_to_deck"] = least[n].frame_ms / least[0].frame_ms;
  }
  if (portals) state.counters["under_to_dry"] = least[2].drawing_ms / least_dry.drawing_ms;
  const double all = warm_up + rounds;
  state.counters["deck_near"] = deck_either / all;
  state.counters["half_near"] = half_either / all;
  state.counters["under_near"] = under_either / all;
}

// The shaders as they would be had the dive light never been built: the constant that says so has another name in
// them, and keeps its default.
std::filesystem::path shaders_without_lamp() {
  const std::filesystem::path to = std::filesystem::temp_directory_path() / "seascape_bench_without_lamp";
  std::filesystem::create_directories(to);
  constexpr std::uint32_t op_decorate = 71, spec_id = 1, header_words = 5;
  for (const auto& entry : std::filesystem::directory_iterator(ShaderLibrary::default_directory())) {
    if (entry.path().extension() != ".spv") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), 4 * words.size());
    for (std::size_t at = header_words; at < words.size() && (words[at] >> 16) > 0; at += words[at] >> 16)
      if ((words[at] & 0xffff) == op_decorate && words[at + 2] == spec_id && words[at + 3] == gpu::value_lamp)
        words[at + 3] = 10000;
    std::ofstream(to / entry.path().filename(), std::ios::binary)
        .write(reinterpret_cast<const char*>(words.data()), std::streamsize(4 * words.size()));
  }
  return to;
}

void dive_light(benchmark::State& state, const Place& place, const std::string& preset, Kind kind) {
  Scene scene = scene_of(place, preset, kind);
  scene.settings.dive_light.on = false;
  ShaderLibrary without(shaders_without_lamp());
  Experience never(gpu().device, without, scene, kind.picture()),
      has(gpu().device, gpu().shaders, scene, kind.picture());
  Scene lit = scene;
  lit.settings.dive_light.on = true;
  Experience shines(gpu().device, gpu().shaders, lit, kind.picture());
  const Headless display(kind.display());
  const std::array<Experience*, 3> all{&never, &has, &shines};
  constexpr std::array<const char*, 3> names{"never_built", "off", "on"};
  std::array<Least, 3> least;
  for (auto _ : state)
    for (int round = 0; round < warm_up + rounds; ++round)
      for (int n = 0; n < 3; ++n) {
        const auto which = std::size_t(round % 2 == 0 ? n : 2 - n);
        const double time_s = 20.0 + double(round) / rate_hz;
        draw(*all[which], display, eyes_at(*all[which], place, -3.0, time_s), time_s,
             round < warm_up ? nullptr : &least[which]);
      }
  for (std::size_t n = 0; n < 3; ++n) state.counters[std::string(names[n]) + "_ms"] = least[n].drawing_ms;
  state.counters["off_to_never_built"] = least[1].drawing_ms / least[0].drawing_ms;
  state.counters["on_to_off"] = least[2].drawing_ms / least[1].drawing_ms;
}

[[maybe_unused]] const bool registered = [] {
  for (const Kind kind : {Kind{}, Kind{.forward = true}, Kind{.width = 960}})
    for (const Place& place : places)
      for (const std::string preset : {"low", "medium", "high", "ultra"}) {
        const std::string name = std::string(place.scene) + "/" + preset + kind.name();
        benchmark::RegisterBenchmark(("wet_eyes/" + name).c_str(),
                                     [=](benchmark::State& state) { wet_eyes(state, place, preset, kind); })
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
        if (std::string_view(place.scene) == "porthole") continue;
        benchmark::RegisterBenchmark(("dive_light/" + name).c_str(),
                                     [=](benchmark::State& state) { dive_light(state, place, preset, kind); })
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
      }
  return true;
}();

}  // namespace
}  // namespace seascape::bench
