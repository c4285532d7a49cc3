// Signals that end the program: a line on standard error, no half-written file, and time to keep what a run has made.
#pragma once
#include <string>

namespace seascape {

// For main, before there is a second thread. SIGINT, SIGTERM and SIGHUP then end the program with a line; one that was
// ignored, as nohup does with SIGHUP, stays ignored. SIGPIPE and SIGXFSZ become errors of the write that met them. A
// crash, of a driver say, is told with a line; where memory is limited (ulimit -v) it is a fault with exit status 1.
void take_signals();

// While one lives, the first such signal only asks to stop, and throw_if_stopped() obeys it; a second one ends the
// program at once. If nobody has obeyed when the last of them goes, the program ends there.
class StopLater {
 public:
  StopLater();
  ~StopLater();
  StopLater(const StopLater&) = delete;
  StopLater& operator=(const StopLater&) = delete;
};

bool stop_is_asked();
// Throws Error(`where`, "stopped by SIGTERM", ...) with exit code 128 + the signal, once.
void throw_if_stopped(const std::string& where);
// Ends the process by the signal, so that a shell sees that it was stopped.
[[noreturn]] void end_by_signal(int signal);

}  // namespace seascape
