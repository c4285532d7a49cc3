// What the lab's points come to: plots, sentences, a page, settings for a budget.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "app/lab/lab.h"
#include "app/lab/lab_files.h"

namespace seascape {

// Points of one curve whose errors have one unit: error over time, both on logarithmic scales, a panel a sea. Points of
// one knob are joined; what no other point beats is ringed, points of presets are named. For a page (report_page.h).
std::string curve_plot(const LabCurve& curve, const std::vector<LabPoint>& points, const std::string& unit);

// The units of a curve's errors, in the order in which they are first met; the first is the curve's own.
std::vector<std::string> error_units(const std::string& curve, const std::vector<LabPoint>& points);

std::vector<LabPoint> points_of(const std::vector<LabPoint>& points, const std::string& curve);

// What the curve says, in figures: how its laws are held, what exactness costs at the middle sea, and how far presets
// are off the front.
std::string conclusion(const LabCurve& curve, const std::vector<LabPoint>& points);

// How many times as long each preset's points of a curve take as the quickest of its rivals that is no preset and errs
// no more (off_front), in the unit of its first error: the worst of all seas. 1 is on the front.
std::map<std::string, double> presets_off_front(const LabCurve& curve, const std::vector<LabPoint>& points);

// Points that lie on the front of one sea and take at most `budget_us`, the most exact first: of the curve of whole
// frames, with settings.
std::vector<LabPoint> recommended(const std::vector<LabPoint>& points, double budget_us, const std::string& sea);

std::string lab_html(const std::vector<LabCurve>& curves, const std::vector<LabPoint>& points, const LabOrigin& origin);
// A few lines a curve, for a terminal.
std::string lab_table(const std::vector<LabCurve>& curves, const std::vector<LabPoint>& points);

}  // namespace seascape
