#include "ocean/mesh/near_reaches.h"

#include <cmath>

namespace seascape {

void NearReaches::set(std::span<const NearMeshError> near, double over_m) {
  near_.clear(), ends_.clear();
  for (const NearMeshError& one : near) {
    const double from_m = one.from_m > 0.0 ? std::hypot(one.from_m, over_m) : 0.0,
                 reach_m = std::hypot(one.reach_m, over_m);
    near_.push_back({one.error, from_m, reach_m, one.shares, 0.0});
    ends_.insert(ends_.end(), {from_m, reach_m});
  }
  std::sort(ends_.begin(), ends_.end());
}

}  // namespace seascape
