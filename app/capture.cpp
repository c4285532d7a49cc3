// `seascape capture`: measures frame times along a camera path, at one preset or at all of them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include <spdlog/spdlog.h>

#include "app/against.h"
#include "app/boats/path_on_body.h"
#include "app/commands.h"
#include "app/frame.h"
#include "app/frame_times.h"
#include "app/measured_display.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/quality.h"
#include "app/report.h"
#include "app/report_plots.h"
#include "app/sea_time.h"
#include "app/statistics.h"
#include "app/svg.h"
#include "app/trace.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/output_folder.h"
#include "engine/text.h"

namespace seascape {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char *partial_csv = "capture.partial.csv", *quality_svg = "quality.svg";

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

// Holds the frame rate where it is asked to, and keeps what it did.
class Keeping {
 public:
  // Throws Error where there is no rate to hold.
  Keeping(const Settings& settings, Experience& experience, Display& display)
      : settings_(settings.adaptive),
        experience_(experience),
        display_(display),
        scale_(display.tracks_head() ? settings.headset.scale : 1.0) {
    settings_.on = settings.adaptive_use == AdaptiveUse::on;
    keeper_.emplace(live_levers(experience.lowered()));
    if (settings_.on && settings_.target_hz == 0.0 && std::string_view(display.name()) == "headless")
      throw Error("adaptive.use", "a display without a screen has no rate to hold",
                  "add --set adaptive.target_hz=72, or take --display window or simulated");
  }
  bool on() const { return settings_.on; }
  // Before display_.begin().
  void choose() {
    const Decision& decision = keeper_->decide(known_of(experience_.frame(), period_ms_), settings_);
    if (decision.moved()) spdlog::debug("{}", decision_text(decision, keeper_->controller().levers()));
    display_.set_scale(scale_ * keeper_->quality().scale);
    experience_.draw_at(keeper_->quality());
  }
  void begun(const DisplayFrame& shown) { period_ms_ = 1000.0 * shown.period_s; }
  void drawn(double cpu_ms, double end_ms) { keeper_->drawn(handed_over(experience_, cpu_ms, end_ms)); }
  // What a frame may take, ms.
  double period_ms() const { return settings_.target_hz > 0.0 ? 1000.0 / settings_.target_hz : period_ms_; }
  void keep(CaptureFrame& now) const {
    const Decision& d = keeper_->last();
    now.picture_scale = keeper_->quality().scale;
    now.quality = d.quality;
    now.decision = name_of(d.reason);
    if (d.moved()) now.decision += ": " + moves_text(keeper_->controller().levers(), d.before, d.levels);
  }

 private:
  AdaptiveSettings settings_;
  Experience& experience_;
  Display& display_;
  double scale_, period_ms_ = 0.0;
  std::optional<RateKeeper> keeper_;
};

// Into `result`, which holds what was measured so far where this throws.
void measure(const Arguments& arguments, Program& program, MeasuredDisplay& displays, Measured& result) {
  Device& device = *program.device;
  const RenderSettings& render = program.scene.settings.render;
  const CameraPath path = path_from(arguments, program.scene);
  validate_rider(path, program.scene);
  const HeadlessOptions options = headless_options(arguments, render);
  const std::unique_ptr<Display> display =
      displays.make(device, options, program.scene.settings, {arguments.width, arguments.height});
  const bool per_eye = draw_per_eye(device, program.shaders, render.stereo, options.views);
  ExperienceOptions made{options.width, options.height, options.views, per_eye, false};
  suit_display(made, *display);
  Experience experience(device, program.shaders, program.scene, made);
  Frame& frame = experience.frame();
  Keeping keeping(program.scene.settings, experience, *display);

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
    keeping.choose();
    const DisplayFrame shown = display->begin();
    keeping.begun(shown);
    if (shown.closed)
      throw Error("--display window", fmt::format("the window was closed at frame {} of {}", i, all),
                  "let it be, or measure headless");
    if (!shown.should_render) {  // hidden or minimised: nothing is measured meanwhile
      display->end(frame, nullptr);
      progress.step(std::size_t(i));
      continue;
    }
    experience.resize(shown.width, shown.height, display->most_size());
    experience.draw_into(shown.lent);
    if (shown.lent) experience.choose(shown.colour, shown.depth);
    frame.begin();  // waits for the slot; its frame's times are there now
    const auto cpu = Clock::now();
    const double time_s = sea_time_s(program.scene.settings, sample.scene_time_s + before_s);
    const Pose pose = pose_in_world(experience, path, sample, time_s, viewer_m);
    viewer_m = pose.position_m;
    draw_frame(experience, frame, display->viewpoint(carrier_for(*display, pose)), time_s);
    const double recorded_ms = ms_since(cpu);
    display->end(frame, &experience.picture(), experience.shown_depth());
    const double cpu_ms = ms_since(cpu);
    keeping.drawn(recorded_ms, cpu_ms - recorded_ms);
    if (arguments.repeat > 1) device.wait_idle();

    if (measured) {
      if (number == 0) first_number = frame.number();
      CaptureFrame& now = run.frames[std::size_t(number)];
      now.frame = number;
      now.time_s = path_time_s;
      now.cpu_ms = cpu_ms;
      add_times(frame.stages().times(), run.stage_names, now.stage_ms);
      now.gpu_ms = std::numeric_limits<double>::quiet_NaN();  // until it is read, and on a device that cannot tell
      if (keeping.on()) keeping.keep(now);
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
  run.width = int(std::max(experience.options().width, keeping.on() ? display->most_size().x : 0));
  run.height = int(std::max(experience.options().height, keeping.on() ? display->most_size().y : 0));
  run.kept_ms = keeping.on() ? keeping.period_ms() : 0.0;
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
    if (measured.run.kept_ms > 0.0) fmt::print("{:<8} {}\n", "", kept_text(measured.run));
  }
}

}  // namespace

int run_capture(const Arguments& arguments) {
  if (arguments.display == DisplayKind::headset)
    throw Error("--display headset", "a headset's runtime shares the device, and its time is not ours to measure",
                "take --display simulated, window or headless");
  if (arguments.display == DisplayKind::simulated && arguments.views == 1)
    throw Error("--views", "a headset has two eyes", "add --views 2, or take --display window or headless", 2);
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

  std::vector<Measured> all;
  Machine machine;
  std::optional<OutputFolder> held;
  std::optional<StopLater> while_measured;  // a signal may come while the next preset's scene is made
  try {
    for (const std::string& preset : presets) {
      DeviceOptions options = device_options();
      MeasuredDisplay displays(arguments.display, options);
      Program program = make_program(arguments, preset, options);
      if (all.empty()) {  // every fault that can be known is told before the long work
        (void)path_from(arguments, program.scene);
        held.emplace(out);
        while_measured.emplace();
        machine = machine_of(program.device->facts(), program.scene.settings.sea.seed);
      }
      for (int n = 0; n < arguments.repeat; ++n) measure(arguments, program, displays, all.emplace_back());
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
  std::filesystem::remove(out / quality_svg, ignored);  // of an earlier run
  if (const std::string svg = kept_svg(runs.front()); !svg.empty())
    write_atomically(out / quality_svg, standalone_svg(svg));
  std::filesystem::remove(out / partial_csv, ignored);  // of an earlier run
  print_table(all);
  // Both as files hold them.
  if (!arguments.against.empty())
    fmt::print("{}", tell_changes(compare_captures(before, parse_capture_csv(capture_csv(runs), "capture.csv"))));
  return 0;
}

}  // namespace seascape
