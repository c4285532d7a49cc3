#include "app/eye_crossings.h"

#include <algorithm>
#include <utility>

namespace seascape {

void EyeCrossings::step(double time_s, std::span<const std::optional<double>> depths_m) {
  if (before_s_ && !(time_s > *before_s_)) return;
  constexpr double far_m = 1.0;  // farther off it counts as this far
  for (std::size_t n = 0; n < std::min(depths_m.size(), eyes_.size()); ++n) {
    Eye& eye = eyes_[n];
    const double depth_m = std::clamp(depths_m[n].value_or(-far_m), -far_m, far_m);
    if (!before_s_ || !eye.known) {
      eye = {true, depth_m > 0.0, depth_m, std::nullopt};
      continue;
    }
    // Metres beyond the surface on the side where it is not yet, now and before.
    const double side = eye.in ? -1.0 : 1.0, now_m = side * depth_m - past_m, then_m = side * eye.depth_m - past_m;
    eye.depth_m = depth_m;
    if (now_m <= 0.0) {
      eye.beyond_s.reset();
      continue;
    }
    if (!eye.beyond_s)
      eye.beyond_s = then_m >= 0.0 ? *before_s_ : *before_s_ + (time_s - *before_s_) * then_m / (then_m - now_m);
    if (time_s - *eye.beyond_s < hold_s) continue;
    eye.in = !eye.in;
    events_.push_back({*eye.beyond_s, n, eye.in});
    eye.beyond_s.reset();
  }
  before_s_ = time_s;
}

std::vector<EyeEvent> EyeCrossings::take_events() {
  std::stable_sort(events_.begin(), events_.end(),
                   [](const EyeEvent& a, const EyeEvent& b) { return a.time_s < b.time_s; });
  return std::exchange(events_, {});
}

}  // namespace seascape
