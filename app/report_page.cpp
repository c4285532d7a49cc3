#include "app/report_page.h"

#include <fmt/format.h>

#include "app/svg.h"

namespace seascape {

namespace {

constexpr const char* style = R"(
body{background:var(--page);color:var(--ink);font:16px/1.5 system-ui,sans-serif;max-width:1080px;margin:2rem auto;padding:0 1.2rem}
h1{font-size:1.7rem;margin:0 0 .6rem}h2{font-size:1.15rem;margin:2.2rem 0 .4rem}p{margin:.4rem 0;max-width:75ch}
.verdict{font-size:1.08rem}.note,figcaption{color:var(--quiet);font-size:.9rem}
table{border-collapse:collapse;font-size:.88rem;font-variant-numeric:tabular-nums}.wide{overflow-x:auto}
th,td{padding:.3rem .5rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}
thead th{font-weight:600;color:var(--quiet);text-align:center}tbody th{text-align:left}
.good{color:var(--good)}.fair{color:var(--fair)}.bad{color:var(--bad)}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.1rem 1rem;font-size:.92rem}dt{color:var(--quiet)}dd{margin:0}
figure{margin:.6rem 0}svg{width:100%;height:auto;display:block})";

}  // namespace

bool software(const Machine& machine) {
  for (const char* name : {"llvmpipe", "lavapipe", "SwiftShader"})
    if (machine.device.find(name) != std::string::npos || machine.driver.find(name) != std::string::npos) return true;
  return false;
}

std::string page_head(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light "
      "dark\">\n<title>{0}</title>\n"
      "<style>{1}{2}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      html_escaped(title), page_colours, style);
}

std::string list_row(const char* name, const std::string& value) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>", name, value.empty() ? "not known" : html_escaped(value));
}

std::string machine_rows(const Machine& machine) {
  return list_row("Device", machine.device) + list_row("Driver", machine.driver) +
         list_row("Processor",
                  fmt::format("{}, {} cores", machine.cpu.empty() ? "not known" : machine.cpu, machine.cores)) +
         list_row("Build", machine.build) + list_row("Date", machine.date) +
         list_row("Seed", std::to_string(machine.seed));
}

}  // namespace seascape
