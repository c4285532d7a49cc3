// What actors make in steps of the sea, kept for whoever is stepped at its own times.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace seascape {

// What is made in a step counts from the step's end on for as long as it was, so that all of it is known in any frame
// at or after a time that is asked for.
template <class T>
class StepMade {
 public:
  // Adds to the step that runs.
  void add(const T& made) { kept_.push_back({0.0, 0.0, made}); }
  std::size_t in_step() const { return kept_.size() - ended_; }
  // The step ends, at end_s, that was length_s long.
  void end_step(double end_s, double length_s) {
    for (; ended_ < kept_.size(); ++ended_) kept_[ended_].end_s = end_s, kept_[ended_].length_s = length_s;
  }
  // Steps are missing: what was before is no more.
  void clear() {
    kept_.clear();
    ended_ = 0;
  }
  // Steps that ended before this time are not asked for any more.
  void forget_before(double time_s) {
    const auto first = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.end_s >= time_s; });
    ended_ -= std::size_t(first - kept_.begin());
    kept_.erase(kept_.begin(), first);
  }
  // Calls each(made, seconds of it between the two times), in the order of steps.
  template <class Each>
  void between(double from_s, double to_s, const Each& each) const {
    constexpr double least_s = 1e-6;  // less is what sums of times are off by
    for (const Kept& kept : kept_) {
      const double for_s = std::min(to_s, kept.end_s + kept.length_s) - std::max(from_s, kept.end_s);
      if (for_s > least_s) each(kept.made, for_s);
    }
  }

 private:
  struct Kept {
    double end_s, length_s;
    T made;
  };
  std::vector<Kept> kept_;  // in order of their steps
  std::size_t ended_ = 0;   // how many of them are of steps that have ended
};

}  // namespace seascape
