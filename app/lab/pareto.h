// Which settings no other beats in both time and error.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace seascape {

struct Tradeoff {
  double time = 0.0, error = 0.0;  // both finite and not negative; less is better
};

// Indices of those that no other beats, ascending in time: no other takes as long or less, with as little error or
// less, and is better in one of the two. Of equal ones the first.
std::vector<std::size_t> pareto_front(std::span<const Tradeoff> points);

// How many times as long a point takes as the quickest of the others that errs no more; 1 where none is quicker.
// Infinite where one takes no time.
double off_front(const Tradeoff& point, std::span<const Tradeoff> others);

// Indices, ascending, of those that take at most `times` as long as the quickest that errs no more: at 1 the front and
// its equals.
std::vector<std::size_t> near_front(std::span<const Tradeoff> points, double times);

}  // namespace seascape
