// Any bytes as curves.csv, and as presets.csv: read or refused; what is read is finite, survives being written, and can
// be plotted and told of.
#include "app/lab/lab_report.h"

#include <cmath>

#include "app/preset_costs.h"
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
  fuzz::reads([&] {
    const std::vector<PresetCosts> costs = parse_preset_costs(fuzz::text_of(data, size), "presets.csv");
    const std::string text = preset_costs_csv(costs);
    std::vector<PresetCosts> again;
    fuzz::require(fuzz::reads([&] { again = parse_preset_costs(text, "written.csv"); }), "what is written is read");
    fuzz::require(preset_costs_csv(again) == text, "written costs read back the same");
    (void)presets_document(costs);
    if (!costs.empty()) (void)preset_table(&costs.front(), costs.front().scene);
  });
  return 0;
}
