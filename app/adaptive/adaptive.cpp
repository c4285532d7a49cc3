#include "app/adaptive/adaptive.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace seascape {

namespace {

// The chance that a normal number exceeds `sigmas`.
double tail(double sigmas) { return 0.5 * std::erfc(sigmas * 0.70710678118654752); }

LeverLevels coarser_of(const LeverLevels& a, const LeverLevels& b) {
  LeverLevels levels{};
  for (std::size_t i = 0; i < most_levers; ++i) levels[i] = std::max(a[i], b[i]);
  return levels;
}

}  // namespace

AdaptiveQuality::AdaptiveQuality(std::vector<Lever> levers, const AdaptiveSettings& settings,
                                 const AdaptiveTuning& tuning, const LeverLevels& start)
    : levers_(std::move(levers)),
      settings_(settings),
      tuning_(tuning),
      gpu_(levers_, CostOf::gpu, tuning_),
      cpu_(levers_, CostOf::cpu, tuning_) {
  assert(!levers_.empty() && levers_.size() <= most_levers);
  for (std::size_t i = 0; i < levers_.size(); ++i) {
    assert(!levers_[i].steps.empty() && levers_[i].steps.size() <= 255 && start[i] < levers_[i].steps.size());
    if (levers_[i].moves == LeverMoves::at_loading)
      at_loading_[i] = start[i];
    else
      most_error_ += levers_[i].steps.back().error;
  }
  most_error_ = std::max(most_error_, 1e-12);
  // The rungs that make at least the levels of the start.
  for (Channel* channel : {&gpu_, &cpu_})
    for (std::size_t r = 0; r < channel->ladder.size(); ++r)
      if (channel->ladder[r].level <= start[channel->ladder[r].lever]) channel->rung = r + 1;
  decision_.levels = decision_.before = start;
}

LeverLevels AdaptiveQuality::demanded(const Channel& channel) const {
  LeverLevels levels{};
  for (std::size_t r = 0; r < channel.rung; ++r) levels[channel.ladder[r].lever] = channel.ladder[r].level;
  return levels;
}

std::size_t AdaptiveQuality::coarsest(const Channel& channel) const {
  const double most = (1.0 - settings_.floor) * most_error_ * (1.0 + 1e-12);
  std::size_t r = 0;
  while (r < channel.ladder.size() && channel.ladder[r].error <= most) ++r;
  return r;
}

std::size_t AdaptiveQuality::finest(const Channel& channel) const {
  // The ceiling is of the picture's cost on the GPU; the processor lowers nothing that it need not.
  if (channel.of == CostOf::cpu) return 0;
  const double least = (1.0 - settings_.ceiling) * most_error_ * (1.0 - 1e-12);
  const std::size_t last = coarsest(channel);
  std::size_t r = 0;
  while (r < last && (r == 0 ? 0.0 : channel.ladder[r - 1].error) < least) ++r;
  return r;
}

void AdaptiveQuality::take_in(const FrameInput& input) {
  // Each may be out of order; the estimator wants the oldest first.
  timings_.assign(input.timings.begin(), input.timings.end());
  std::sort(timings_.begin(), timings_.end(),
            [](const FrameTiming& a, const FrameTiming& b) { return a.frame < b.frame; });
  for (const ForeseenChange& one : input.foreseen) {
    gpu_.cost.foresee(one.frame, one.gpu_ratio);
    cpu_.cost.foresee(one.frame, one.cpu_ratio);
    foreseen_until_ = std::max(foreseen_until_, one.frame + 1);
  }
  gpu_.last_use = cpu_.last_use = TimingUse::unusable;
  for (const FrameTiming& one : timings_) {
    if (one.frame >= input.frame) continue;  // not drawn yet: a fault of the source
    const auto offer = [&](Channel& channel, double ms, double clock) {
      const TimingUse use = channel.cost.add(one.frame, ms, clock, one.levels);
      if (use == TimingUse::unusable) return;
      channel.clock = clock;
      if (channel.last_use != TimingUse::step) channel.last_use = use;
      if (channel.of == CostOf::gpu) last_gpu_timing_ = input.frame;
    };
    offer(gpu_, one.gpu_ms, one.gpu_clock);
    offer(cpu_, one.cpu_ms, 1.0);
  }
}

double AdaptiveQuality::spread_of(const CostEstimator& cost) const {
  return std::max({cost.spread(), cost.forecast_spread(), tuning_.least_spread});
}

void AdaptiveQuality::evaluate(Channel& channel, std::uint64_t frame, double budget_ms, const LeverLevels& others) {
  const std::size_t rungs = channel.ladder.size() + 1;
  channel.value.resize(rungs), channel.miss.resize(rungs), channel.log_cost.resize(rungs);
  const CostEstimator& cost = channel.cost;
  const double load = cost.log_load(frame) - std::log(channel.clock), budget = std::log(budget_ms);
  const double spread = spread_of(cost);
  const double rise = cost.pending_rise(), chance = rise > 0.0 ? cost.step_chance() : 0.0;
  const double margin = std::min(tuning_.margin_sigmas * cost.spread(), tuning_.most_margin);
  const double fixed_variance = spread * spread + cost.foreseen_variance(frame);
  LeverLevels levels = others;
  CostEstimator::Forecast forecast(cost, levels);
  double error = error_of(levers_, levels);
  for (std::size_t r = 0; r < rungs; ++r) {
    if (r > 0) {
      const Rung& rung = channel.ladder[r - 1];
      if (rung.level > levels[rung.lever]) {
        const std::vector<LeverStep>& steps = levers_[rung.lever].steps;
        error += steps[rung.level].error - steps[levels[rung.lever]].error;
        forecast.move(rung.lever, rung.level);
        levels[rung.lever] = rung.level;
      }
    }
    const double log_cost = load + forecast.log_factors();
    const double deviation = std::sqrt(fixed_variance + forecast.variance());
    double miss = tail((budget - log_cost) / deviation);
    if (chance > 0.0) miss = (1.0 - chance) * miss + chance * tail((budget - log_cost - rise) / deviation);
    channel.log_cost[r] = log_cost;
    channel.miss[r] = miss;
    channel.value[r] = -error / most_error_ - tuning_.miss_price * miss -
                       tuning_.margin_price * std::max(log_cost + margin - budget, 0.0);
  }
}

AdaptiveQuality::Choice AdaptiveQuality::choose(Channel& channel, const FrameInput& input, double budget_ms,
                                                const LeverLevels& others) {
  const std::size_t low = finest(channel), high = coarsest(channel);
  const std::size_t now = std::clamp(channel.rung, low, high);
  if (!channel.cost.known()) return {now, DecisionReason::no_timings};
  evaluate(channel, input.frame, budget_ms, others);
  std::size_t best = now;
  for (std::size_t r = low; r <= high; ++r)
    if (channel.value[r] > channel.value[best]) best = r;
  const auto error = [&](std::size_t r) { return r == 0 ? 0.0 : channel.ladder[r - 1].error / most_error_; };
  const bool waits = channel.cost.pending_rise() > 0.0;
  if (best == now) {
    if (waits) return {now, DecisionReason::outlier};
    if (!(channel.miss[now] > 0.5)) {
      channel.late = channel.patience = 0;
      return {now, DecisionReason::steady};
    }
    if (now == high) return {now, DecisionReason::at_floor};
    // A jump of the load just as levers moved may have hidden what they save.
    if (channel.patience == 0) channel.patience = tuning_.first_patience;
    if (++channel.late >= channel.patience) {
      channel.cost.forget_shares();
      channel.late = 0;
      channel.patience = std::min(2 * channel.patience, tuning_.most_patience);
    }
    return {now, DecisionReason::late_anyway};
  }
  const double gain = channel.value[best] - channel.value[now];
  const double horizon = waits ? tuning_.outlier_horizon : tuning_.horizon_frames;
  const double price = tuning_.move_price * std::abs(error(best) - error(now));
  const bool reverses = channel.direction * (best > now ? 1 : -1) < 0;
  const double spreads = !reverses ? tuning_.onward_band : best > now ? tuning_.down_band : tuning_.up_band;
  const double band = std::min(spreads * spread_of(channel.cost), tuning_.most_band);
  const bool within = std::abs(channel.log_cost[best] - channel.log_cost[now]) < band;
  if (gain * horizon < price || (within && channel.last_use != TimingUse::step) || (waits && best < now))
    return {now, waits ? DecisionReason::outlier : DecisionReason::dead_band};
  if (best < now) {  // given back a little a frame
    std::size_t to = now - 1;
    while (to > best && error(now) - error(to - 1) <= tuning_.rise_a_frame) --to;
    best = to;
  }
  const bool changed = period_ms_ > 0.0 && std::abs(input.period_ms - period_ms_) > 0.01 * period_ms_;
  const DecisionReason reason = changed ? DecisionReason::refresh_changed
                                : input.frame < foreseen_until_ + 1 && channel.cost.foreseen_variance(input.frame) > 0.0
                                    ? DecisionReason::foreseen_change
                                : channel.last_use == TimingUse::step ? DecisionReason::load_step
                                : waits                               ? DecisionReason::outlier
                                : best > now                          ? DecisionReason::over_budget
                                                                      : DecisionReason::headroom;
  return {best, reason};
}

void AdaptiveQuality::take(Channel& channel, std::size_t rung) {
  if (rung != channel.rung) channel.direction = rung > channel.rung ? 1 : -1;
  channel.rung = rung;
}

bool AdaptiveQuality::without_timings(const FrameInput& input) {
  const std::uint64_t since = last_gpu_timing_.value_or(*first_frame_);
  if (input.frame - since < std::uint64_t(tuning_.blind_frames)) {
    late_intervals_ = intervals_ = 0;
    return false;
  }
  // An interval tells a miss, but no headroom: levels fall if an eighth of frames are late, and do not rise.
  if (input.interval_ms > 0.0) {
    ++intervals_;
    if (input.interval_ms > 1.5 * input.period_ms) ++late_intervals_;
  }
  return true;
}

const Decision& AdaptiveQuality::hold(const FrameInput& input, DecisionReason reason) {
  decision_.frame = input.frame;
  decision_.before = decision_.levels;
  decision_.reason = reason;
  return decision_;
}

LeverLevels AdaptiveQuality::best_at_loading(std::uint64_t frame, double gpu_budget_ms, double cpu_budget_ms) {
  if (!gpu_.cost.known()) return at_loading_;
  // Each combination of the levers that rebuild, with the best rung that it leaves.
  LeverLevels best = at_loading_, tried{};
  double best_value = -1e300;
  for (;;) {
    evaluate(gpu_, frame, gpu_budget_ms, coarser_of(tried, demanded(cpu_)));
    double value = *std::max_element(gpu_.value.begin() + std::ptrdiff_t(finest(gpu_)),
                                     gpu_.value.begin() + std::ptrdiff_t(coarsest(gpu_)) + 1);
    if (cpu_.cost.known()) {
      evaluate(cpu_, frame, cpu_budget_ms, tried);
      value -= tuning_.miss_price * *std::min_element(cpu_.miss.begin(), cpu_.miss.end());
    }
    // Rebuilding for less than this is not worth its wait.
    if (value > best_value + (tried == at_loading_ ? -0.02 : 0.02)) best_value = value, best = tried;
    std::size_t i = 0;
    for (; i < levers_.size(); ++i) {
      if (levers_[i].moves != LeverMoves::at_loading) continue;
      if (std::size_t(tried[i]) + 1 < levers_[i].steps.size()) {
        ++tried[i];
        break;
      }
      tried[i] = 0;
    }
    if (i == levers_.size()) break;
  }
  return best;
}

LeverLevels AdaptiveQuality::best_for_scene(double gpu_ratio, double cpu_ratio) {
  if (!(gpu_budget_ms_ > 0.0)) return at_loading_;
  return best_at_loading(decision_.frame + 1, gpu_budget_ms_ / gpu_ratio, cpu_budget_ms_ / cpu_ratio);
}

const Decision& AdaptiveQuality::decide(const FrameInput& input) {
  assert(input.period_ms > 0.0);
  if (!first_frame_) first_frame_ = input.frame;
  if (!settings_.on) return hold(input, DecisionReason::off);
  if (!input.focused) {
    focused_ = false;
    return hold(input, DecisionReason::unfocused);
  }
  if (!focused_) {  // what was measured meanwhile is of another program's time
    focused_ = true;
    gpu_.cost.doubt(0.1), cpu_.cost.doubt(0.1);
    last_gpu_timing_ = input.frame;
  }
  take_in(input);
  const double rate = settings_.target_hz > 0.0 ? 1000.0 / (input.period_ms * settings_.target_hz) : 1.0;
  const double gpu_budget = rate * (input.deadline_ms > 0.0 ? input.deadline_ms : input.period_ms);
  const double cpu_budget = rate * input.period_ms;
  const LeverLevels before = decision_.levels, loaded = at_loading_;
  if (input.loading) at_loading_ = best_at_loading(input.frame, gpu_budget, cpu_budget);
  const bool blind = without_timings(input);
  Choice cpu = choose(cpu_, input, cpu_budget, at_loading_);
  take(cpu_, cpu.rung);
  Choice gpu = blind ? Choice{gpu_.rung, DecisionReason::no_timings}
                     : choose(gpu_, input, gpu_budget, coarser_of(demanded(cpu_), at_loading_));
  if (blind && intervals_ >= tuning_.blind_frames) {
    if (8 * late_intervals_ >= intervals_ && !(cpu_.cost.known() && cpu_.miss[cpu_.rung] > 0.5))
      gpu = {std::min(gpu_.rung + std::max<std::size_t>(1, gpu_.ladder.size() / 8), coarsest(gpu_)),
             DecisionReason::intervals};
    intervals_ = late_intervals_ = 0;
  }
  take(gpu_, gpu.rung);
  decision_ = {};
  decision_.frame = input.frame;
  decision_.before = before;
  decision_.levels = coarser_of(coarser_of(demanded(gpu_), demanded(cpu_)), at_loading_);
  const auto idle = [](const Choice& choice) {
    return choice.reason == DecisionReason::steady || choice.reason == DecisionReason::dead_band ||
           choice.reason == DecisionReason::no_timings;
  };
  const bool cpu_decides = cpu_.cost.known() && !idle(cpu) && idle(gpu);
  decision_.of = cpu_decides ? CostOf::cpu : CostOf::gpu;
  decision_.reason = loaded != at_loading_ ? DecisionReason::at_loading : cpu_decides ? cpu.reason : gpu.reason;
  describe(input, gpu_budget, cpu_budget);
  period_ms_ = input.period_ms;
  gpu_budget_ms_ = gpu_budget, cpu_budget_ms_ = cpu_budget;
  return decision_;
}

void AdaptiveQuality::describe(const FrameInput& input, double gpu_budget_ms, double cpu_budget_ms) {
  for (Channel* channel : {&gpu_, &cpu_}) {
    if (!channel->cost.known()) continue;
    double log_cost = channel->cost.log_load(input.frame) - std::log(channel->clock);
    for (std::size_t i = 0; i < levers_.size(); ++i)
      if (levers_[i].share(channel->of) > 0.0)
        log_cost += log_factor(channel->cost.share(i), levers_[i].steps[decision_.levels[i]].work);
    channel->cost.record(input.frame, log_cost);
    if (channel->of != decision_.of) continue;
    decision_.predicted_ms = std::exp(log_cost);
    decision_.budget_ms = channel->of == CostOf::gpu ? gpu_budget_ms : cpu_budget_ms;
    decision_.spread = std::max(channel->cost.spread(), channel->cost.forecast_spread());
    decision_.miss_chance =
        tail((std::log(decision_.budget_ms) - log_cost) /
             std::sqrt(std::pow(std::max(decision_.spread, tuning_.least_spread), 2) +
                       channel->cost.model_variance(decision_.levels) + channel->cost.foreseen_variance(input.frame)));
  }
  double error = 0.0;
  for (std::size_t i = 0; i < levers_.size(); ++i)
    if (levers_[i].moves == LeverMoves::between_frames) error += levers_[i].steps[decision_.levels[i]].error;
  decision_.quality = 1.0 - error / most_error_;
}

}  // namespace seascape
