// Progress on a terminal for whatever takes over a second.
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace seascape {

// Writes "LABEL 40 %" over itself on stderr, where that is a terminal, once the work has taken a second; wipes it at the end.
class Progress {
 public:
  Progress(std::string label, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void done(std::size_t count);  // of `total`, so far

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  std::size_t total_;
  bool on_terminal_;
  Clock::time_point next_;  // when to write again
  bool written_ = false;
};

}  // namespace seascape
