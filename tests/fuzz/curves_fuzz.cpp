// Any bytes as curves.csv: read or refused; what is read is finite, survives being written, and can be plotted and told
// of.
#include "app/lab/lab_report.h"

#include <cmath>

#include "tests/fuzz/fuzz.h"

using namespace seascape;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::reads([&] {
    const LabRows rows = parse_curves_csv(fuzz::text_of(data, size), "curves.csv");
    for (const LabPoint& p : rows.points)
      fuzz::require(std::isfinite(p.time_us.median) && std::isfinite(p.error.value) && p.error.value >= 0.0,
                    "points are finite");
    if (rows.points.empty()) return;
    const std::string text = curves_csv(rows.points, rows.origin);
    LabRows again;
    fuzz::require(fuzz::reads([&] { again = parse_curves_csv(text, "written.csv"); }), "what is written is read");
    fuzz::require(curves_csv(again.points, again.origin) == text, "written points read back the same");
    const LabCurve curve{
        rows.points.front().curve, "Title", "time", {{"k", false, 1.0, 1.0, 0.0, 1e9, "why"}}, true, false, {}, {}};
    (void)lab_html({curve}, rows.points, rows.origin);
    (void)lab_table({curve}, rows.points);
    for (const std::string& unit : error_units(curve.name, rows.points)) {
      const std::string plot = curve_plot(
          curve, rows.points, unit);  // texts in it have no quotes of their own: what is in quotes is a number
      fuzz::require(plot.find("=\"nan") == std::string::npos && plot.find("=\"inf") == std::string::npos &&
                        plot.find("=\"-nan") == std::string::npos,
                    "plots are finite");
    }
    (void)recommended(rows.points, 1e3, "U10");
  });
  return 0;
}
