// How much of a long test is run: all of it with SEASCAPE_LONG (./check --long), else a sample.
#pragma once
#include <cstddef>
#include <cstdlib>

namespace seascape::test {

inline bool long_run() { return std::getenv("SEASCAPE_LONG") != nullptr; }

// Whether number `n` of a list, from 0, is run: all of them, or one in `each`.
inline bool sampled(std::size_t n, std::size_t each) { return long_run() || n % each == 0; }

}  // namespace seascape::test
