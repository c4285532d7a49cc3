// `seascape capture`: measures frame times along a camera path, at one preset or at all of them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "app/against.h"
#include "app/boats/path_on_body.h"
#include "app/commands.h"
#include "app/frame.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/quality.h"
#include "app/report.h"
#include "app/sea_time.h"
#include "app/statistics.h"
#include "app/trace.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/output_folder.h"
#include "engine/text.h"
#include "platform/window.h"

namespace seascape {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* partial_csv = "capture.partial.csv";

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// One run and, apart from what the files hold, the time from one frame's begin to the next: all there is of both CPU
// and GPU.
struct Measured {
  CaptureRun run;
  std::vector<double> interval_ms;
  std::size_t whole = 0;  // frames so far that have all their times
};

// Adds times by name to a frame's. Those of one name count together.
template <class Times>
void add_times(const Times& times, std::vector<std::string>& names, std::vector<double>& to) {
  for (const auto& time : times) {
    const std::size_t column = std::size_t(std::find(names.begin(), names.end(), time.name) - names.begin());
    if (column == names.size()) names.emplace_back(time.name);
    if (to.size() <= column) to.resize(column + 1, 0.0);
    to[column] += time.ms;
  }
}

// Takes the GPU times that `frame` holds, which are of an earlier frame.
void take_gpu_times(const Frame& frame, CaptureRun& run, CaptureFrame& measured) {
  measured.gpu_ms = frame.gpu_ms();
  add_times(frame.times(), run.pass_names, measured.pass_ms);
}

std::vector<MemoryUse> memory_of(const Device& device) {
  std::map<std::string, std::uint64_t> bytes;
  for (const ObjectRecord& object : device.objects())
    if (object.type == VK_OBJECT_TYPE_BUFFER || object.type == VK_OBJECT_TYPE_IMAGE)
      bytes[object.effect] += object.bytes;
  std::vector<MemoryUse> uses;
  for (const auto& [tag, sum] : bytes) uses.push_back({tag, sum});
  return uses;
}

// Without a screen by default: a window shows every frame and may hold the loop to the screen's rate.
std::unique_ptr<Display> make_display(const HeadlessOptions& options, WindowSystem* windows, Device& device) {
  if (!windows) return std::make_unique<Headless>(options);
  WindowOptions shown;
  shown.title = "Seascape: capture";
  shown.width = options.width;
  shown.height = options.height;
  shown.views = options.views;
  auto window = std::make_unique<Window>(*windows, device, shown);
  window->set_lens(options.vertical_fov_deg, options.eye_distance_m);
  return window;
}

// Into `result`, which holds what was measured so far where this throws. `windows`: null to measure without a screen.
void measure(const Arguments& arguments, Program& program, WindowSystem* windows, Measured& result) {
  Device& device = *program.device;
  const RenderSettings& render = program.scene.settings.render;
  const CameraPath path = path_from(arguments, program.scene);
  validate_rider(path, program.scene);
  const HeadlessOptions options = headless_options(arguments, render);
  const std::unique_ptr<Display> display = make_display(options, windows, device);
  const bool per_eye = draw_per_eye(device, program.shaders, render.stereo, options.views);
  Experience experience(device, program.shaders, program.scene,
                        {options.width, options.height, options.views, per_eye, false});
  Frame& frame = experience.frame();

  CaptureRun& run = result.run;
  run.scene = program.scene.name;
  run.path = path.name;
  run.preset = program.preset;
  run.views = options.views;
  run.msaa = experience.scene().settings.render.msaa;
  run.warmup = arguments.warmup;
  const int count = arguments.frames > 0 ? arguments.frames : frames_of(path, arguments.fps);
  run.frames.resize(std::size_t(count));
  result.interval_ms.resize(std::size_t(count));

  // A frame's GPU times are read when its slot comes round again: so many frames more are drawn, and none is waited
  // for.
  const int all = arguments.warmup + count + Frame::slots;
  Progress progress("capture at " + program.preset + ": frame", std::size_t(all));
  glm::dvec3 viewer_m = path.at(0.0).pose.position_m;
  std::uint64_t first_number = 0;  // of the frame loop, for the first that is measured
  for (int i = 0; i < all;) {
    const auto [number, path_time_s, before_s] = capture_moment(i, arguments.warmup, arguments.fps);
    const bool measured = number >= 0 && number < count;
    const PathSample sample = path.at(path_time_s);
    const auto interval = Clock::now();
    const DisplayFrame shown = display->begin();
    if (shown.closed)
      throw Error("--display window", fmt::format("the window was closed at frame {} of {}", i, all),
                  "let it be, or measure headless");
    if (!shown.should_render) {  // hidden or minimised: nothing is measured meanwhile
      display->end(frame, nullptr);
      progress.step(std::size_t(i));
      continue;
    }
    experience.resize(shown.width, shown.height);
    frame.begin();  // waits for the slot; its frame's times are there now
    const auto cpu = Clock::now();
    const double time_s = sea_time_s(program.scene.settings, sample.scene_time_s + before_s);
    const Pose pose = pose_in_world(experience, path, sample, time_s, viewer_m);
    viewer_m = pose.position_m;
    draw_frame(experience, frame, display->viewpoint(pose), time_s);
    display->end(frame, &experience.picture());
    const double cpu_ms = ms_since(cpu);
    if (arguments.repeat > 1) device.wait_idle();

    if (measured) {
      if (number == 0) first_number = frame.number();
      CaptureFrame& now = run.frames[std::size_t(number)];
      now.frame = number;
      now.time_s = path_time_s;
      now.cpu_ms = cpu_ms;
      add_times(frame.stages().times(), run.stage_names, now.stage_ms);
      now.gpu_ms = std::numeric_limits<double>::quiet_NaN();  // until it is read, and on a device that cannot tell
      now.draws = frame.counts().draws;
      now.triangles = frame.counts().triangles;
      now.dispatches = frame.counts().dispatches;
    }
    if (device.facts().timestamps && first_number && frame.timed_frame() >= first_number &&
        frame.timed_frame() < first_number + std::uint64_t(count)) {
      result.whole = std::size_t(frame.timed_frame() - first_number);
      take_gpu_times(frame, run, run.frames[result.whole++]);
    }
    if (measured && !device.facts().timestamps) result.whole = std::size_t(number) + 1;
    progress.step(std::size_t(++i));
    if (measured) result.interval_ms[std::size_t(number)] = ms_since(interval);
  }
  for (CaptureFrame& one : run.frames) {
    one.pass_ms.resize(run.pass_names.size(), 0.0);
    one.stage_ms.resize(run.stage_names.size(), 0.0);
  }
  run.width = int(experience.options().width);
  run.height = int(experience.options().height);
  run.memory = memory_of(device);
  expect_no_validation_messages(device);
}

// Keeps the rows of a capture that did not come to its end, under a name that says so, and says what it kept.
std::string keep_whole_rows(const std::filesystem::path& out, std::vector<Measured>& all) {
  std::vector<CaptureRun> runs;
  std::size_t rows = 0;
  for (Measured& measured : all) {
    if (measured.whole == 0) continue;
    rows += measured.whole;
    runs.push_back(std::move(measured.run));
    runs.back().frames.resize(measured.whole);
  }
  if (rows == 0) return "before a row was whole";
  const std::filesystem::path file = out / partial_csv;
  try {
    write_capture_csv(file, runs);
  } catch (const Error& fault) {
    return fmt::format("{} rows were measured and are lost: {}", rows, fault.what());
  }
  return fmt::format("the {} rows measured so far are kept in {}", rows, file.string());
}

void print_table(const std::vector<Measured>& all) {
  fmt::print("frame time in ms (the longer of CPU and GPU); interval: from one frame's begin to the next\n");
  fmt::print("{:<8} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}  {:>6} {:>6} {:>6} {:>6}  of frames\n", "preset",
             "frames", "min", "median", "p95", "p99", "max", "interval", "72 Hz", "80 Hz", "90 Hz", "120 Hz");
  for (const Measured& measured : all) {
    const std::vector<double> times = frame_times_ms(measured.run);
    const Summary s = summarise(times);
    fmt::print("{:<8} {:>6} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} ", measured.run.preset, times.size(),
               s.min, s.median, s.p95, s.p99, s.max, summarise(measured.interval_ms).median);
    for (const int rate : display_rates_hz) fmt::print(" {:>6}", count_missed(times, rate));
    fmt::print("  missed\n");
  }
}

}  // namespace

int run_capture(const Arguments& arguments) {
  if (arguments.display == DisplayKind::headset || arguments.display == DisplayKind::simulated)
    throw Error(arguments.display == DisplayKind::headset ? "--display headset" : "--display simulated",
                "capture measures in a window or without a display", "take --display window or headless");
  std::vector<std::string> presets{arguments.preset};
  if (arguments.preset == "all") presets.assign(preset_names().begin(), preset_names().end());
  const std::filesystem::path out = arguments.out;
  std::vector<CaptureRun> before;
  if (!arguments.against.empty()) {
    if (same_file(arguments.against, out / "capture.csv") || same_file(arguments.against, out / partial_csv))
      throw Error("--out", in_quotes(arguments.against, 400) + " of --against would be lost",
                  "give another folder, or copy the file first", 2);
    before = parse_capture_csv(read_text(arguments.against), arguments.against);
    expect_repeats(before, arguments.against);
    if (arguments.repeat < least_repeats)
      throw Error("--against", fmt::format("takes {} runs of the path and more on either side", least_repeats),
                  "add --repeat 16");
  }
  // Faults in it are told first, and what gives nothing once for all presets.
  tell_remarks(scene_from(arguments, presets.front() == "auto" ? "high" : presets.front()));

  std::optional<WindowSystem> windows;
  DeviceOptions options = device_options();
  if (arguments.display == DisplayKind::window) {
    windows.emplace();
    options.present = true;
    options.instance_extensions = windows->instance_extensions();
  }
  std::vector<Measured> all;
  Machine machine;
  std::optional<OutputFolder> held;
  std::optional<StopLater> while_measured;  // a signal may come while the next preset's scene is made
  try {
    for (const std::string& preset : presets) {
      Program program = make_program(arguments, preset, options);
      if (all.empty()) {  // every fault that can be known is told before the long work
        (void)path_from(arguments, program.scene);
        held.emplace(out);
        while_measured.emplace();
        machine = machine_of(program.device->facts(), program.scene.settings.sea.seed);
      }
      for (int n = 0; n < arguments.repeat; ++n)
        measure(arguments, program, windows ? &*windows : nullptr, all.emplace_back());
    }
  } catch (const Error& fault) {
    if (all.empty()) throw;
    throw Error(fault.where(), fault.fault() + ", " + keep_whole_rows(out, all), fault.remedy(), fault.exit_code());
  }
  std::vector<CaptureRun> runs;
  for (const Measured& measured : all) runs.push_back(measured.run);
  write_capture_csv(out / "capture.csv", runs);
  write_trace(out / "trace.json", runs);
  write_report(out / "report.html", machine, runs);
  std::error_code ignored;
  std::filesystem::remove(out / partial_csv, ignored);  // of an earlier run
  print_table(all);
  // Both as files hold them.
  if (!arguments.against.empty())
    fmt::print("{}", tell_changes(compare_captures(before, parse_capture_csv(capture_csv(runs), "capture.csv"))));
  return 0;
}

}  // namespace seascape
