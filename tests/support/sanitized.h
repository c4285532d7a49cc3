// Whether this is a build of a sanitizer, which takes ten times as long: what is counted in thousands is sampled there,
// and counted in the release build.
#pragma once
#include "tests/support/allocations.h"

namespace seascape::test {

inline constexpr bool sanitized = !AllocationCounter::counts;

}  // namespace seascape::test
