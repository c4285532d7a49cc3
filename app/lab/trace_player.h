// Plays a trace of load against a rule that chooses the picture's area, and scores it.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/adaptive/adaptive.h"
#include "app/lab/load_trace.h"

namespace seascape {

// A timing as a rule gets it.
struct PlayedTiming {
  std::size_t frame = 0;
  double cost_ms = 0.0;
  double area = 1.0;   // that the frame was drawn with
  double clock = 1.0;  // 1 unless the trace tells it
};

struct PlayedFrame {
  std::size_t frame = 0;
  double period_ms = 0.0;
  std::span<const PlayedTiming> timings{};  // that arrived since the last frame, in the order of arrival
};

// A rule gives the area of the frame to come, least_area to most_area. It starts at area 1.
class AreaRule {
 public:
  virtual ~AreaRule() = default;
  virtual double area(const PlayedFrame& frame) = 0;
};

struct Played {
  std::vector<double> area, cost_ms;  // of each frame
  std::vector<bool> missed;           // its cost is over its period
};
Played play(const LoadTrace& trace, AreaRule& rule);

// Prices of the score: a miss, and a level of change; a level is 15 % of area.
inline constexpr double miss_price = 1.0, change_price = 0.02;
double levels_of_change(double area, double other);
// The sum over frames of quality - 1 a miss - 0.02 a level of change.
double score_of(const Played& played);

struct PlayedFacts {
  double score = 0.0, mean_quality = 0.0, mean_area = 0.0;
  double misses_per_1000 = 0.0;
  int longest_run = 0;                // of misses
  double p99_cost = 0.0;              // over the period
  double changes_per_minute = 0.0;    // frames whose area differs from the last, at the trace's periods
  double reversals_per_minute = 0.0;  // changes against the one before, within a second
};
PlayedFacts facts_of(const LoadTrace& trace, const Played& played);

// The greatest score with the whole trace known: dynamic programming (Viterbi 1967) over areas in equal steps of their
// logarithm, and the states of the clock where it is governed.
inline constexpr int optimum_levels = 65;
double optimum_area(int level, int levels = optimum_levels);
struct Optimum {
  double score = 0.0;
  std::vector<double> area;  // of each frame
};
Optimum optimum_of(const LoadTrace& trace, int levels = optimum_levels);

// Ours: the program's controller with picture scale as its one lever, in optimum_levels steps.
struct OursOptions {
  AdaptiveTuning tuning{};
  double first_share = 0.8;  // of the cost that area scales at its greatest: the first guess
  bool pairs_levels = true;  // false: a timing is taken for one of the levels that are there now (a control)
};
Lever picture_scale_lever(double share);
std::unique_ptr<AreaRule> ours(const OursOptions& options = {});

// Rules in the field, written from their published constants.
std::unique_ptr<AreaRule> valve();
std::unique_ptr<AreaRule> unreal();
std::unique_ptr<AreaRule> filament(double headroom);
std::unique_ptr<AreaRule> unity();
std::unique_ptr<AreaRule> fixed_area(double area);  // asleep

struct NamedRule {
  std::string name;
  std::unique_ptr<AreaRule> (*make)();
};
// Ours first, then Valve, Unreal, Filament, Filament with 10 % headroom, Unity.
std::span<const NamedRule> field_rules();

// The best score of causal rules that know the true load (with and without its noise) as late as all others do, and the
// cost's true law: of 840 rules (1,680 where a clock is governed) the best for this very trace.
double best_causal(const LoadTrace& trace);

}  // namespace seascape
