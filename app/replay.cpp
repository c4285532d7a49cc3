// `seascape replay`: draws a camera path frame by frame into files; its time comes from the path, never from the clock.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "app/boats/crew.h"
#include "app/boats/path_on_body.h"
#include "app/commands.h"
#include "app/frame.h"
#include "app/hands_in_water.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/report_replay.h"
#include "app/sea_time.h"
#include "engine/error.h"
#include "engine/output_folder.h"

namespace seascape {

namespace {

std::string setting_text(const Settings& settings, std::string_view key) {
  return value_text(settings, *find_setting(key));
}

ReplayRecord record_of(const Arguments& arguments, const Program& program, const Experience& experience,
                       const CameraPath& path) {
  const Settings& settings = experience.scene().settings;
  ReplayRecord record;
  record.scene = program.scene.name;
  record.path = path.name;
  record.preset = program.preset;
  record.seed = settings.sea.seed;
  record.width = int(experience.options().width);
  record.height = int(experience.options().height);
  record.msaa = settings.render.msaa;
  record.fps = arguments.fps;
  record.stereo = experience.options().per_eye ? "per-eye" : "single";
  record.debug = setting_text(settings, "debug.view");
  record.format = arguments.format == PictureFormat::png ? "png" : "exr";
  record.device = program.device->facts().name;
  record.driver = program.device->facts().driver;
  record.build = build_name();
  return record;
}

// Writes a picture an eye and returns their names.
std::vector<std::string> write_pictures(const std::filesystem::path& out, int number, PictureFormat format,
                                        Device& device, const Experience& experience) {
  std::vector<std::string> names;
  const int views = experience.options().views;
  for (int view = 0; view < views; ++view) {
    const bool png = format == PictureFormat::png;
    names.push_back(fmt::format("frame_{:04}{}.{}", number, view_suffix(views, view), png ? "png" : "exr"));
    if (png)
      write_png(out / names.back(), picture_of(device, experience, view));
    else
      write_exr(out / names.back(), linear_picture_of(device, experience, view));
  }
  return names;
}

// The dive light as it is at `to_s`: as the scene has it, turned over by each press.
void burn_light(Experience& experience, const Settings& scene, const std::optional<InputTimeline>& acted,
                const std::optional<ReplayedInput>& input, double to_s) {
  if (!acted) return;
  Settings settings = experience.scene().settings;
  settings.dive_light.on = scene.dive_light.on;
  for (const ActionPress& press : acted->presses(-1.0, to_s))
    if (press.action == Action::light) settings.dive_light.on = !settings.dive_light.on;
  if (settings.dive_light.on != experience.scene().settings.dive_light.on) experience.apply(settings);
  const std::size_t first = settings.headset.left_handed ? 0 : 1;
  experience.hold_lamp(input->hands[first] ? input->hands[first] : input->hands[1 - first]);
}

// What the path's user did in the frame that ends at `to_s`.
ReplayedInput acted_in(const InputTimeline& timeline, double after_s, double to_s) {
  ReplayedInput acted;
  acted.values = timeline.values(to_s);
  for (const ActionPress& press : timeline.presses(after_s, to_s)) acted.pressed.push_back({press.action, press.value});
  acted.hands = {timeline.pose(Tracker::left, to_s), timeline.pose(Tracker::right, to_s)};
  return acted;
}

// The path's user in the sea: his hands in the water, and himself aboard.
struct Person {
  glm::dvec3 at_m{0.0};  // in the frame before
  HandsInWater hands;
  Crew crew;

  void act(Experience& experience, const ReplayedInput& acted, const glm::dvec3& head_m, double scene_time_s) {
    hands.follow(experience.sea());
    hands.move(acted.hands, scene_time_s);
    if (experience.bodies() == nullptr) return;
    for (const Press& press : acted.pressed)
      if (const auto told = crew.press(press.action, experience.scene(), *experience.bodies(), head_m, scene_time_s))
        spdlog::info("{}", *told);
    crew.drive(*experience.bodies(), acted.values);
  }
};

// The drops on lenses follow from where the eyes were in the seconds before, and bubbles from where the head was.
void follow_head_before(Experience& experience, const Headless& display, const CameraPath& path, double fps,
                        int frames) {
  if (!experience.underwater()) return;
  const int wets_lenses = frames - int(std::ceil(WetLens::remembers_s * fps));
  for (int frame = 0; frame < frames; ++frame) {
    const PathSample sample = path.at(frame / fps);
    const double time_s = sea_time_s(experience.scene().settings, sample.scene_time_s);
    if (frame >= wets_lenses) experience.wet_lenses(display.viewpoint(sample.pose), time_s);
    experience.breathe(time_s, sample.pose);
  }
}

// What floats has come where it is by its own history, and so has its foam: the frames before the first that is drawn
// are lived through, undrawn.
void live_through(Experience& experience, const Headless& display, const CameraPath& path,
                  const std::optional<InputTimeline>& acted, Person& person, double fps, int frames) {
  if (experience.bodies() == nullptr) follow_head_before(experience, display, path, fps, frames);
  if (experience.bodies() == nullptr || frames == 0) return;
  Progress progress("replay: frame before --start", std::size_t(frames));
  Stages undrawn;  // nobody reads their times
  for (int frame = 0; frame < frames; ++frame) {
    const PathSample sample = path.at(frame / fps);
    const double time_s = sea_time_s(experience.scene().settings, sample.scene_time_s);
    if (acted)
      person.act(experience, acted_in(*acted, frame == 0 ? -1.0 : (frame - 1) / fps, frame / fps), person.at_m, time_s);
    const Pose head = pose_in_world(experience, path, sample, time_s, person.at_m);
    person.at_m = head.position_m;
    experience.sea()->advance(time_s, person.at_m);
    experience.ocean().live_through(undrawn, time_s, person.at_m);
    experience.wet_lenses(display.viewpoint(head), time_s);
    experience.breathe(time_s, head);
    (void)experience.bodies()->take_events();
    progress.step(std::size_t(frame) + 1);
  }
}

std::vector<ReplayedBody> replayed_bodies(const Experience& experience, double time_s) {
  std::vector<ReplayedBody> list;
  if (const auto& bodies = experience.bodies())
    for (std::size_t n = 0; n < bodies->size(); ++n)
      list.push_back({bodies->bodies().spec(n).name, bodies->pose_at(n, time_s), bodies->velocity_mps(n)});
  return list;
}

}  // namespace

int run_replay(const Arguments& arguments) {
  Program program = make_program(arguments, device_options());
  Device& device = *program.device;
  const CameraPath path = path_from(arguments, program.scene);
  validate_rider(path, program.scene);
  std::optional<InputTimeline> acted;
  if (path.actions) acted.emplace(*path.actions);
  program.scene.actors_press = acted.has_value();
  const int path_frames = frames_of(path, arguments.fps);
  if (arguments.start >= path_frames)
    throw Error("--start", fmt::format("{} is past the path's last frame, {}", arguments.start, path_frames - 1),
                "choose an earlier one", 2);
  const int count = arguments.frames > 0 ? arguments.frames : path_frames - arguments.start;
  const std::filesystem::path out = arguments.out;
  const OutputFolder held(out);

  const RenderSettings& render = program.scene.settings.render;
  const HeadlessOptions options = headless_options(arguments, render);
  Headless display(options);
  const bool per_eye = draw_per_eye(device, program.shaders, render.stereo, options.views);
  Experience experience(
      device, program.shaders, program.scene,
      {options.width, options.height, options.views, per_eye, false, arguments.format == PictureFormat::exr});
  Frame& frame = experience.frame();
  ReplayRecord record = record_of(arguments, program, experience, path);
  Person person{path.at(0.0).pose.position_m, {}, {}};
  live_through(experience, display, path, acted, person, arguments.fps, arguments.start);
  EyeCrossings eyes;
  Progress progress("replay: frame", std::size_t(count));
  for (int done = 0; done < count; ++done) {
    ReplayFrame drawn;
    drawn.frame = arguments.start + done;
    drawn.time_s = drawn.frame / arguments.fps;
    const PathSample sample = path.at(drawn.time_s);
    drawn.scene_time_s = sea_time_s(program.scene.settings, sample.scene_time_s);

    display.begin();
    if (acted) {
      const bool first = done == 0 && (drawn.frame == 0 || experience.bodies() == nullptr);
      drawn.acted = acted_in(*acted, first ? -1.0 : (drawn.frame - 1) / arguments.fps, drawn.time_s);
      person.act(experience, *drawn.acted, person.at_m, drawn.scene_time_s);
    }
    burn_light(experience, program.scene.settings, acted, drawn.acted, drawn.time_s);
    const Pose pose = pose_in_world(experience, path, sample, drawn.scene_time_s, person.at_m);
    person.at_m = pose.position_m;
    drawn.views = display.viewpoint(pose);
    frame.begin();
    const auto begun = std::chrono::steady_clock::now();
    draw_frame(experience, frame, drawn.views, drawn.scene_time_s);
    display.end(frame, &experience.picture());
    drawn.cpu_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
    frame.finish();
    drawn.gpu_ms = frame.gpu_ms();

    drawn.draws = frame.counts().draws;
    drawn.triangles = frame.counts().triangles;
    drawn.dispatches = frame.counts().dispatches;
    drawn.patches = experience.ocean().selection()->patches.size();
    drawn.bodies = replayed_bodies(experience, drawn.scene_time_s);
    if (const auto& bodies = experience.bodies()) drawn.events = bodies->take_events();
    eyes.step(drawn.time_s, experience.eyes_depth_m().first(drawn.views.eyes.size()));
    drawn.eye_events = eyes.take_events();
    drawn.sea_hash = experience.sea()->hash();
    drawn.files = write_pictures(out, drawn.frame, arguments.format, device, experience);
    record.frames.push_back(std::move(drawn));
    progress.step(std::size_t(done) + 1);
  }
  expect_no_validation_messages(device);
  write_replay_record(out / "replay.json", record);
  return 0;
}

}  // namespace seascape
