#include "app/adaptive/lever.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace seascape {

double log_factor(double share, double work) { return std::log(1.0 - share + share * work); }

double error_of(std::span<const Lever> levers, const LeverLevels& levels) {
  double error = 0.0;
  for (std::size_t i = 0; i < levers.size(); ++i) error += levers[i].steps[levels[i]].error;
  return error;
}

std::vector<Rung> make_ladder(std::span<const Lever> levers, CostOf of) {
  assert(levers.size() <= most_levers);
  std::vector<Rung> ladder;
  std::array<std::size_t, most_levers> at{};
  double error = 0.0;
  for (;;) {
    std::size_t best = levers.size();
    double least = 0.0;
    for (std::size_t i = 0; i < levers.size(); ++i) {
      const Lever& lever = levers[i];
      const double share = lever.share(of);
      if (lever.moves != LeverMoves::between_frames || !(share > 0.0) || at[i] + 1 >= lever.steps.size()) continue;
      const LeverStep &now = lever.steps[at[i]], &next = lever.steps[at[i] + 1];
      const double saved = log_factor(share, now.work) - log_factor(share, next.work);
      const double price = (next.error - now.error) / std::max(saved, 1e-9);
      if (best == levers.size() || price < least) best = i, least = price;
    }
    if (best == levers.size()) return ladder;
    const std::vector<LeverStep>& steps = levers[best].steps;
    error += steps[at[best] + 1].error - steps[at[best]].error;
    ++at[best];
    ladder.push_back({best, std::uint8_t(at[best]), error});
  }
}

std::string moves_text(std::span<const Lever> levers, const LeverLevels& from, const LeverLevels& to) {
  std::string text;
  for (std::size_t i = 0; i < levers.size(); ++i)
    if (from[i] != to[i])
      text += fmt::format("{}{} {:.4g} to {:.4g}", text.empty() ? "" : ", ", levers[i].name,
                          levers[i].steps[from[i]].value, levers[i].steps[to[i]].value);
  return text;
}

}  // namespace seascape
