// The program: reads the command line, runs the command, and turns every fault into one line and an exit status.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "engine/error.h"
#include "engine/signals.h"

namespace {

using namespace seascape;

int run(const Arguments& arguments) {
  switch (arguments.command) {
    case Command::text:
      std::fwrite(arguments.text.data(), 1, arguments.text.size(), stdout);
      return 0;
    case Command::explore:
      return run_explore(arguments);
    case Command::replay:
      return run_replay(arguments);
    case Command::capture:
      return run_capture(arguments);
    case Command::lab:
      return run_lab(arguments);
    case Command::bake:
      return run_bake(arguments);
    case Command::plan:
      return run_plan(arguments);
    case Command::query:
      return run_query(arguments);
    case Command::validate:
      return run_validate(arguments);
    case Command::doctor:
      return run_doctor(arguments);
  }
  return 2;
}

// Whether pthread_create() had no room: std::thread says it by a code, oneTBB by a text alone.
bool is_of_threads(const std::exception& fault) {
  const auto* const coded = dynamic_cast<const std::system_error*>(&fault);
  return (coded != nullptr && coded->code() == std::errc::resource_unavailable_try_again) ||
         std::string_view(fault.what()).starts_with("pthread_create has failed");
}

int report(const std::string& line, int exit_code) {
  std::fprintf(stderr, "seascape: %s\n", line.c_str());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  take_signals();
  try {
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    const Arguments arguments = parse_arguments(words);
    spdlog::set_default_logger(spdlog::stderr_color_st("seascape"));
    spdlog::set_pattern("%l: %v");
    spdlog::set_level(spdlog::level::from_str(arguments.log_level));
    const int exit_code = run(arguments);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw Error("standard output", "it cannot be written to", "check the disk or the pipe it goes to");
    return exit_code;
  } catch (const Error& fault) {
    report(fault.what(), fault.exit_code());
    if (fault.exit_code() > 128) end_by_signal(fault.exit_code() - 128);
    return fault.exit_code();
  } catch (const std::bad_alloc&) {
    return report("out of memory; close other programs, or take a smaller --size or a lower --preset", 1);
  } catch (const std::exception& fault) {
    if (is_of_threads(fault))
      return report("no more threads can be made; close other programs, or raise the limit (ulimit -u)", 1);
    return report(std::string("unexpected fault: ") + fault.what() + "; please report it with the command line", 1);
  }
}
