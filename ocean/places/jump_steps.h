// How many steps what is simulated takes over a jump of the time where it goes on from what is there (Sea::go_on).
#pragma once
#include <cstdint>
#include <cstdlib>

namespace seascape {

// From the last step to the tick that is now: as many as have gone, either way, for time that runs backwards; one, so
// that all is of the new time, if that is more than half a second.
inline std::int64_t jump_steps(std::int64_t last, std::int64_t now, double rate_hz) {
  const std::int64_t gone = std::abs(now - last);
  return double(gone) <= 0.5 * rate_hz ? gone : 1;
}

}  // namespace seascape
