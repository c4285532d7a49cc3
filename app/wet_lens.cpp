#include "app/wet_lens.h"

#include <algorithm>

namespace seascape {

void WetLens::step(Sea& sea, const Viewpoint& viewpoint, double lens_m, double time_s, bool in_air) {
  listed_.clear();
  const std::size_t eyes = std::min(viewpoint.eyes.size(), lenses_.size());
  const auto dry = [](const LensDrops& lens) { return !lens.any(); };
  if (in_air && std::all_of(lenses_.begin(), lenses_.end(), dry)) return;
  const SeaView felt = sea.view_at(time_s, SeaDetail::felt);
  for (std::size_t n = 0; n < eyes; ++n) {
    const View& eye = viewpoint.eyes[n];
    const glm::dquat to_eye = glm::conjugate(eye.pose.orientation);
    const glm::dvec3 middle = eye.pose.position_m + eye.pose.orientation * glm::dvec3(0.0, 0.0, -lens_m);
    LensDrops::Moment moment{.time_s = time_s, .fov = eye.fov, .lens_m = lens_m};
    if (!in_air) {
      const QueryAnswer water = felt.query({middle.x, middle.z}, {.history = false});
      moment.wet = !water.clipped && middle.y < water.height_m;
    }
    moment.down = glm::dvec2(to_eye * glm::dvec3(0.0, -1.0, 0.0));
    lenses_[n].step(moment, sea.state().seed, int(n));
    lenses_[n].list(listed_);
  }
}

}  // namespace seascape
