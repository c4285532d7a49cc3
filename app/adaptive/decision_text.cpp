// How decisions are told in logs and overlays.
#include <fmt/format.h>

#include "app/adaptive/adaptive.h"

namespace seascape {

std::string_view name_of(DecisionReason reason) {
  switch (reason) {
    case DecisionReason::off:
      return "off";
    case DecisionReason::no_timings:
      return "no timings";
    case DecisionReason::intervals:
      return "late frames, no timings";
    case DecisionReason::unfocused:
      return "not in focus";
    case DecisionReason::steady:
      return "steady";
    case DecisionReason::dead_band:
      return "within the dead band";
    case DecisionReason::outlier:
      return "one frame far off";
    case DecisionReason::over_budget:
      return "over budget";
    case DecisionReason::headroom:
      return "headroom";
    case DecisionReason::load_step:
      return "the load jumped";
    case DecisionReason::foreseen_change:
      return "a change foreseen";
    case DecisionReason::refresh_changed:
      return "another refresh rate";
    case DecisionReason::at_floor:
      return "over budget at the floor";
    case DecisionReason::late_anyway:
      return "late at every level";
    case DecisionReason::at_loading:
      return "chosen at loading";
  }
  return "unknown";
}

std::string decision_text(const Decision& d, std::span<const Lever> levers) {
  std::string text = fmt::format("frame {}, {}: {}", d.frame, d.of == CostOf::gpu ? "GPU" : "CPU", name_of(d.reason));
  if (d.predicted_ms > 0.0)
    text += fmt::format(", {:.2f} of {:.2f} ms, spread {:.1f} %, chance of a miss {:.1f} %", d.predicted_ms,
                        d.budget_ms, 100.0 * d.spread, 100.0 * d.miss_chance);
  text += fmt::format(", quality {:.2f}", d.quality);
  if (d.moved()) text += ": " + moves_text(levers, d.before, d.levels);
  return text;
}

}  // namespace seascape
