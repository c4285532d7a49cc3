#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/calibrate.h"
#include "app/explorer.h"
#include "app/frame.h"
#include "app/frame_times.h"
#include "app/quality.h"
#include "app/sea_time.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/multiview_check.h"
#include "engine/signals.h"

namespace seascape {

namespace {

constexpr double longest_step_s = 1.0;  // a pause of the machine is no journey
constexpr double message_s = 4.0;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

Explorer::Explorer(const Arguments& arguments, Program& program, Display& display, WindowSystem* desktop)
    : arguments_(arguments),
      program_(program),
      display_(display),
      desktop_(display.tracks_head() ? desktop : nullptr),
      copy_(*program.device),
      loader_(*program.device, program.shaders),
      overlay_(display.make_overlay()),
      camera_(program.scene.start),
      scenes_(content_names("scenes")),
      costs_(shipped_preset_costs()),
      calibration_(remembered(DiskCache::of_user(), calibrated_device(program.device->facts()))),
      finest_preset_(arguments.preset == "auto" ? preset_names().back() : program.preset) {
  if (display_.views() == 2)
    (void)multiview_known_to_work(*program.device, program.shaders);  // or it would wait while it draws
  panel_.alone = display_.tracks_head();
  panel_.visible = !panel_.alone;  // a board before one's eyes comes when it is asked for
  program_.scene.actors_press = display_.tracks_head();
  begin_time();
  display_.tracks_head() && display_.in_real_time() ? wait_at_sea() : build(program_.scene);
}

LeftOff Explorer::left_off() const {
  return {at_sea_ ? program_.scene : experience_->scene(),
          program_.preset,
          head(),
          camera_.travel(),
          sea_elapsed_s_,
          paused_};
}

void Explorer::go_on_from(const LeftOff& before) {
  camera_ = ExploreCamera(before.head);
  camera_.set_travel(before.travel);
  sea_elapsed_s_ = before.sea_elapsed_s;
  paused_ = before.paused;
}

double Explorer::sea_time_s() const { return settings().time_start_s + sea_elapsed_s_; }

double Explorer::scene_time_s() const {
  // Replay counts from the scene's own start at the scene's own speed (see replay.cpp).
  const Settings& own = program_.scene.settings;
  return own.time_scale != 0.0 ? (sea_time_s() - own.time_start_s) / own.time_scale - own.time_offset_s : 0.0;
}

void Explorer::begin_time() {
  const Settings& own = program_.scene.settings;
  sea_elapsed_s_ = seascape::sea_time_s(own, own.follow_clock ? machine_clock_s() : 0.0) - own.time_start_s;
}

void Explorer::scrub(double by_s) {
  sea_elapsed_s_ += by_s;
  tell(fmt::format(
      "sea time: {:.1f} s{}", sea_time_s(),
      settings().follow_clock && !paused_ ? ", held to the clock (stop it with Space to look elsewhere)" : ""));
}

void Explorer::tell(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
  message_ = line;
  message_until_s_ = now_s_ + message_s;
}

void Explorer::tell_fault(const std::string& line) {
  spdlog::error("{}", line);
  message_ = line;
  message_until_s_ = now_s_ + 2.0 * message_s;
}

void Explorer::keep(const std::string& what, const std::string& stem, const std::string& ending,
                    const std::function<void(const std::filesystem::path&)>& write) {
  std::filesystem::path file;
  try {
    file = make_numbered_file(arguments_.out, stem, ending);
    write(file);
    tell(what + ": " + file.string());
  } catch (const Error& fault) {
    std::error_code ignored;
    if (std::filesystem::is_empty(file, ignored)) std::filesystem::remove(file, ignored);
    tell_fault(fault.what());
  }
}

void Explorer::set_travel(Travel travel) {
  if (crew_.body())
    return look_from_boat(travel == Travel::fly    ? BoatView::deck
                          : travel == Travel::walk ? BoatView::chase
                                                   : BoatView::fixed);
  camera_.set_travel(travel);
  tell(fmt::format("travel: {}", travel_name(travel)));
}

void Explorer::toggle_pause() {
  paused_ = !paused_;
  tell(paused_ ? "time: stopped" : "time: running");
}

void Explorer::scale_time(double factor) {
  Settings changed = asked();
  const Setting& row = *find_setting("time.scale");
  constexpr double least = 0.125;  // below it time stands still, and comes back from there
  double scale = changed.time_scale == 0.0 && factor > 1.0 ? least : changed.time_scale * factor;
  if (std::abs(scale) < least) scale = 0.0;
  changed.time_scale = std::clamp(scale, row.least, row.most);
  ask(changed);
  tell(fmt::format("time scale: {:g}", changed.time_scale));
}

void Explorer::next_debug_view() {
  Settings changed = asked();
  const std::size_t count = find_setting("debug.view")->choices.size();
  changed.render.debug = DebugView((std::size_t(changed.render.debug) + 1) % count);
  ask(changed);
  tell(fmt::format("debug view: {}", value_text(changed, *find_setting("debug.view"))));
}

void Explorer::toggle_comfort() {
  Settings changed = asked();
  changed.comfort.on = !changed.comfort.on;
  ask(changed);
  tell(changed.comfort.on ? "comfort: on" : "comfort: off");
}

void Explorer::toggle_light() {
  Settings changed = asked();
  changed.dive_light.on = !changed.dive_light.on;
  ask(changed);
  if (!experience_->underwater())
    tell("there is no dive light here: switch the effect underwater on");
  else
    tell(changed.dive_light.on ? "dive light: on" : "dive light: off");
}

void Explorer::take_screenshot() {
  const int views = display_.views();
  keep("screenshot", "screenshot", views == 1 ? ".png" : "_left.png", [&](const std::filesystem::path& file) {
    experience_->frame().finish();
    write_png(file, copy_.read(0));
    if (views == 1) return;
    const std::string first = file.string();
    write_png(first.substr(0, first.size() - std::string_view("_left.png").size()) + "_right.png", copy_.read(1));
    if (const auto outside = mirror_ ? mirror_->third() : std::nullopt)
      write_png(first.substr(0, first.size() - std::string_view("_left.png").size()) + "_third.png", *outside);
  });
}

void Explorer::toggle_recording() {
  if (!recorder_.recording()) {
    recording_wanted_ = !recording_wanted_;
    return;
  }
  keep("path", "recorded", ".json", [&](const std::filesystem::path& file) {
    save_camera_path(recorder_.stop(now_s_, head_.value_or(head()), scene_time_s(), file.stem().string()), file);
  });
}

PanelFacts Explorer::facts(const DisplayFrame& shown) const {
  PanelFacts facts;
  const Frame& frame = experience_->frame();
  const Scene& scene = experience_->scene();
  facts.title = scene.title;
  facts.scene = scene.name;
  facts.preset = program_.preset;
  facts.device = program_.device->facts().name;
  facts.device_class = device_class(program_.device->facts());
  facts.costs = costs_of(costs_, scene.name);
  facts.scenes = scenes_;
  facts.effects = scene.effects;
  facts.width = shown.width;
  facts.height = shown.height;
  facts.scale = display_.scale();
  facts.quality = keeper_->text();
  facts.views = display_.views();
  facts.travel = camera_.travel();
  facts.speed_mps = camera_.speed_mps();
  facts.sea_time_s = sea_time_s();
  facts.paused = paused_;
  facts.recording = recorder_.recording();
  if (const auto& bodies = experience_->bodies(); bodies != nullptr && crew_.body()) {
    facts.aboard = true;
    facts.moored = bodies->moorings().made_fast(*crew_.body());
    facts.anchored = bodies->moorings().anchored(*crew_.body());
  }
  facts.recorded_s = now_s_ - recording_began_s_;
  facts.frame_ms = frame_ms_;
  facts.period_ms = 1000.0 * shown.period_s;
  facts.dropped = dropped_;
  facts.state = !shown.should_render ? "away" : shown.focused ? "focused" : "unfocused";
  facts.cpu_ms = cpu_ms_;
  facts.gpu_ms = frame.gpu_ms();
  facts.passes = frame.times();
  facts.stages = frame.stages().times();
  facts.counts = frame.counts();
  facts.patches = patches_;
  return facts;
}

void Explorer::obey(const PanelWish& wish) {
  if (wish.settings) ask(*wish.settings);
  if (wish.preset) {
    Settings changed = asked();
    apply_preset(changed, *wish.preset);
    suit_device(changed, *wish.preset, device_class(program_.device->facts()));
    program_.preset = finest_preset_ = *wish.preset;
    ask(changed);
    tell("quality: " + *wish.preset);
    if (loader_.busy()) load_scene_with(loading_, {preset_index(*wish.preset), 0});
  }
  if (wish.effects) wanted_effects_ = *wish.effects;
  if (wish.travel) set_travel(*wish.travel);
  if (wish.sea_time_s) sea_elapsed_s_ = *wish.sea_time_s - settings().time_start_s;
  if (wish.pause) toggle_pause();
  if (wish.record) toggle_recording();
  if (wish.screenshot) screenshot_wanted_ = true;
  if (wish.moor) wished_.push_back(Action::moor);
  if (wish.anchor) wished_.push_back(Action::anchor);
  if (wish.respawn) wished_.push_back(Action::respawn);
  if (wish.scene && *wish.scene != experience_->scene().name) change_scene(*wish.scene);
}

// Before the display begins a frame, for that gives the picture its size. A screenshot is of a whole picture.
void Explorer::hold_rate() {
  AdaptiveSettings wished = settings().adaptive;
  const AdaptiveUse use = settings().adaptive_use;
  wished.on = use == AdaptiveUse::on || (use == AdaptiveUse::automatic && display_.in_real_time());
  KnownOfFrames known = known_of(experience_->frame(), 1000.0 * period_s_);
  known.interval_ms = was_shown_ ? frame_ms_ : 0.0;
  known.focused = focused_ && was_shown_;
  const Decision& decision = keeper_->decide(known, wished);
  if (decision.moved()) spdlog::debug("{}", decision_text(decision, keeper_->controller().levers()));
  whole_ = screenshot_wanted_;
  quality_ = whole_ ? DrawnQuality{} : keeper_->quality();
}

void Explorer::draw(const DisplayFrame& shown, double dt_s) {
  const double began_s = seconds();
  if (overlay_) {
    overlay_->begin(!look_by_button_ && !look_by_key_);
    const PanelWish wish = panel_.draw(settings(), program_.scene.settings, facts(shown));
    if (now_s_ < message_until_s_ || loader_.busy()) Panel::draw_message(message_);
    overlay_->end();
    obey(wish);
  }
  display_.set_lens(settings().render.vertical_fov_deg, settings().render.eye_distance_m);
  experience_->resize(shown.width, shown.height, display_.most_size());
  experience_->draw_at(quality_);
  experience_->draw_into(shown.lent);
  if (shown.lent) experience_->choose(shown.colour, shown.depth);
  Frame& frame = experience_->frame();
  const double waited_s = seconds();
  frame.begin();  // waits for the frame before the last
  const double ready_s = seconds();
  move(input_, dt_s);
  if (display_.tracks_head()) show_hands(input_);
  const auto lamp_hand = pointing_hand(input_);
  experience_->hold_lamp(lamp_hand ? hands(input_)[*lamp_hand] : std::nullopt);
  const Viewpoint viewpoint = display_.viewpoint(carrier());
  if (const HiddenMesh* hidden = display_.hidden()) experience_->hide(*hidden);
  record(input_, viewpoint.viewer);
  draw_frame(*experience_, frame, viewpoint, sea_time_s());
  experience_->go_on();  // settled as it was for the first frame
  tell_of_bodies();
  tell_of_eyes();
  patches_ = experience_->ocean().selection()->patches.size();
  const bool keeps = whole_ && std::exchange(screenshot_wanted_, false);
  if (keeps || (mirror_ && mirror_->wants_copy()))
    copy_.record(frame, experience_->picture());  // for the picture may be gone once the frame is ended
  const double recorded_s = seconds();
  display_.end(frame, &experience_->picture(), experience_->shown_depth());
  const double ended_s = seconds();
  cpu_ms_ = 1000.0 * (ended_s - ready_s + waited_s - began_s);
  const double end_ms = 1000.0 * (ended_s - recorded_s);
  keeper_->drawn(handed_over(*experience_, cpu_ms_ - end_ms, end_ms, whole_));
  if (keeps) take_screenshot();
  if (mirror_) show_desk(shown, dt_s);
}

// A display that has to be asked ends when it says so.
void Explorer::leave() {
  if (!display_.tracks_head()) leaving_ = true;
  display_.leave();
}

void Explorer::step(const DisplayFrame& shown) {
  const double passed_s = last_s_ ? shown.time_s - *last_s_ : 0.0, dt_s = std::clamp(passed_s, 0.0, longest_step_s);
  last_s_ = shown.time_s;
  input_ = display_.input();
  serve_desk();
  for (const Action action : std::exchange(wished_, {})) input_.pressed.push_back({action, 1.0});
  obey(input_);
  look(input_);
  if (!shown.should_render) {  // time stands still meanwhile
    display_.end(experience_->frame(), nullptr);
    was_shown_ = false;
    if (mirror_) show_desk(shown, 0.0);
    return;
  }
  if (std::exchange(was_shown_, true) && shown.period_s > 0.0 && passed_s > 1.5 * shown.period_s)
    dropped_ += std::uint64_t(std::lround(passed_s / shown.period_s)) - 1;
  frame_ms_ = 1000.0 * passed_s;
  period_s_ = shown.period_s;
  focused_ = shown.focused;
  now_s_ += dt_s;
  if (!paused_) {
    if (settings().follow_clock)
      sea_elapsed_s_ = seascape::sea_time_s(settings(), machine_clock_s()) - settings().time_start_s;
    else
      sea_elapsed_s_ += dt_s * settings().time_scale;
  }
  draw(shown, dt_s);
  if (!at_sea_) ++drawn_;
}

bool Explorer::frame() {
  if (leaving_ || (arguments_.frames > 0 && drawn_ >= arguments_.frames)) return false;
  make_changes();
  hold_rate();
  suit_wearer();
  const DisplayFrame shown = display_.begin();
  if (!shown.closed) step(shown);
  return !shown.closed;
}

void Explorer::run() {
  for (const auto& [key, what] : key_help()) fmt::print("{:<20}{}\n", key, what);
  std::fflush(stdout);
  const StopLater between_frames;  // a signal ends the loop, and what was recorded is kept
  const auto keep_recording = [this] {
    if (recorder_.recording()) toggle_recording();
  };
  try {
    while (!stop_is_asked() && frame()) {
    }
  } catch (const Error&) {  // a headset may be lost
    keep_recording();
    throw;
  }
  keep_recording();
  experience_->frame().finish();
  throw_if_stopped("explore");
}

}  // namespace seascape
