// Which settings no other beats in both time and error.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace seascape {

struct Tradeoff {
  double time = 0.0, error = 0.0;  // both finite and not negative; less is better
};

// Indices of those that no other beats, ascending in time: no other takes as long or less, with as little error or less, and is better in one of the two. Of equal ones
// the first.
std::vector<std::size_t> pareto_front(std::span<const Tradeoff> points);

// By which factor a point has to be better, in time and in error both, for no other to beat it: 1 on the front (the multiplicative epsilon of Zitzler et al. 2003,
// "Performance assessment of multiobjective optimizers", eq. 4, of one point against a set). Infinite where another takes no time and makes no error.
double off_front(const Tradeoff& point, std::span<const Tradeoff> others);

}  // namespace seascape
