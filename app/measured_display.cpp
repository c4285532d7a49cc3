#include "app/measured_display.h"

#include "platform/headset.h"

namespace seascape {

MeasuredDisplay::MeasuredDisplay(DisplayKind kind, DeviceOptions& options) {
  if (kind == DisplayKind::window) {
    windows_.emplace();
    options.present = true;
    options.instance_extensions = windows_->instance_extensions();
  }
  if (kind == DisplayKind::simulated) {
    SimulatedOptions simulated;
    simulated.ends = false;
    runtime_.emplace(simulated);
    system_.emplace(runtime_->get(), runtime_->next());
    system_->make_device(options);
  }
}

std::unique_ptr<Display> MeasuredDisplay::make(Device& device, const HeadlessOptions& shown, const Settings& settings,
                                               const glm::uvec2& size) {
  if (system_) {
    HeadsetOptions options;
    options.near_m = settings.render.near_m;
    options.in_real_time = false;
    options.symmetric = settings.headset.symmetric;
    options.scale = settings.headset.scale;
    options.rate_hz = settings.headset.rate_hz;
    options.width = size.x;
    options.height = size.y;
    return std::make_unique<Headset>(*system_, device, options);
  }
  if (!windows_) return std::make_unique<Headless>(shown);
  WindowOptions options;
  options.title = "Seascape: capture";
  options.width = shown.width;
  options.height = shown.height;
  options.views = shown.views;
  auto window = std::make_unique<Window>(*windows_, device, options);
  window->set_lens(shown.vertical_fov_deg, shown.eye_distance_m);
  return window;
}

void suit_display(ExperienceOptions& options, const Display& display) {
  options.colour = display.colour();
  options.show_depth = display.shows_depth();
  options.most_width = display.most_size().x;
  options.most_height = display.most_size().y;
  options.hidden = display.hidden() != nullptr;
}

Pose carrier_for(const Display& display, const Pose& head) {
  if (!display.tracks_head()) return head;
  (void)display.viewpoint({});  // which finds the head
  return composed(head, inverse(display.head().value_or(Pose{})));
}

}  // namespace seascape
