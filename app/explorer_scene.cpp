// What explore shows: the experience of a scene, how it is loaded, and what is made anew between two frames.
#include <fmt/format.h>

#include "app/calm_sea.h"
#include "app/explorer.h"
#include "app/loading_range.h"
#include "app/measured_display.h"
#include "app/quality.h"
#include "engine/error.h"

namespace seascape {

namespace {

constexpr double shaders_every_s = 0.5;  // looks whether one has changed

}  // namespace

ExperienceOptions Explorer::options(const Scene& scene) const {
  ExperienceOptions result{64, 64, display_.views()};
  if (experience_) {
    result.width = experience_->options().width;
    result.height = experience_->options().height;
  }
  result.per_eye = draw_per_eye(*program_.device, program_.shaders, scene.settings.render.stereo, display_.views());
  suit_display(result, display_);
  result.seen_elsewhere = desktop_ != nullptr;
  result.comfort = result.hands = display_.tracks_head();
  return result;
}

void Explorer::build(const Scene& scene) {
  experience_ = std::make_unique<Experience>(*program_.device, program_.shaders, scene, options(scene));
  take_experience();
}

// A person who wears a headset sees a sea at once, and not the nothing of a program that loads.
void Explorer::wait_at_sea() {
  at_sea_ = true;
  build(calm_sea(program_.scene, device_class(program_.device->facts())));
  load(program_.scene.name, [scene = program_.scene] { return scene; });
}

// What else has to know of another experience.
void Explorer::take_experience() {
  if (crew_.body()) display_.set_post(Post::afoot);
  crew_.forget();  // its boat is gone
  experience_->before_build([this] {
    if (mirror_) mirror_->let_go();
  });
  keep_rate();
  const std::string title = "Seascape: " + program_.scene.title;
  display_.set_title(title);
  if (mirror_) mirror_->set_title(title);
}

// What this scene and the next may be loaded with; none where the presets' costs are not known. A scene that asks for
// more samples than its preset keeps them.
std::vector<Lever> Explorer::loading_levers_here() const {
  const ExperienceOptions& now = experience_->options();
  const std::size_t finest = preset_index(finest_preset_);
  Settings of_preset;
  apply_preset(of_preset, finest_preset_);
  suit_device(of_preset, finest_preset_, device_class(program_.device->facts()));
  const bool own_samples = experience_->scene().settings.render.msaa > of_preset.render.msaa;
  const auto range =
      loading_range(costs_, experience_->scene().name, calibration_, 1e-6 * now.width * now.height * now.views, finest,
                    own_samples ? 1 : of_preset.render.msaa);
  return range ? loading_levers(*range) : std::vector<Lever>{};
}

// Levels go on as they were: another scene on the same machine is more like them than like the finest.
void Explorer::keep_rate() {
  std::vector<Lever> levers = live_levers(experience_->lowered());
  for (Lever& one : loading_levers_here()) levers.push_back(std::move(one));
  LeverLevels levels = nearest_levels(levers, quality_);
  set_loaded(levers, {preset_index(program_.preset), experience_->scene().settings.render.msaa}, levels);
  keeper_ = std::make_unique<RateKeeper>(std::move(levers), levels);
}

void Explorer::apply(const Settings& wanted) {
  const Settings before = settings();
  if (wanted.render.stereo != before.render.stereo && display_.views() == 2) {
    // Whether each eye has a pass of its own goes through everything.
    Scene now = experience_->scene();
    now.settings = wanted;
    build(now);
    return;
  }
  try {
    experience_->apply(wanted,
                       paused_ || wanted.time_scale <= 0.0);  // while time stands still or runs back no sea grows
    sea_elapsed_s_ += wanted.time_scale * (wanted.time_offset_s - before.time_offset_s);
  } catch (const Error& fault) {
    tell_fault(fault.what());
    experience_->apply(before);
  }
}

void Explorer::make_changes() {
  if (!display_.in_real_time()) loader_.wait();
  std::unique_ptr<Experience> loaded = loaded_scene();
  const bool look_at_shaders = debug_build && now_s_ >= shaders_looked_at_s_ + shaders_every_s;
  if (!loaded && !wanted_ && !wanted_effects_ && !look_at_shaders) return;
  const auto held = display_.hold_picture();
  if (loaded) take(std::move(loaded));
  const std::uint64_t builds = experience_->builds();
  if (wanted_) apply(*std::exchange(wanted_, std::nullopt));
  if (wanted_effects_) apply_effects(*std::exchange(wanted_effects_, std::nullopt));
  if (experience_->builds() != builds) keep_rate();  // what is built anew takes another time
  if (look_at_shaders) reload_shaders();
  if (held && experience_->builds() != builds) draw_unseen(*experience_, head(), sea_time_s());
}

void Explorer::apply_effects(const std::vector<std::string>& effects) {
  try {
    experience_->apply_effects(effects);
  } catch (const Error& fault) {
    tell_fault(fault.what());
  }
}

void Explorer::change_scene(const std::string& name) {
  const double ratio = scene_ratio(costs_, experience_->scene().name, name, preset_index(program_.preset));
  const LoadedWith now{preset_index(program_.preset), 0};
  load_scene_with(name, keeper_->for_scene(ratio, 1.0).value_or(now));
}

void Explorer::load_scene_with(const std::string& name, const LoadedWith& with) {
  const std::string preset(preset_names()[with.preset]);
  if (preset != program_.preset) tell("quality: " + preset + ", chosen to hold the frame rate");
  program_.preset = preset;
  Arguments asked = arguments_;  // what the command line sets stays set
  asked.scene = name;
  load(name, [asked, preset, samples = with.samples, device = device_class(program_.device->facts()),
              pressed = display_.tracks_head()] {
    Scene scene = scene_from(asked, preset, device);
    if (samples > 0) lower_samples(scene.settings, preset, device, samples);
    scene.actors_press = pressed;
    return scene;
  });
}

void Explorer::load(const std::string& name, std::function<Scene()> read) {
  loading_ = name;
  loader_.ask({std::move(read), [chosen = options(program_.scene), this](const Scene& scene) {
                 ExperienceOptions result = chosen;
                 result.per_eye =
                     draw_per_eye(*program_.device, program_.shaders, scene.settings.render.stereo, result.views);
                 return result;
               }});
  tell("loading: " + name);
}

std::unique_ptr<Experience> Explorer::loaded_scene() {
  try {
    return loader_.take();
  } catch (const Error& fault) {
    if (at_sea_) throw;  // there is nothing else to explore
    tell_fault(fault.what());
    return nullptr;
  }
}

void Explorer::take(std::unique_ptr<Experience> loaded) {
  const Settings before = settings();  // who stays the same
  experience_ = std::move(loaded);
  Settings theirs = settings();
  theirs.headset = before.headset;
  theirs.adaptive_use = before.adaptive_use;
  theirs.adaptive = before.adaptive;
  experience_->apply(theirs);
  wanted_.reset();  // of the scene before
  wanted_effects_.reset();
  const bool told =
      std::exchange(at_sea_, false) && experience_->scene().file == program_.scene.file;  // as it was read
  program_.scene = experience_->scene();
  if (!told) tell_remarks(program_.scene);
  take_experience();
  camera_ = ExploreCamera(program_.scene.start);
  comfort_.begin_anew();
  begin_time();
  tell("scene: " + program_.scene.name);
}

void Explorer::reload_shaders() {
  shaders_looked_at_s_ = now_s_;
  const std::uint64_t before = experience_->builds();
  try {
    experience_->reload_shaders();
    if (experience_->builds() != before) tell("shaders: read anew");
  } catch (const Error& fault) {
    tell_fault(fault.what());
  }
}

}  // namespace seascape
