// What every report of measurements has: the machine that measured, and the page around it. One self-contained page: no
// script, no network, light and dark.
#pragma once
#include <cstdint>
#include <string>

namespace seascape {

struct Machine {
  std::string device, driver, cpu;
  int cores = 0;
  std::string build, date;  // build: version and configuration
  std::uint64_t seed = 0;
};

// Whether the device draws on the processor.
bool software(const Machine& machine);

// Colours of pages and of plots in files of their own.
inline constexpr const char* page_colours = R"(
:root{--page:#fbfcfd;--ink:#1b2530;--quiet:#5a6875;--line:#d5dce2;--good:#0b6e4f;--fair:#8a5a00;--bad:#b3261e;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#9c4f96;--c4:#b07d00;--c5:#3a9bd1;--c6:#7a5230;--c7:#5f6b76}
@media (prefers-color-scheme:dark){:root{--page:#11171c;--ink:#e3e9ee;--quiet:#9aa8b4;--line:#33404b;--good:#5fd3a5;--fair:#e8b64c;
--bad:#ff8a7d;--c0:#5cb3ec;--c1:#ff9155;--c2:#3fd0a0;--c3:#d78fd0;--c4:#e2b23f;--c5:#9bd4f5;--c6:#c79a70;--c7:#a3afba}}
svg text{fill:var(--ink);font:13px system-ui,sans-serif}
svg .quiet{fill:var(--quiet)}svg .axis{stroke:var(--line)}svg .budget{stroke:var(--quiet);stroke-dasharray:5 4}
)";

// The page down to its title, and its end.
std::string page_head(const std::string& title);
inline constexpr const char* page_end = "</body>\n</html>\n";

// Rows of a <dl>: one, and those of the machine.
std::string list_row(const char* name, const std::string& value);
std::string machine_rows(const Machine& machine);

}  // namespace seascape
