#include "app/mirror.h"

#include <algorithm>
#include <cmath>

#include "app/mirror_layout.h"
#include "engine/error.h"

namespace seascape {

namespace {

constexpr VkDeviceSize vertex_bytes = 256u << 10;  // to begin with: copies need none

WindowOptions beside_a_headset(WindowOptions options) {
  options.waits = false;
  options.views = 1;
  return options;
}

}  // namespace

Mirror::Mirror(WindowSystem& system, Device& device, ShaderLibrary& shaders, const WindowOptions& window)
    : device_(device),
      shaders_(shaders),
      window_(system, device, beside_a_headset(window)),
      overlay_(window_.make_overlay()),
      frame_(device, vertex_bytes) {
  panel_.visible = false;
}

Mirror::~Mirror() { let_go(); }

Input Mirror::begin(double now_s, const MirrorSettings& settings) {
  if (settings.view != settings_.view) {
    closed_ = cannot_ = false;  // it is asked for anew
    next_s_ = now_s;
    third_drawn_ = false;
    camera_.forget();
  }
  settings_ = settings;
  camera_settings_ = {settings.distance_m, settings.height_m, settings.smooth_s};
  const DisplayFrame window = window_.begin();
  Input input = window_.input();
  if (window.closed && visible_) closed_ = told_closed_ = true;
  if (const bool visible = settings.view != MirrorView::off && !closed_; visible != visible_) {
    visible_ = visible;
    window_.set_visible(visible);
  }
  const bool free = window_.ready(frame_);
  if (outside_ && frame_.ready()) outside_->release();
  due_ = visible_ && free && now_s >= next_s_;
  if (due_) {
    const double period_s = 1.0 / settings.rate_hz;
    next_s_ = next_s_ + period_s > now_s ? next_s_ + period_s : now_s + period_s;  // what came late is not made up for
  }

  if (overlay_->wants_keyboard()) {
    input.pressed.clear();
    input.values = {};
  }
  std::erase_if(input.pressed, [&](const Press& press) {
    if (press.action != Action::menu) return false;
    panel_.visible = !panel_.visible;
    return true;
  });
  if (overlay_->wants_pointer()) input.wheel = 0.0;
  return input;
}

void Mirror::hold_mouse(bool held) {
  mouse_held_ = held;
  window_.hold_mouse(held);
}

VkExtent2D Mirror::third_size() const {
  const glm::dvec2 size = glm::dvec2(window_.size()) * settings_.size;
  return {std::uint32_t(std::max(1.0, std::round(size.x))), std::uint32_t(std::max(1.0, std::round(size.y)))};
}

// Pipelines and images of the view from behind are made beside the frames, when it is first shown or the window has
// another size; until then what was there before is shown.
void Mirror::prepare_third(Experience& experience) {
  if (coming_.valid()) {
    if (coming_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    try {
      outside_ = coming_.get();
      third_drawn_ = false;
    } catch (const Error& fault) {
      fault_ = fault.what();
      cannot_ = true;
    }
    return;
  }
  const VkExtent2D size = third_size();
  if (cannot_ ||
      (outside_ && outside_->picture().spec().width == size.width && outside_->picture().spec().height == size.height))
    return;
  coming_ = std::async(std::launch::async, [this, &experience, size] {
    return std::make_unique<OutsideView>(device_, shaders_, experience, frame_, size);
  });
}

void Mirror::let_go() {
  if (coming_.valid()) coming_.wait();
  coming_ = {};
  outside_.reset();
  third_drawn_ = false;
}

void Mirror::draw_third(const Shown& shown) {
  const TargetSpec& spec = outside_->picture().spec();
  const auto water_at = [&](const glm::dvec3& place) {
    constexpr double footprint_m = 0.5;
    const SeaView water = shown.experience.sea()->view_at(shown.sea_time_s, SeaDetail::felt);
    return water.query({place.x, place.z}, {.footprint_m = footprint_m}).height_m;
  };
  const Pose camera = camera_.pose(water_at(camera_.pose(-1e9).position_m));
  const double fov_deg = shown.experience.scene().settings.render.vertical_fov_deg;
  const View eye{camera, symmetric_fov(fov_deg, double(spec.width) / spec.height)};
  outside_->draw(frame_, shown.experience, {camera, {eye}, pixels_per_radian({eye}, spec.height)});
  third_drawn_ = true;
}

std::vector<WindowPart> Mirror::parts_of(const PictureCopy& copy) const {
  std::vector<WindowPart> parts;
  const glm::ivec2 window = window_.size();
  const auto add = [&](const Image& image, int layer, VkExtent2D size, const PixelBox& to) {
    const glm::ivec2 shown = to.most - to.least;
    if (shown.x < 1 || shown.y < 1) return;
    const PixelBox from = middle_part({int(size.width), int(size.height)}, shown);
    parts.push_back({&image, std::uint32_t(layer), from.least, from.most, to.least, to.most});
  };
  if (shows_third()) {
    const TargetSpec& spec = outside_->picture().spec();
    add(outside_->picture().colour(), 0, {spec.width, spec.height}, {{0, 0}, window});
    return parts;
  }
  if (!copy) return parts;
  for (int eye = 0; eye < copy.views(); ++eye) {
    const MirrorView alone = eye == 0 ? MirrorView::left : MirrorView::right;
    const bool first = settings_.view == MirrorView::third && eye == 0;  // until there is one from behind
    if (settings_.view == MirrorView::both || settings_.view == alone || first)
      add(copy.image(), eye, copy.size(), place_of_eye(settings_.view, eye, window));
  }
  return parts;
}

PanelWish Mirror::draw_widgets(const Shown& shown) {
  overlay_->begin(!mouse_held_);
  const PanelWish wish = panel_.draw(shown.experience.scene().settings, shown.initial, shown.facts);
  if (settings_.overlay) widgets_.draw(shown.facts);
  Panel::draw_message(shown.message);
  overlay_->end();
  return wish;
}

PanelWish Mirror::show(const Shown& shown) {
  if (settings_.view == MirrorView::third) prepare_third(shown.experience);
  const PanelWish wish = draw_widgets(shown);
  frame_.begin();
  if (shows_third()) draw_third(shown);
  window_.show(frame_, parts_of(shown.copy));
  due_ = false;
  return wish;
}

std::optional<Image8> Mirror::third() const {
  if (!shows_third() || !third_drawn_) return std::nullopt;
  const TargetSpec& spec = outside_->picture().spec();
  return read_picture(device_, outside_->picture().colour(), {spec.width, spec.height}, 0);
}

}  // namespace seascape
