// Two captures of one path, of two builds: which stage of the processor takes another time than before.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "app/report.h"

namespace seascape {

// One stage in one scene at one preset. `ratio`: of now to before, without what all stages have in common; it may be
// off by `noise`.
struct StageChange {
  std::string name;                      // as the column in capture.csv, "cpu_foam_ms"
  double before_ms = 0.0, now_ms = 0.0;  // means over the frames
  double ratio = 1.0, noise = 0.0;
  bool changed() const { return ratio > 1.0 + noise || ratio < 1.0 / (1.0 + noise); }
};

struct RunChange {
  std::string scene, preset;
  int frames = 0;                   // that all have
  double together = 1.0;            // what the stages have in common: the machine's speed, or that of the whole build
  std::vector<StageChange> stages;  // of 0.02 ms and more
  std::string unlike;               // by what one sees that the two drew other things; empty: by nothing
};

constexpr int least_repeats = 3;  // of a path, for a comparison

// Reads what capture_csv() writes. Throws Error("WHERE:LINE", ...).
std::vector<CaptureRun> parse_capture_csv(std::string_view text, const std::string& where);

// Throws Error(WHERE, ...) where there are fewer than least_repeats runs of a scene at a preset.
void expect_repeats(const std::vector<CaptureRun>& runs, const std::string& where);

// Compares the runs of a scene at a preset with those of the same; scenes and presets that only one side has are left
// out. Both have been through expect_repeats().
//
// Of each frame the shortest time of a stage over the runs counts: what else a machine does only adds to it. Sums of
// these over the frames are compared. The median of how the stages of 0.1 ms and more have changed is what all have in
// common. The noise is twice the deviation that leaving out one run after another shows (the jackknife: Efron and Stein
// 1981, "The jackknife estimate of variance", equation 1.3), and no less than 6 % and 0.02 ms: a stage may gain or lose
// as much by where its memory lies.
std::vector<RunChange> compare_captures(const std::vector<CaptureRun>& before, const std::vector<CaptureRun>& now);

// A line for each scene and preset, and one for each change.
std::string tell_changes(const std::vector<RunChange>& runs);

}  // namespace seascape
