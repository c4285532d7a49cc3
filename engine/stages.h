// How long the processor takes for the stages of a frame, by name.
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>

namespace seascape {

struct StageTime {
  const char* name;  // outlives it: a literal
  double ms;
};

// Stages do not nest: together they are no longer than the frame. A name that comes again adds to its time. No
// allocation.
class Stages {
 public:
  static constexpr std::size_t most = 24;

  void clear() { count_ = 0; }
  // Runs `work`, whose time is the stage's. More names than `most` throw std::length_error.
  template <class Work>
  void time(const char* name, Work&& work) {
    const auto begun = std::chrono::steady_clock::now();
    work();
    of(name).ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
  }
  // In the order in which they first ran.
  std::span<const StageTime> times() const { return {times_.data(), count_}; }

 private:
  StageTime& of(const char* name) {
    for (std::size_t i = 0; i < count_; ++i)
      if (std::strcmp(times_[i].name, name) == 0) return times_[i];
    if (count_ == most) throw std::length_error("a frame has more stages than Stages::most");
    return times_[count_++] = {name, 0.0};
  }
  std::array<StageTime, most> times_{};
  std::size_t count_ = 0;
};

}  // namespace seascape
