#include "app/progress.h"

#include <unistd.h>

#include <cstdio>

namespace seascape {

namespace {
constexpr std::chrono::seconds pause{1};
}

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), on_terminal_(isatty(STDERR_FILENO) == 1), next_(Clock::now() + pause) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void Progress::step(std::size_t done) {
  if (stop_is_asked()) throw_if_stopped(what_ + " " + std::to_string(done) + "/" + std::to_string(total_));
  if (!on_terminal_ || Clock::now() < next_) return;
  next_ = Clock::now() + pause;
  shown_ = true;
  std::fprintf(stderr, "\r%s %zu/%zu\x1b[K", what_.c_str(), done, total_);
}

}  // namespace seascape
