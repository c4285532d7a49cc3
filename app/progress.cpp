#include "app/progress.h"

#include <unistd.h>

#include <cstdio>

namespace seascape {

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)), total_(total), on_terminal_(isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + std::chrono::seconds(1)) {}

Progress::~Progress() {
  if (written_) std::fprintf(stderr, "\r\x1b[K");
}

void Progress::done(std::size_t count) {
  if (!on_terminal_ || Clock::now() < next_) return;
  next_ = Clock::now() + std::chrono::milliseconds(200);
  written_ = true;
  const double percent = total_ > 0 ? 100.0 * static_cast<double>(count) / static_cast<double>(total_) : 0.0;
  std::fprintf(stderr, "\r%s %.0f %%\x1b[K", label_.c_str(), percent);
}

}  // namespace seascape
