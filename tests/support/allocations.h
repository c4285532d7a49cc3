// Counts the heap allocations that the project's own code makes on this thread. Linking allocations.cpp replaces the
// global operator new of the whole test program.
#pragma once
#include <cstdint>

// The sanitizers have an operator new of their own: built with them, nothing counts.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SEASCAPE_COUNTS_ALLOCATIONS 0
#elif defined(__has_feature)
#define SEASCAPE_COUNTS_ALLOCATIONS !(__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define SEASCAPE_COUNTS_ALLOCATIONS 1
#endif

namespace seascape::test {

// While it lives, allocations by operator new on this thread count, if the code that asked for them is this
// executable's: directly, or through the C++ library, fmt, spdlog or TBB. What the driver and the Vulkan loader take
// for themselves is not ours and does not count; nor does malloc, which our code never calls.
class AllocationCounter {
 public:
  static constexpr bool counts = SEASCAPE_COUNTS_ALLOCATIONS;
  AllocationCounter();
  ~AllocationCounter();
  AllocationCounter(const AllocationCounter&) = delete;
  AllocationCounter& operator=(const AllocationCounter&) = delete;
  std::uint64_t ours() const;
  std::uint64_t others() const;
};

}  // namespace seascape::test
