#include "engine/address_space.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cstddef>
#include <thread>
#include <utility>

#include "engine/error.h"

namespace seascape {

namespace {
// Mesa 25's software driver starts with 700 to 900 MiB on two processors, and has a thread for each more.
constexpr std::size_t start_mib = 1024, thread_mib = 16;
}  // namespace

void expect_address_space() {
  const std::size_t least_mib = start_mib + thread_mib * std::thread::hardware_concurrency();
  const std::size_t bytes = least_mib << 20;
  void* const reserved =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (reserved != MAP_FAILED) {
    munmap(reserved, bytes);
    return;
  }
  for (const auto& [number, option] : {std::pair{RLIMIT_AS, "ulimit -v"}, std::pair{RLIMIT_DATA, "ulimit -d"}}) {
    rlimit limit{};
    if (getrlimit(number, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) continue;
    throw Error("memory",
                fmt::format("a limit of {} MiB ({}) leaves less than the {} MiB that a Vulkan driver needs to start",
                            limit.rlim_cur >> 20, option, least_mib),
                fmt::format("raise it: {} unlimited", option));
  }
  throw Error("memory", fmt::format("the system refuses the {} MiB that a Vulkan driver needs to start", least_mib),
              "close other programs");
}

}  // namespace seascape
