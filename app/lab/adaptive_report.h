// What rules of adaptive quality come to on traces of load: scores, a table, and a plot a trace.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/lab/load_trace.h"
#include "app/lab/trace_player.h"

namespace seascape {

struct JudgedRule {
  std::string rule;
  double share = 0.0;      // score over the optimum's
  int settled_after = -1;  // frames (frames_to_settle)
  PlayedFacts facts;
};

struct JudgedTrace {
  std::string name, family;
  double fixed_share = 0.0;
  int dead_frames = 0;
  double optimum = 0.0;           // its score
  double causal = 0.0;            // share of the optimum that the best causal rule reaches
  std::vector<JudgedRule> rules;  // in the order of field_rules()
};

// Frames from the trace's greatest step of load until quality stays within 0.1 of what it comes to (its mean over the
// frames 120 to 239 after the step), and no two frames in a row are missed. -1 where the load has no single step of
// more than a tenth with 240 frames after it.
int frames_to_settle(const LoadTrace& trace, const Played& played);

JudgedTrace judge(const LoadTrace& trace);

struct FamilyScore {
  std::string family;
  int traces = 0;
  double causal = 0.0;         // mean shares of the optimum
  std::vector<double> shares;  // of each rule
};
std::vector<FamilyScore> family_scores(const std::vector<JudgedTrace>& judged);

// A row a trace and rule:
// trace,family,fixed_share,dead_frames,rule,score_share,causal_share,mean_quality,misses_per_1000,longest_run,p99_cost,
// changes_per_minute,reversals_per_minute,settled_after_frames
std::string adaptive_csv(const std::vector<JudgedTrace>& judged);
// A line a family: the shares of the optimum's score.
std::string adaptive_table(const std::vector<JudgedTrace>& judged);

// Over time: the load and the cost that ours makes of it, the scale that each rule and the optimum choose, and the
// misses of each. A file of its own.
std::string trace_svg(const LoadTrace& trace);

// "step_up_1.svg".
std::string trace_file_name(const LoadTrace& trace);

// The traces that the lab plays: made from the seed, `each` a family; and those recorded. Throws Error where the file
// of these is missing or faulty.
std::vector<LoadTrace> lab_traces(std::uint64_t seed, int each);

}  // namespace seascape
