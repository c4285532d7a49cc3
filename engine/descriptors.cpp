#include "engine/descriptors.h"

#include <fcntl.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <limits>
#include <string>
#include <thread>

#include "engine/text.h"

namespace seascape {

namespace fs = std::filesystem;

namespace {

constexpr double patience_s = 1.0;
constexpr int most_links = 40;  // as Linux follows

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// /proc/PID/fd/N at the end of a chain of links.
std::optional<fs::path> descriptor_link(fs::path path) {
  for (int links = 0; links < most_links; ++links) {
    std::error_code fault;
    const fs::path folder = fs::canonical(path.has_parent_path() ? path.parent_path() : fs::path("."), fault);
    if (fault) return std::nullopt;
    if (folder.filename() == "fd" && folder.string().starts_with("/proc/")) return folder / path.filename();
    const fs::path next = fs::read_symlink(path, fault);
    if (fault) return std::nullopt;
    path = next.is_absolute() ? next : folder / next;
  }
  return std::nullopt;
}

// The number of a descriptor of this process.
std::optional<int> own_number(const fs::path& link) {
  const auto number = integer_from(link.filename().string());
  const bool own = link.string().starts_with("/proc/" + std::to_string(getpid()) + "/");
  return own && number && *number <= std::numeric_limits<int>::max() ? std::optional(int(*number)) : std::nullopt;
}

Descriptor duplicate(int number) { return Descriptor(fcntl(number, F_DUPFD_CLOEXEC, 0)); }

const char* kind_of(int descriptor) {
  struct stat status {};
  if (isatty(descriptor)) return "a terminal: end it with Ctrl-D";
  if (fstat(descriptor, &status) == 0 && S_ISFIFO(status.st_mode)) return "a pipe: its writer has not closed it";
  return "no plain file: its end has not come";
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) close(number_);
}

bool leads_to_descriptor(const fs::path& file) { return descriptor_link(file).has_value(); }

Descriptor open_to_read(const fs::path& file) {
  Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (opened || errno != ENXIO) return opened;
  const auto link = descriptor_link(file);  // a socket, which has no name to be opened by
  const auto number = link ? own_number(*link) : std::nullopt;
  if (number) return duplicate(*number);
  errno = ENXIO;
  return opened;
}

Descriptor open_to_write(const fs::path& file) {
  if (const auto link = descriptor_link(file))
    if (const auto number = own_number(*link)) return duplicate(*number);
  const double begun_s = now_s();
  for (bool told = false;;) {
    Descriptor opened(open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK | O_APPEND));
    if (opened) {
      fcntl(opened.number(), F_SETFL, fcntl(opened.number(), F_GETFL) & ~O_NONBLOCK);
      return opened;
    }
    std::error_code ignored;
    if (errno != ENXIO || !fs::is_fifo(file, ignored)) return opened;
    if (!told && now_s() - begun_s >= patience_s) {
      spdlog::info("waiting for a reader of {}, a pipe", file.string());
      told = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

InputWait::InputWait(const fs::path& file, const Descriptor& input)
    : file_(file), input_(input), told_at_s_(now_s() + patience_s) {}

void InputWait::until_ready() {
  for (;;) {
    const double left_s = told_at_s_ - now_s();
    if (left_s <= 0.0) {
      spdlog::info("waiting for {}, {}", file_.string(), kind_of(input_.number()));
      told_at_s_ = std::numeric_limits<double>::infinity();
      continue;
    }
    pollfd one{input_.number(), POLLIN, 0};
    const int wait_ms = left_s > patience_s ? -1 : int(1000.0 * left_s) + 1;
    if (poll(&one, 1, wait_ms) > 0) return;
  }
}

}  // namespace seascape
