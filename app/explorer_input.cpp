// What explore does with what is asked for at once.
#include "app/explorer.h"

namespace seascape {

void Explorer::obey(const Input& input) {
  if (types()) return;
  for (const auto& [action, value] : input.pressed) switch (action) {
      case Action::fly:
        set_travel(Travel::fly);
        break;
      case Action::walk:
        set_travel(Travel::walk);
        break;
      case Action::ride:
        set_travel(Travel::ride);
        break;
      case Action::board:
        board();
        break;
      case Action::moor:
      case Action::anchor:
      case Action::respawn:
        work_boat(action);
        break;
      case Action::pause:
        toggle_pause();
        break;
      case Action::time_scale:
        scale_time(value < 0.0 ? 0.5 : 2.0);
        break;
      case Action::scrub:
        scrub((input.held(Action::fast) ? 10.0 : 1.0) * value);
        break;
      case Action::debug_view:
        next_debug_view();
        break;
      case Action::menu:
        panel_.visible = !panel_.visible;
        break;
      case Action::screenshot:
        screenshot_wanted_ = true;
        break;
      case Action::record:
        toggle_recording();
        break;
      case Action::mirror:
        next_mirror_view();
        break;
      case Action::comfort:
        toggle_comfort();
        break;
      case Action::light:
        toggle_light();
        break;
      case Action::recentre:
        display_.recentre();
        break;
      case Action::look:
        look_by_key_ = !look_by_key_;
        break;
      case Action::leave:
        if (look_by_key_)
          look_by_key_ = false;
        else
          leave();
        break;
      default:
        break;  // held to move, or for what no scene has yet
    }
}

}  // namespace seascape
