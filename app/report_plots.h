// The plots of report.html, as SVG text that takes its colours from the page.
#pragma once
#include <string>
#include <vector>

#include "app/report.h"

namespace seascape {

// "low", or "storm / low" where the runs are of several scenes or a preset comes twice.
std::string run_label(const CaptureRun& run, const std::vector<CaptureRun>& runs);

std::string frame_time_plot(const std::vector<CaptureRun>& runs);  // over the path, with the budgets as lines
// One stacked bar a run, means.
std::string named_time_plot(const std::vector<CaptureRun>& runs, const CaptureTimes& kind);
// How a run held a frame rate: its frames' times against what they may take, and the picture's scale and the quality
// that it was drawn at. SVG alone; empty for a run that held its preset.
std::string kept_svg(const CaptureRun& run);
std::string histogram_plot(const std::vector<CaptureRun>& runs);  // one row a run, one scale

}  // namespace seascape
