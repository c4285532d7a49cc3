// What the sea's time is when a clock says so much: the same for every command, so that whoever has the same clock has
// the same sea.
#pragma once
#include <algorithm>
#include <chrono>

#include "app/settings.h"

namespace seascape {

// `clock_s`: a path's time, the time since explore began, or where time.follow_clock is set the machine's.
// time.offset_s is what another clock, such as a server's, says more. A scale below 0 runs backwards, of 0 stands
// still. Everything that feeds sea() knows its state at any time; it is exact to a nanosecond at 1e7 s.
inline double sea_time_s(const Settings& settings, double clock_s) {
  return settings.time_start_s + settings.time_scale * (clock_s + settings.time_offset_s);
}

// The machine's clock: seconds since 1970 began (UTC, leap seconds left out).
inline double machine_clock_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

// Frame i of those that a capture draws. The first `warmup` do not count and lead up to the path's beginning, where the
// viewer waits: what is simulated steps on from them into the frames that count. (When time went back there, the first
// that counts had to settle the foam anew: 0.7 s in a storm.)
struct CaptureMoment {
  int number;          // of the path; below 0 it does not count
  double path_time_s;  // 0 at the path's beginning
  double before_s;     // to be added to the path's scene time: below 0 before its beginning
};
inline CaptureMoment capture_moment(int i, int warmup, double fps) {
  const int number = i - warmup;
  return {number, number / fps, std::min(number, 0) / fps};
}

}  // namespace seascape
