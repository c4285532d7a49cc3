// Memory for large tables that are read without order: on pages of 2 MiB where the system has them.
#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace seascape {

// An allocator for containers. A page's address is looked up in a table of some thousand entries at most: tiles of 30
// MiB on pages of 4 KiB pass it by far. What the system does not grant costs speed alone.
template <typename T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <typename U>
  LargePages(const LargePages<U>&) {}
  T* allocate(std::size_t count) {
    constexpr std::size_t page = std::size_t(2) << 20, line = 64;
    const std::size_t unit = count * sizeof(T) >= page ? page : line;
    const std::size_t bytes = (count * sizeof(T) + unit - 1) / unit * unit;
    void* memory = bytes / sizeof(T) < count ? nullptr : std::aligned_alloc(unit, bytes);
    if (memory == nullptr) throw std::bad_alloc();
    if (unit == page) madvise(memory, bytes, MADV_HUGEPAGE);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  bool operator==(const LargePages&) const { return true; }
};

}  // namespace seascape
