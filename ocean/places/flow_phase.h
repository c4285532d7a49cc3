// Two patterns of waves that a flow carries in turn (shaders/lib/flow.glsl): how long each has been on its way, and
// what it counts for.
#pragma once
#include <cmath>

namespace seascape {

struct FlowPhase {
  double first_s, second_s;  // since each was where it belongs, from - period / 2 to period / 2
  double first;              // the first one's share; the second has the rest: none of a pattern at the ends of its way
};

// Of a period above 0. A time that is no number counts as 0.
inline FlowPhase flow_phase(double time_s, double period_s) {
  const double turns = std::isfinite(time_s / period_s) ? time_s / period_s : 0.0;
  const double first = turns - std::floor(turns), second = turns + 0.5 - std::floor(turns + 0.5);
  return {(first - 0.5) * period_s, (second - 0.5) * period_s, 1.0 - std::abs(2.0 * first - 1.0)};
}

}  // namespace seascape
