// Memory of a thread for kernels.
#pragma once
#include <tbb/cache_aligned_allocator.h>

#include <cstddef>
#include <vector>

namespace seascape {

// That many floats of the thread's own, from the beginning of a cache line, so that they stay in its core's caches from
// one piece of work to the next: what is in them is anybody's, and nobody's after the kernel that asked.
inline float* thread_scratch(std::size_t floats) {
  thread_local std::vector<float, tbb::cache_aligned_allocator<float>> memory;
  if (memory.size() < floats) memory.resize(floats);
  return memory.data();
}

}  // namespace seascape
