// What every fuzz target asks of a reader: it returns, or throws an Error that is one clear line. Seen to be caught:
// line breaks passed through in_quotes (command_line), no bound on coordinates (csv), no lower bound of settings
// (scene), six digits in a written path (camera_path), spans with both of their ends (input_script), seas written
// without quotes (curves).
#pragma once
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "engine/error.h"

namespace seascape::fuzz {

inline void require(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

// Runs `read`; any exception but an Error of one line with a remedy ends the run. Returns whether nothing was thrown.
template <class Read>
bool reads(Read&& read) {
  try {
    read();
    return true;
  } catch (const Error& fault) {
    const std::string_view line = fault.what();
    require(line.find('\n') == std::string_view::npos && line.find('\0') == std::string_view::npos,
            "an error is one line");
    require(line.size() < 4000, "an error is short");
    require(!fault.fault().empty() && !fault.remedy().empty(), "an error says what is wrong and what to do");
    require(fault.exit_code() == 1 || fault.exit_code() == 2, "the exit code is 1 or 2");
    return false;
  }
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace seascape::fuzz
