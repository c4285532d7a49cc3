#include "ocean/sea/actor_spray.h"

#include <cmath>

namespace seascape {

bool ActorSpray::add(const SprayThrow& t) {
  const auto within = [](double value, double least, double most) { return value >= least && value <= most; };
  for (int axis = 0; axis < 3; ++axis)
    if (!within(t.at_m[axis], -1e7, 1e7) || !within(t.velocity_mps[axis], -100.0, 100.0)) return false;
  if (throws_.in_step() == most_spray_throws || !within(t.spread_mps, 0.0, 100.0) ||
      !within(t.per_s, 0.0, most_thrown_per_s) || !within(t.width_m, 0.0, 100.0) || !within(t.coarse, 0.0, 1.0))
    return false;
  if (t.per_s > 0.0) throws_.add(t);
  return true;
}

}  // namespace seascape
