// Progress of whatever takes over a second: told on a terminal, and ended by a signal between two steps.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

#include "engine/signals.h"

namespace seascape {

// Writes "replay: frame 12/90" over itself on stderr, where that is a terminal, once a second at most and not in the
// first; wipes it at the end.
class Progress {
 public:
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step(std::size_t done);  // of `total`, so far; throws where a signal asks to stop (throw_if_stopped)

 private:
  using Clock = std::chrono::steady_clock;

  StopLater between_steps_;
  std::string what_;
  std::size_t total_;
  bool on_terminal_;
  bool shown_ = false;
  Clock::time_point next_;
};

}  // namespace seascape
