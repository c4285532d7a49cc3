#include "engine/signals.h"

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "engine/error.h"

namespace seascape {

namespace {

constexpr std::string_view remedy = "files that it has written are whole; run it again for the rest";

struct Stop {
  int number;
  std::string_view name;
};
constexpr std::array stops{Stop{SIGINT, "SIGINT"}, Stop{SIGTERM, "SIGTERM"}, Stop{SIGHUP, "SIGHUP"},
                           Stop{SIGQUIT, "SIGQUIT"}, Stop{SIGXCPU, "SIGXCPU"}};

std::atomic<int> postponed{0};  // objects of StopLater
std::atomic<int> asked_by{0};   // the signal; 0: none yet
std::atomic<bool> obeyed{false};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not wait for a lock");

// What the program or its driver dies of.
constexpr std::array crashes{Stop{SIGSEGV, "SIGSEGV"}, Stop{SIGBUS, "SIGBUS"}, Stop{SIGILL, "SIGILL"},
                             Stop{SIGFPE, "SIGFPE"}, Stop{SIGABRT, "SIGABRT"}};
struct Limit {
  int kind;
  rlim_t enough;  // from here on it is none
  std::string_view what;
};
constexpr std::string_view of_memory =
    ", with a limit on its memory; raise the limit (ulimit -v, ulimit -d), or take a smaller --size or a lower "
    "--preset\n";
// What drivers and libraries do not survive: their allocations fail, their threads or files get no room.
constexpr std::array limits{
    Limit{RLIMIT_AS, RLIM_INFINITY, of_memory}, Limit{RLIMIT_DATA, RLIM_INFINITY, of_memory},
    Limit{RLIMIT_STACK, rlim_t{1} << 20, ", with a limit on its stack; raise the limit (ulimit -s)\n"},
    Limit{RLIMIT_FSIZE, rlim_t{1} << 30,
          ", with a limit on the size of files, in which a driver keeps memory; raise the limit (ulimit -f)\n"}};
std::string_view limited;               // the first limit in force, as a message ends
std::array<char, 1 << 16> crash_stack;  // for when the stack is what cannot grow

std::string_view name_of(int number) {
  for (const Stop& crash : crashes)
    if (crash.number == number) return crash.name;
  for (const Stop& stop : stops)
    if (stop.number == number) return stop.name;
  return "a signal";
}

void say(std::string_view text) { (void)!write(STDERR_FILENO, text.data(), text.size()); }

// Only calls that a signal handler may make (POSIX, async-signal-safe).
[[noreturn]] void end_with_line(int number) {
  say("seascape: stopped by ");
  say(name_of(number));
  say("; ");
  say(remedy);
  say("\n");
  end_by_signal(number);
}

void on_signal(int number) {
  const int kept = errno;
  int none = 0;
  if (postponed == 0 || !asked_by.compare_exchange_strong(none, number)) end_with_line(number);
  errno = kept;
}

// Under a limit that is what killed the program, and no core of it is of use.
void on_crash(int number) {
  say("seascape: crashed by ");
  say(name_of(number));
  say(limited.empty() ? ", in the program or in its driver; please report it with the command line\n" : limited);
  if (!limited.empty()) _exit(1);
  end_by_signal(number);
}

void take_crashes() {
  for (const Limit& limit : limits) {
    rlimit now{};
    const auto kind = static_cast<__rlimit_resource_t>(limit.kind);
    if (limited.empty() && getrlimit(kind, &now) == 0 && now.rlim_cur < limit.enough) limited = limit.what;
  }
  if (!limited.empty()) std::set_terminate(std::abort);  // an exception that crosses C: one line, and not three
  stack_t stack{};
  stack.ss_sp = crash_stack.data();
  stack.ss_size = crash_stack.size();
  sigaltstack(&stack, nullptr);
  struct sigaction taken {};
  taken.sa_handler = on_crash;
  taken.sa_flags = SA_ONSTACK;
  sigemptyset(&taken.sa_mask);
  for (const Stop& crash : crashes) sigaction(crash.number, &taken, nullptr);
}

}  // namespace

void take_signals() {
  take_crashes();
  struct sigaction taken {};
  taken.sa_handler = on_signal;
  taken.sa_flags = SA_RESTART;
  sigemptyset(&taken.sa_mask);
  for (const Stop& stop : stops) {
    struct sigaction before {};
    if (sigaction(stop.number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(stop.number, &taken, nullptr);
  }
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

StopLater::StopLater() { ++postponed; }

StopLater::~StopLater() {
  if (--postponed == 0 && asked_by != 0 && !obeyed && std::uncaught_exceptions() == 0) end_with_line(asked_by);
}

bool stop_is_asked() { return asked_by != 0; }

void throw_if_stopped(const std::string& where) {
  if (asked_by == 0 || obeyed.exchange(true)) return;
  throw Error(where, "stopped by " + std::string(name_of(asked_by)), std::string(remedy), 128 + asked_by);
}

void end_by_signal(int number) {
  signal(number, SIG_DFL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, number);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  raise(number);
  _exit(128 + number);
}

}  // namespace seascape
