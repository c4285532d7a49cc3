#include "tests/support/allocations.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

namespace seascape::test {

namespace {

thread_local bool counting = false, looking = false;
thread_local std::uint64_t our_count = 0, other_count = 0;

enum class Owner { ours, passes_on, other };

// By the object that the address lies in. _dl_find_object (glibc 2.35) is fast; dladdr would search the symbols of LLVM
// for each of the driver's allocations.
Owner owner_of(void* address) {
  static const link_map* const own = [] {
    dl_find_object self{};
    return _dl_find_object(reinterpret_cast<void*>(&owner_of), &self) == 0 ? self.dlfo_link_map : nullptr;
  }();
  dl_find_object object{};
  if (_dl_find_object(address, &object) != 0) return Owner::other;
  if (object.dlfo_link_map == own) return Owner::ours;
  for (const char* library : {"libstdc++", "libfmt", "libspdlog", "libtbb", "libc.so"})
    if (std::strstr(object.dlfo_link_map->l_name, library)) return Owner::passes_on;
  return Owner::other;
}

// The first caller that does not just pass the wish on is who allocates.
void note(void* caller) {
  if (!counting || looking) return;
  looking = true;
  Owner owner = owner_of(caller);
  if (owner == Owner::passes_on) {
    void* frames[32];
    const int depth = backtrace(frames, 32);
    for (void** at = std::find(frames, frames + depth, caller); at != frames + depth && owner == Owner::passes_on; ++at)
      owner = owner_of(*at);
  }
  ++(owner == Owner::ours ? our_count : other_count);
  looking = false;
}

[[maybe_unused]] void* take(std::size_t bytes, std::size_t alignment, void* caller) {
  note(caller);
  bytes = std::max<std::size_t>(bytes, 1);
  void* memory = alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__
                     ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)
                     : std::malloc(bytes);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

AllocationCounter::AllocationCounter() {
  void* frames[4];
  backtrace(frames, 4);  // its first call loads a library
  our_count = other_count = 0;
  counting = true;
}
AllocationCounter::~AllocationCounter() { counting = false; }
std::uint64_t AllocationCounter::ours() const { return our_count; }
std::uint64_t AllocationCounter::others() const { return other_count; }

}  // namespace seascape::test

#if SEASCAPE_COUNTS_ALLOCATIONS
void* operator new(std::size_t bytes) { return seascape::test::take(bytes, 0, __builtin_return_address(0)); }
void* operator new[](std::size_t bytes) { return seascape::test::take(bytes, 0, __builtin_return_address(0)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return seascape::test::take(bytes, std::size_t(alignment), __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return seascape::test::take(bytes, std::size_t(alignment), __builtin_return_address(0));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
#endif
