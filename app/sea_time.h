// What the sea's time is when a clock says so much: the same for every command, so that whoever has the same clock has the same sea.
#pragma once
#include <chrono>

#include "app/settings.h"

namespace seascape {

// `clock_s`: a path's time, the time since explore began, or where time.follow_clock is set the machine's. time.offset_s is what another clock, such as a server's, says more.
// A scale below 0 runs backwards, of 0 stands still. Everything that feeds sea() knows its state at any time; it is exact to a nanosecond at 1e7 s.
inline double sea_time_s(const Settings& settings, double clock_s) {
  return settings.time_start_s + settings.time_scale * (clock_s + settings.time_offset_s);
}

// The machine's clock: seconds since 1970 began (UTC, leap seconds left out).
inline double machine_clock_s() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

}  // namespace seascape
