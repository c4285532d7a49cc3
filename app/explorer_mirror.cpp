// Explore's desk: the mirror of a headset, what is done there, and what it shows.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>

#include "app/explorer.h"
#include "app/mirror_layout.h"
#include "engine/error.h"

namespace seascape {

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

// Opens the mirror where it is asked for, and takes what is done at it as if it were done with the headset.
void Explorer::serve_desk() {
  if (!desktop_) return;
  const MirrorSettings& wanted = settings().mirror;
  if (!mirror_) {
    if (wanted.view == MirrorView::off) return;
    try {
      mirror_ = std::make_unique<Mirror>(*desktop_, *program_.device, program_.shaders, WindowOptions{});
      mirror_->set_title("Seascape: " + program_.scene.title);
    } catch (const Error& fault) {
      spdlog::warn("no mirror on the desktop: {}", fault.what());
      desktop_ = nullptr;
      return;
    }
  }
  input_ = joined(input_, mirror_->begin(seconds(), wanted));
  if (mirror_->take_closed()) tell("mirror: closed; the action mirror, or another mirror.view, opens it again");
  if (const auto fault = mirror_->take_fault()) tell_fault("no view from behind: " + *fault);
}

void Explorer::next_mirror_view() {
  if (!desktop_) return;
  if (mirror_ && mirror_->closed()) {
    mirror_->open();
    tell("mirror: open");
    return;
  }
  Settings changed = asked();
  changed.mirror.view = next_view(changed.mirror.view);
  ask(changed);
  tell("mirror: " + value_text(changed, *find_setting("mirror.view")));
}

// After the frame has been ended, of `dt_s` seconds.
void Explorer::show_desk(const DisplayFrame& shown, double dt_s) {
  if (shown.should_render) {
    mirror_->follow(head(), dt_s);
    mirror_->note(cpu_ms_, experience_->frame().gpu_ms());
  }
  if (!mirror_->due()) return;
  const PanelFacts now = facts(shown);
  obey(mirror_->show({copy_, *experience_, sea_time_s(), program_.scene.settings, now,
                      now_s_ < message_until_s_ || loader_.busy() ? message_ : std::string_view{}}));
}

}  // namespace seascape
