// What a causal rule could reach that knew more than any real one: the bound that ours is compared with.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/lab/trace_player.h"

namespace seascape {

namespace {

constexpr double bands[] = {0.0, 0.02, 0.05, 0.1};
constexpr std::size_t no_frame = std::size_t(-1);

// The last frame whose timing is known before each frame is decided.
std::vector<std::size_t> last_known(const LoadTrace& trace) {
  std::vector<std::size_t> known(trace.frames(), no_frame);
  for (std::size_t t = 0; t < trace.frames(); ++t) {
    const Arrival& arrival = trace.arrivals[t];
    const std::size_t at = t + std::size_t(arrival.age);
    if (arrival.lost || !(arrival.factor > 0.0) || at >= trace.frames()) continue;
    if (known[at] == no_frame || known[at] < t) known[at] = t;
  }
  for (std::size_t t = 1; t < trace.frames(); ++t)
    if (known[t] == no_frame || (known[t - 1] != no_frame && known[t - 1] > known[t])) known[t] = known[t - 1];
  return known;
}

// Greatest of the last `window`.
std::vector<double> highest(const std::vector<double>& of, std::size_t window) {
  std::vector<double> most(of.size());
  for (std::size_t t = 0; t < of.size(); ++t) {
    const std::size_t from = t + 1 > window ? t + 1 - window : 0;
    most[t] = *std::max_element(of.begin() + std::ptrdiff_t(from), of.begin() + std::ptrdiff_t(t) + 1);
  }
  return most;
}

std::vector<double> average(const std::vector<double>& of, std::size_t window) {
  std::vector<double> mean(of.size());
  double sum = 0.0;
  for (std::size_t t = 0; t < of.size(); ++t) {
    sum += of[t] - (t >= window ? of[t - window] : 0.0);
    mean[t] = sum / double(std::min(t + 1, window));
  }
  return mean;
}

// Chooses the area at which an estimate of the load takes `target` of the period, and keeps it while it is within
// `band`. `by_clock`: at the clock last known, else at the highest.
double played_score(const LoadTrace& trace, const std::vector<std::size_t>& known, const std::vector<double>& estimate,
                    double target, double band, bool by_clock) {
  const double fixed = trace.fixed_share;
  double area = 1.0, score = 0.0;
  std::size_t clock = std::size(clock_levels) - 1;
  std::vector<std::uint8_t> clocks(trace.governed ? trace.frames() : 0);
  for (std::size_t t = 0; t < trace.frames(); ++t) {
    const double before = area;
    if (const std::size_t k = known[t]; k != no_frame) {
      const double speed = trace.governed && by_clock ? clock_levels[clocks[k]] : 1.0;
      const double wanted = target * trace.period_ms[t] * speed / (estimate[k] * load_unit_ms);
      const double to = std::clamp((wanted - fixed) / (1.0 - fixed), least_area, most_area);
      if (to > area * (1.0 + band) || to < area * (1.0 - band) || to == least_area || to == most_area) area = to;
    }
    const double cost = trace.cost_ms(t, area, trace.governed ? clock_levels[clock] : 1.0);
    score += quality_of_area(area) - (cost > trace.period_ms[t] ? miss_price : 0.0);
    if (t > 0 && area != before) score -= change_price * levels_of_change(area, before);
    if (trace.governed) {
      clocks[t] = std::uint8_t(clock);
      clock = next_clock(clock, t, cost / trace.period_ms[t]);
    }
  }
  return score;
}

}  // namespace

double best_causal(const LoadTrace& trace) {
  const std::vector<std::size_t> known = last_known(trace);
  const bool lengthy = trace.frames() > 10000;  // of a slow drift: no rule with a short memory is the best
  std::vector<std::vector<double>> estimates{trace.mean, highest(trace.mean, 64)};
  if (!lengthy) {
    estimates.push_back(trace.load);
    for (const std::size_t window : {8, 32, 128}) estimates.push_back(highest(trace.mean, window));
    for (const std::size_t window : {4, 16, 64}) estimates.push_back(average(trace.load, window));
    estimates.push_back(highest(trace.load, 4));
  }
  double best = -1e300;
  for (const std::vector<double>& estimate : estimates)
    for (int i = 0; i <= 20; ++i)
      for (const double band : bands)
        for (const bool by_clock : {false, true}) {
          if (by_clock && !trace.governed) continue;
          best = std::max(best, played_score(trace, known, estimate, 1.0 - 0.0001 - 0.02 * i, band, by_clock));
        }
  return best;
}

}  // namespace seascape
