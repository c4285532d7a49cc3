#include "app/calibrate.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "app/effect_costs.h"
#include "app/loading_range.h"
#include "app/quality.h"
#include "app/statistics.h"

namespace seascape {

namespace {

constexpr double all_s = 2.0, preset_s = 0.5;  // of frames
constexpr double smaller = 0.5;                // of a side
constexpr const char* measured_scene = "storm";

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Frames in turn at the display's size and at half of each side.
FrameCost measured(Device& device, ShaderLibrary& shaders, std::size_t preset, const DisplayGoal& goal, double for_s) {
  Scene scene = load_scene(measured_scene, preset_names()[preset]);
  suit_device(scene.settings, preset_names()[preset], device_class(device.facts()));
  const bool per_eye = draw_per_eye(device, shaders, scene.settings.render.stereo, goal.views);
  CostSubject subject(device, shaders, scene, {goal.width, goal.height, goal.views, per_eye, false});
  const bool overlaps = device.facts().timestamps && !device.facts().software;
  std::array<std::vector<double>, 2> ms;
  std::array<double, 2> megapixels{};
  const double until_s = seconds() + for_s;
  for (int n = 2; seconds() < until_s || ms[0].empty(); ++n) {
    for (const std::size_t size : {std::size_t{1}, std::size_t{0}}) {  // the larger first
      const auto side = [&](std::uint32_t pixels) {
        return std::max(std::uint32_t(std::lround((size == 0 ? smaller : 1.0) * pixels)), 1u);
      };
      subject.experience().resize(side(goal.width), side(goal.height), {goal.width, goal.height});
      megapixels[size] = 1e-6 * side(goal.width) * side(goal.height) * goal.views;
      const double whole_ms = subject.draw_ms(n);
      const Frame& frame = subject.experience().frame();
      // Where the GPU works beside the processor a frame takes the longer of both.
      const double gpu_ms = frame.gpu_ms();
      ms[size].push_back(overlaps ? std::max(gpu_ms, whole_ms - gpu_ms) : whole_ms);
    }
  }
  return cost_through(megapixels[0], summarise(ms[0]).median, megapixels[1], summarise(ms[1]).median);
}

}  // namespace

CalibratedDevice calibrated_device(const DeviceFacts& facts) { return {facts.name, facts.driver}; }

std::string calibrated_preset(Device& device, ShaderLibrary& shaders, const DisplayGoal& goal) {
  const DiskCache cache = DiskCache::of_user();
  const CalibratedDevice name = calibrated_device(device.facts());
  const auto names = preset_names();
  const std::string_view of_class = resolve_preset("auto", device_class(device.facts()));
  const std::size_t first = preset_index(of_class);
  if (!std::filesystem::exists(content_directory() / "scenes" / (std::string(measured_scene) + ".json")))
    return std::string(of_class);  // content of somebody's own
  const double ratio = scene_ratio(shipped_preset_costs(), measured_scene, goal.scene, first);
  const FrameGoal wanted{1e-6 * goal.width * goal.height * goal.views, 1000.0 / (goal.rate_hz * ratio)};
  Calibration known = remembered(cache, name);
  AutoStep step = auto_step(known, first, wanted);
  if (step.measure) spdlog::info("auto: measuring what this device can draw, once");
  double left_s = all_s;
  for (; step.measure && left_s > 0.0; step = auto_step(known, first, wanted)) {
    known.presets[step.preset] = measured(device, shaders, step.preset, goal, std::min(preset_s, left_s));
    left_s -= preset_s;
  }
  if (left_s < all_s) remember(cache, name, known);
  const std::size_t preset = step.measure ? auto_choice(known, wanted) : step.preset;
  spdlog::info("auto: {} for {}x{}, {}, at {:g} Hz ({})", names[preset], goal.width, goal.height,
               goal.views == 1 ? "one picture" : "both eyes", goal.rate_hz, calibration_text(known));
  return std::string(names[preset]);
}

Calibration calibrated_anew(Device& device, ShaderLibrary& shaders, const DisplayGoal& goal) {
  Calibration known;
  for (std::size_t p = 0; p < known.presets.size(); ++p)
    known.presets[p] = measured(device, shaders, p, goal, preset_s);
  remember(DiskCache::of_user(), calibrated_device(device.facts()), known);
  return known;
}

}  // namespace seascape
