// Any words, each ended by a zero byte, as the command line: understood or refused with exit code 2.
#include "app/arguments.h"
#include "tests/fuzz/fuzz.h"

using namespace seascape;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> words;
  std::string_view rest = fuzz::text_of(data, size);
  while (!rest.empty()) {
    const std::size_t end = rest.find('\0');
    words.emplace_back(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  }
  fuzz::reads([&] {
    try {
      const Arguments arguments = parse_arguments(words);
      fuzz::require(arguments.width >= 0 && arguments.width <= 16384 && arguments.height <= 16384,
                    "sizes are in range");
      fuzz::require(arguments.fps >= 0.1 && arguments.fps <= 1000.0, "rates are in range");
      fuzz::require((arguments.command == Command::text) == !arguments.text.empty(), "help has a text");
    } catch (const Error& fault) {
      fuzz::require(fault.exit_code() == 2, "a wrong command line is wrong usage");
      throw;
    }
  });
  return 0;
}
