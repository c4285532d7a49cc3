// `seascape explore`: the sea in a window to fly, walk and ride over, or a few pictures of it without a display.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "app/calibrate.h"
#include "app/commands.h"
#include "app/explorer.h"
#include "app/frame.h"
#include "app/input_script_file.h"
#include "app/progress.h"
#include "app/sea_time.h"
#include "engine/error.h"
#include "engine/output_folder.h"
#include "platform/headless.h"
#include "platform/headset.h"
#include "platform/simulated_runtime.h"
#include "platform/window.h"

namespace seascape {

namespace {

bool has_value(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

bool has_desktop() { return has_value("DISPLAY") || has_value("WAYLAND_DISPLAY"); }

DisplayKind resolve_display(DisplayKind wanted) {
  if (wanted != DisplayKind::automatic) return wanted;
  return has_desktop() ? DisplayKind::window : DisplayKind::headless;
}

// What `auto` is before a display that has a rate to hold.
void suit_preset(const Arguments& arguments, Program& program, DisplayGoal goal) {
  goal.scene = program.scene.name;
  program.preset = calibrated_preset(*program.device, program.shaders, goal);
  program.scene = scene_from(arguments, program.preset, device_class(program.device->facts()));
}

// Pictures a second that a headset will show: as asked, or of those it offers the nearest to what most have.
double headset_rate_hz(const HeadsetSystem& system, const Device& device, const Settings& settings) {
  if (settings.adaptive.target_hz > 0.0) return settings.adaptive.target_hz;
  if (settings.headset.rate_hz > 0.0) return settings.headset.rate_hz;
  constexpr double usual_hz = 90.0;
  const std::vector<float> offered = headset_rates(system, device);
  const auto nearest = std::min_element(offered.begin(), offered.end(), [](float a, float b) {
    return std::abs(double(a) - usual_hz) < std::abs(double(b) - usual_hz);
  });
  return nearest == offered.end() ? usual_hz : double(*nearest);
}

// From where somebody was before, or from the scene's beginning.
void explore_in_window(const Arguments& arguments, const std::optional<LeftOff>& before = std::nullopt) {
  WindowSystem system;
  DeviceOptions options = device_options();
  options.present = true;
  options.instance_extensions = system.instance_extensions();
  Program program = make_program(arguments, options);
  if (before) {
    program.scene = before->scene;
    program.preset = before->preset;
  }
  {
    WindowOptions window_options;
    window_options.views = arguments.views;
    if (arguments.views == 2) window_options.width = 800;  // both side by side fit a desktop
    if (arguments.width) window_options.width = std::uint32_t(arguments.width);
    if (arguments.height) window_options.height = std::uint32_t(arguments.height);
    Window window(system, *program.device, window_options);
    const double target_hz = program.scene.settings.adaptive.target_hz;
    if (!before && arguments.preset == "auto")
      suit_preset(arguments, program,
                  {window.most_size().x, window.most_size().y, arguments.views,
                   target_hz > 0.0 ? target_hz : 1.0 / window.period_s()});
    Explorer explorer(arguments, program, window);
    if (before) explorer.go_on_from(*before);
    explorer.run();
  }
  expect_no_validation_messages(*program.device);
}

// The desktop that mirrors a headset, whose device then presents there too; nothing where none answers.
std::unique_ptr<WindowSystem> desktop_beside(DeviceOptions& options) {
  if (!has_desktop()) return nullptr;
  try {
    auto desktop = std::make_unique<WindowSystem>();
    options.instance_extensions = desktop->instance_extensions();
    options.present = true;
    return desktop;
  } catch (const Error& fault) {
    spdlog::warn("no mirror on the desktop: {}", fault.what());
    return nullptr;
  }
}

DisplayGoal headset_goal(const Arguments& arguments, const HeadsetSystem& system, const Program& program) {
  const Settings& settings = program.scene.settings;
  const auto pixels = [&](int asked, std::uint32_t recommended) {
    return asked > 0 ? std::uint32_t(asked) : scaled_pixels(recommended, settings.headset.scale);
  };
  return {pixels(arguments.width, system.facts().width), pixels(arguments.height, system.facts().height), 2,
          headset_rate_hz(system, *program.device, settings)};
}

HeadsetOptions headset_options(const Arguments& arguments, const Settings& settings, bool in_real_time) {
  HeadsetOptions headset;
  headset.near_m = settings.render.near_m;
  headset.in_real_time = in_real_time;
  headset.symmetric = settings.headset.symmetric;
  headset.scale = settings.headset.scale;
  headset.rate_hz = settings.headset.rate_hz;
  headset.left_handed = settings.headset.left_handed;
  headset.seated = settings.headset.seated;
  headset.eye_height_m = settings.headset.eye_height_m;
  headset.width = std::uint32_t(arguments.width);
  headset.height = std::uint32_t(arguments.height);
  return headset;
}

// `system` outlives what is made for it. Where its runtime dies and a desktop is there to go on at: where the user was.
std::optional<LeftOff> explore_with(HeadsetSystem& system, const Arguments& arguments, bool mirrored,
                                    bool in_real_time) {
  DeviceOptions options = device_options();
  const std::unique_ptr<WindowSystem> desktop = mirrored ? desktop_beside(options) : nullptr;
  system.make_device(options);
  Program program = make_program(arguments, options);
  std::optional<LeftOff> left_off;
  {
    if (in_real_time && arguments.preset == "auto")  // before the display: a runtime has one session at a time
      suit_preset(arguments, program, headset_goal(arguments, system, program));
    Headset display(system, *program.device, headset_options(arguments, program.scene.settings, in_real_time));
    Explorer explorer(arguments, program, display, desktop.get());
    try {
      explorer.run();
    } catch (const HeadsetLost& fault) {
      if (!has_desktop()) throw;
      spdlog::warn("the headset is lost: {}; going on in a window", fault.fault());
      left_off = explorer.left_off();
    }
  }
  expect_no_validation_messages(*program.device);
  return left_off;
}

void explore_in_headset(const Arguments& arguments) {
  std::optional<LeftOff> left_off;
  {
    const XrLoader loader;
    HeadsetSystem system(loader.get());
    left_off = explore_with(system, arguments, true, true);
  }
  if (left_off) explore_in_window(arguments, left_off);
}

void explore_simulated(const Arguments& arguments) {
  SimulatedOptions options;
  if (!arguments.input.empty()) options.script = load_input_script(arguments.input);
  options.ends = arguments.frames == 0;
  options.out = arguments.out;
  options.every = arguments.every;
  const OutputFolder held(arguments.out);
  SimulatedRuntime runtime(options);
  HeadsetSystem system(runtime.get(), runtime.next());
  // A script plays alone, unless somebody asks to see it.
  const bool watched = std::any_of(arguments.overrides.begin(), arguments.overrides.end(),
                                   [](const Override& one) { return one.key == "mirror.view"; });
  explore_with(system, arguments, watched, false);
}

// Draws as many frames as asked for, one by default, and keeps the last as pictures.
void explore_headless(const Arguments& arguments) {
  Program program = make_program(arguments, device_options());
  const OutputFolder held(arguments.out);
  const Settings& settings = program.scene.settings;
  HeadlessOptions options;
  if (arguments.width) options.width = std::uint32_t(arguments.width);
  if (arguments.height) options.height = std::uint32_t(arguments.height);
  options.views = arguments.views;
  options.vertical_fov_deg = settings.render.vertical_fov_deg;
  options.eye_distance_m = settings.render.eye_distance_m;
  Headless display(options);
  const bool per_eye = draw_per_eye(*program.device, program.shaders, settings.render.stereo, options.views);
  Experience experience(*program.device, program.shaders, program.scene,
                        {options.width, options.height, options.views, per_eye, false});
  Frame& frame = experience.frame();
  const int frames = std::max(1, arguments.frames);
  Progress progress("explore: frame", frames);
  for (int number = 0; number < frames; ++number) {
    display.begin();
    frame.begin();
    draw_frame(experience, frame, display.viewpoint(program.scene.start), sea_time_s(settings, number / arguments.fps));
    display.end(frame, &experience.picture());
    progress.step(number + 1);
  }
  frame.finish();
  for (int view = 0; view < options.views; ++view) {
    const std::filesystem::path file =
        std::filesystem::path(arguments.out) / fmt::format("explore{}.png", view_suffix(options.views, view));
    write_png(file, picture_of(*program.device, experience, view));
    fmt::print("{}\n", file.string());
  }
  expect_no_validation_messages(*program.device);
}

}  // namespace

int run_explore(const Arguments& arguments) {
  switch (resolve_display(arguments.display)) {
    case DisplayKind::headset:
      explore_in_headset(arguments);
      break;
    case DisplayKind::simulated:
      explore_simulated(arguments);
      break;
    case DisplayKind::headless:
      explore_headless(arguments);
      break;
    default:
      explore_in_window(arguments);
      break;
  }
  return 0;
}

}  // namespace seascape
