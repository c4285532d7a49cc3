#include "app/lab/trace_player.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seascape {

namespace {

constexpr std::size_t clocks = std::size(clock_levels);

}  // namespace

double levels_of_change(double area, double other) { return std::abs(std::log(area / other)) / std::log(1.15); }

Played play(const LoadTrace& trace, AreaRule& rule) {
  const std::size_t n = trace.frames();
  Played played;
  played.area.reserve(n), played.cost_ms.reserve(n), played.missed.reserve(n);
  // Timings by the frame before which they are known.
  std::vector<std::vector<PlayedTiming>> due(n + 1);
  std::size_t clock = clocks - 1;
  for (std::size_t t = 0; t < n; ++t) {
    const double area = std::clamp(rule.area({t, trace.period_ms[t], due[t]}), least_area, most_area);
    const double speed = trace.governed ? clock_levels[clock] : 1.0;
    const double cost = trace.cost_ms(t, area, speed);
    played.area.push_back(area);
    played.cost_ms.push_back(cost);
    played.missed.push_back(cost > trace.period_ms[t]);
    const Arrival& arrival = trace.arrivals[t];
    const std::size_t at = t + std::size_t(arrival.age);
    if (!arrival.lost && at < n) due[at].push_back({t, cost * arrival.factor, area, trace.clock_told ? speed : 1.0});
    if (trace.governed) clock = next_clock(clock, t, cost / trace.period_ms[t]);
    due[t].clear(), due[t].shrink_to_fit();
  }
  return played;
}

double score_of(const Played& played) {
  double sum = 0.0;
  for (std::size_t t = 0; t < played.area.size(); ++t) {
    sum += quality_of_area(played.area[t]) - (played.missed[t] ? miss_price : 0.0);
    if (t > 0) sum -= change_price * levels_of_change(played.area[t], played.area[t - 1]);
  }
  return sum;
}

PlayedFacts facts_of(const LoadTrace& trace, const Played& played) {
  PlayedFacts facts;
  facts.score = score_of(played);
  const std::size_t n = played.area.size();
  if (n == 0) return facts;
  std::vector<double> cost;
  double ms = 0.0, last_change_ms = -1e9, last_direction = 0.0;
  int run = 0, misses = 0, changes = 0, reversals = 0;
  for (std::size_t t = 0; t < n; ++t) {
    facts.mean_quality += quality_of_area(played.area[t]) / double(n);
    facts.mean_area += played.area[t] / double(n);
    cost.push_back(played.cost_ms[t] / trace.period_ms[t]);
    run = played.missed[t] ? run + 1 : 0;
    misses += played.missed[t];
    facts.longest_run = std::max(facts.longest_run, run);
    if (t > 0 && played.area[t] != played.area[t - 1]) {
      const double direction = played.area[t] > played.area[t - 1] ? 1.0 : -1.0;
      ++changes;
      if (direction * last_direction < 0.0 && ms - last_change_ms <= 1000.0) ++reversals;
      last_direction = direction, last_change_ms = ms;
    }
    ms += trace.period_ms[t];
  }
  std::sort(cost.begin(), cost.end());
  facts.p99_cost = cost[std::size_t(0.99 * double(n - 1))];
  facts.misses_per_1000 = 1000.0 * misses / double(n);
  facts.changes_per_minute = 6e4 * changes / ms;
  facts.reversals_per_minute = 6e4 * reversals / ms;
  return facts;
}

double optimum_area(int level, int levels) {
  return least_area * std::pow(most_area / least_area, double(level) / (levels - 1));
}

Optimum optimum_of(const LoadTrace& trace, int level_count) {
  const auto levels = std::size_t(level_count);
  const std::size_t speeds = trace.governed ? clocks : 1, states = levels * speeds, n = trace.frames();
  std::vector<double> area(levels), quality(levels);
  for (std::size_t i = 0; i < levels; ++i)
    area[i] = optimum_area(int(i), level_count), quality[i] = quality_of_area(area[i]);
  const double step_price = change_price * levels_of_change(area[1], area[0]);
  constexpr double never = -1e300;
  // value: of the best way into a state of frame t, clock speed included, before the frame itself.
  std::vector<double> value(states, never), moved(states), next(states);
  std::vector<std::uint8_t> from_level(n * states), from_speed(n * states);
  std::vector<std::uint8_t> source_level(states), source_speed(states);
  for (std::size_t i = 0; i < levels; ++i) value[(speeds - 1) * levels + i] = 0.0;  // any level, the highest clock
  std::vector<std::uint8_t> came_level(states), came_speed(states);
  for (std::size_t i = 0; i < states; ++i) came_level[i] = std::uint8_t(i % levels), came_speed[i] = 0;
  for (std::size_t t = 0; t < n; ++t) {
    // The level of frame t may differ from that of t - 1; its price grows with the distance: two sweeps.
    for (std::size_t c = 0; c < speeds; ++c) {
      double* const row = value.data() + c * levels;
      std::vector<std::uint8_t> origin(levels);
      for (std::size_t i = 0; i < levels; ++i) origin[i] = std::uint8_t(i);
      if (t > 0) {
        for (std::size_t i = 1; i < levels; ++i)
          if (row[i - 1] - step_price > row[i]) row[i] = row[i - 1] - step_price, origin[i] = origin[i - 1];
        for (std::size_t i = levels - 1; i-- > 0;)
          if (row[i + 1] - step_price > row[i]) row[i] = row[i + 1] - step_price, origin[i] = origin[i + 1];
      }
      for (std::size_t i = 0; i < levels; ++i) {
        from_level[t * states + c * levels + i] = origin[i];
        from_speed[t * states + c * levels + i] = came_speed[c * levels + origin[i]];
      }
    }
    std::fill(next.begin(), next.end(), never);
    for (std::size_t c = 0; c < speeds; ++c)
      for (std::size_t i = 0; i < levels; ++i) {
        const double before = value[c * levels + i];
        if (before == never) continue;
        const double share = trace.cost_ms(t, area[i], trace.governed ? clock_levels[c] : 1.0) / trace.period_ms[t];
        const double after = before + quality[i] - (share > 1.0 ? miss_price : 0.0);
        const std::size_t to = (trace.governed ? next_clock(c, t, share) : 0) * levels + i;
        if (after > next[to]) next[to] = after, source_speed[to] = std::uint8_t(c);
      }
    value.swap(next);
    came_speed = source_speed;
  }
  Optimum best;
  std::size_t at = std::size_t(std::max_element(value.begin(), value.end()) - value.begin());
  best.score = value[at];
  best.area.resize(n);
  std::size_t level = at % levels, speed = came_speed[at];
  for (std::size_t t = n; t-- > 0;) {
    best.area[t] = area[level];
    const std::size_t state = speed * levels + level;
    speed = from_speed[t * states + state];
    level = from_level[t * states + state];
  }
  return best;
}

Lever picture_scale_lever(double share) {
  Lever lever;
  lever.name = "picture scale";
  lever.gpu_share = share;
  for (int i = optimum_levels - 1; i >= 0; --i) {
    const double area = optimum_area(i);
    lever.steps.push_back({std::sqrt(area), area / most_area, 1.0 - quality_of_area(area)});
  }
  return lever;
}

namespace {

std::uint8_t step_of_area(double area) {
  const double up = std::log(area / least_area) / std::log(most_area / least_area) * (optimum_levels - 1);
  return std::uint8_t(optimum_levels - 1 - int(std::lround(std::clamp(up, 0.0, optimum_levels - 1.0))));
}

class Ours : public AreaRule {
 public:
  explicit Ours(const OursOptions& options)
      : options_(options),
        quality_({picture_scale_lever(options.first_share)}, {}, options.tuning, LeverLevels{step_of_area(1.0)}) {}
  double area(const PlayedFrame& frame) override {
    timings_.clear();
    for (const PlayedTiming& one : frame.timings) {
      FrameTiming timing{.frame = one.frame, .gpu_ms = one.cost_ms, .gpu_clock = one.clock};
      timing.levels = options_.pairs_levels ? LeverLevels{step_of_area(one.area)} : quality_.last().levels;
      timings_.push_back(timing);
    }
    const FrameInput input{.frame = frame.frame, .period_ms = frame.period_ms, .timings = timings_};
    return optimum_area(optimum_levels - 1 - int(quality_.decide(input).levels[0]));
  }

 private:
  OursOptions options_;
  AdaptiveQuality quality_;
  std::vector<FrameTiming> timings_;
};

class FixedArea : public AreaRule {
 public:
  explicit FixedArea(double area) : area_(area) {}
  double area(const PlayedFrame&) override { return area_; }

 private:
  double area_;
};

}  // namespace

std::unique_ptr<AreaRule> ours(const OursOptions& options) { return std::make_unique<Ours>(options); }
std::unique_ptr<AreaRule> fixed_area(double area) { return std::make_unique<FixedArea>(area); }

}  // namespace seascape
