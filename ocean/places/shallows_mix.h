// What a bed makes of the waves while one sea becomes another: of both a share.
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>

#include "ocean/places/shallows.h"

namespace seascape {

// Of two seas over one bed. Shares and shifts go straight from one to the other, and a shift's direction turns the
// shorter way, so that nothing jumps where `share` does not. Null where no bed is known.
struct ShallowsMix {
  std::shared_ptr<const Shallows> from, to;  // `to`: null but in a change
  double share = 0.0;                        // of `to`

  explicit operator bool() const { return from != nullptr; }
  double bed_m(glm::dvec2 place_m, double footprint_m, double time_s) const {
    return from->bed_m(place_m, footprint_m, time_s);
  }
  PlaceWaves waves(glm::dvec2 place_m, double depth_m) const;
  double surf(glm::dvec2 place_m, double depth_m) const;
  Shallows::Placed placed(glm::dvec2 place_m, double depth_m) const;
  glm::dvec2 direction(int cascade) const;
  double run_up_m() const {
    return to == nullptr ? from->run_up_m() : std::lerp(from->run_up_m(), to->run_up_m(), share);
  }
  double most_share() const {
    return to == nullptr ? from->most_share() : std::lerp(from->most_share(), to->most_share(), share);
  }
};

}  // namespace seascape
