// Adaptive quality: chooses the levels of the quality levers so that frames meet the display's deadline. Pure: no
// clock, no device, no file, no chance. The same inputs give the same decisions, bit for bit.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/adaptive/adaptive_settings.h"
#include "app/adaptive/adaptive_tuning.h"
#include "app/adaptive/cost_estimator.h"
#include "app/adaptive/lever.h"

namespace seascape {

// What is known of an earlier frame. Timings may come late, out of order, twice or never.
struct FrameTiming {
  std::uint64_t frame = 0;
  double gpu_ms = 0.0;  // busy time from the frame's first to its last command; 0: not known. Never an interval between
                        // frames: that is a whole number of periods, in which headroom cannot be seen
  double cpu_ms = 0.0;  // of the stages, without waiting; 0: not known
  LeverLevels levels{};    // that it was drawn with
  double gpu_clock = 1.0;  // relative to the highest, if the system tells; else 1
};

enum class ForeseenKind : std::uint8_t { scene_change, going_under, surfacing, storm };

struct ForeseenChange {
  ForeseenKind kind = ForeseenKind::scene_change;
  std::uint64_t frame = 0;                  // the first frame with the new load
  double gpu_ratio = 1.0, cpu_ratio = 1.0;  // new load over old
};

struct FrameInput {
  std::uint64_t frame = 0;  // the frame to decide for; rises from call to call
  double period_ms = 0.0;   // of the display
  double deadline_ms =
      0.0;  // GPU time a frame may take; 0: the whole period. Less than it where a compositor needs some
  double interval_ms = 0.0;  // between the last two frames shown; 0: not known. Used only where there are no GPU times
  bool focused = true;       // false: another program is in front, and timings say nothing of ours
  bool loading = false;      // a scene loads before this frame: levers that rebuild may move
  std::span<const FrameTiming> timings{};      // that arrived since the last call
  std::span<const ForeseenChange> foreseen{};  // told since the last call; each once
};

enum class DecisionReason : std::uint8_t {
  off,              // the settings say so
  no_timings,       // none yet, or none for long: levels stay
  intervals,        // no GPU times, and frames shown late: lowered blindly
  unfocused,        // levels stay
  steady,           // the best levels are those that are there
  dead_band,        // others are better by less than is known
  outlier,          // one timing was far off: the next one decides
  over_budget,      // a miss is too likely
  headroom,         // there is time for more
  load_step,        // the load has jumped
  foreseen_change,  // it is about to
  refresh_changed,  // the display's period is another
  at_floor,         // a miss is likely, and nothing is left to lower
  late_anyway,      // a miss is likely, and what could be lowered would not help
  at_loading,       // levers that rebuild have moved
};
std::string_view name_of(DecisionReason reason);

struct Decision {
  std::uint64_t frame = 0;
  LeverLevels levels{}, before{};
  DecisionReason reason = DecisionReason::no_timings;
  CostOf of = CostOf::gpu;                     // whose time decided
  double predicted_ms = 0.0, budget_ms = 0.0;  // at `levels`
  double spread = 0.0;                         // of forecasts, relative standard deviation
  double miss_chance = 0.0;                    // at `levels`
  double quality = 1.0;                        // 1 at the finest, 0 with all levers at their last step

  bool moved() const { return levels != before; }
};
// One line, as for a log.
std::string decision_text(const Decision& decision, std::span<const Lever> levers);

class AdaptiveQuality {
 public:
  // 1 to 16 levers, of at most 255 steps. Starts at the finest levels, or at `start`.
  explicit AdaptiveQuality(std::vector<Lever> levers, const AdaptiveSettings& settings = {},
                           const AdaptiveTuning& tuning = {}, const LeverLevels& start = {});
  AdaptiveQuality(const AdaptiveQuality&) = delete;
  AdaptiveQuality& operator=(const AdaptiveQuality&) = delete;

  // Call once a frame, before it is drawn; both eyes take the same levels.
  const Decision& decide(const FrameInput& input);

  // The levels that levers which rebuild should have in another scene, whose frames take so many times as long at the
  // same levels; as they are while nothing is known. Moves nothing.
  LeverLevels best_for_scene(double gpu_ratio, double cpu_ratio);

  void set(const AdaptiveSettings& settings) { settings_ = settings; }
  const Decision& last() const { return decision_; }
  // Of levers that rebuild, as they stand; 0 for the others.
  const LeverLevels& loaded() const { return at_loading_; }
  std::span<const Lever> levers() const { return levers_; }
  const CostEstimator& gpu() const { return gpu_.cost; }
  const CostEstimator& cpu() const { return cpu_.cost; }

 private:
  // One kind of time: its levers in order, and how many rungs are taken.
  struct Channel {
    Channel(std::span<const Lever> levers, CostOf kind, const AdaptiveTuning& tuning)
        : of(kind), ladder(make_ladder(levers, kind)), cost(levers, kind, tuning.estimator) {}
    CostOf of;
    std::vector<Rung> ladder;
    CostEstimator cost;
    std::size_t rung = 0;
    int direction = 0;  // of the last move: 1 is down in quality
    double clock = 1.0;
    TimingUse last_use = TimingUse::unusable;
    int late = 0, patience = 0;                 // frames late in vain, and how many more are borne (0: none were)
    std::vector<double> value, miss, log_cost;  // of each rung, rung 0 included
  };
  struct Choice {
    std::size_t rung = 0;
    DecisionReason reason = DecisionReason::steady;
  };

  void take_in(const FrameInput& input);
  void evaluate(Channel& channel, std::uint64_t frame, double budget_ms, const LeverLevels& others);
  Choice choose(Channel& channel, const FrameInput& input, double budget_ms, const LeverLevels& others);
  void take(Channel& channel, std::size_t rung);
  double spread_of(const CostEstimator& cost) const;
  std::size_t coarsest(const Channel& channel) const;
  std::size_t finest(const Channel& channel) const;
  LeverLevels demanded(const Channel& channel) const;
  bool without_timings(const FrameInput& input);
  LeverLevels best_at_loading(std::uint64_t frame, double gpu_budget_ms, double cpu_budget_ms);
  void describe(const FrameInput& input, double gpu_budget_ms, double cpu_budget_ms);
  const Decision& hold(const FrameInput& input, DecisionReason reason);

  std::vector<Lever> levers_;
  AdaptiveSettings settings_;
  AdaptiveTuning tuning_;
  Channel gpu_, cpu_;
  LeverLevels at_loading_{};  // levels of levers that move only then
  double most_error_ = 0.0;
  std::vector<FrameTiming> timings_;  // of this call, oldest first
  Decision decision_;
  double period_ms_ = 0.0;
  double gpu_budget_ms_ = 0.0, cpu_budget_ms_ = 0.0;  // of the last decision
  bool focused_ = true;
  std::optional<std::uint64_t> first_frame_, last_gpu_timing_;
  std::uint64_t foreseen_until_ = 0;
  int late_intervals_ = 0, intervals_ = 0;
};

}  // namespace seascape
