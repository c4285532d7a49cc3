// Two captures of one path, of two builds: which stage or pass takes another time than before.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "app/report.h"

namespace seascape {

// One time by name in one scene at one preset. Ratios are of now to before.
struct TimeChange {
  std::string scene, preset, name;  // name: as the column in capture.csv, "cpu_foam_ms"
  double before_ms = 0.0, now_ms = 0.0;  // means
  // By how much it has changed beyond what all times of its run have in common, and how far off that may be.
  double ratio = 1.0, noise = 0.0;
  bool changed() const { return ratio > 1.0 + noise || ratio < 1.0 / (1.0 + noise); }
};

struct RunChange {
  std::string scene, preset;
  int frames = 0;             // that both have
  double together = 1.0;      // what the times of the run have in common: the machine's speed, or all of the build
  std::vector<TimeChange> times;  // those that are 0.02 ms and more
};

// Reads what capture_csv() writes. Throws Error("WHERE:LINE", ...).
std::vector<CaptureRun> parse_capture_csv(std::string_view text, const std::string& where);

// Compares runs of the same scene and preset, frame by frame; those that only one side has are left out.
//
// A frame's times now and before are of the same work, so that the path does not count. Their logarithms' differences
// have in common what the machine's speed does: the median over the names goes off. The frames are cut into 12 pieces,
// whose medians tell how much a time varies by itself: the noise is Student's interval of their mean, for a thousandth
// of false alarms a name, and no less than 5 %, as much as a stage may gain or lose by where its memory lies.
std::vector<RunChange> compare_captures(const std::vector<CaptureRun>& before, const std::vector<CaptureRun>& now);

// One line a change, and one for a run without any.
std::string tell_changes(const std::vector<RunChange>& runs);

}  // namespace seascape
