#include "app/adaptive/cost_estimator.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace seascape {

namespace {

constexpr double least_share = 0.02, most_share = 0.98;
constexpr double spread_gain = 1.0 / 60.0;
constexpr double clip_sigmas = 3.5;         // a single spike counts as no more in the spread
constexpr double chance_memory = 0.9;       // of the counts of steps and spikes, at each new one
constexpr std::uint64_t kept_frames = 128;  // a foreseen change is merged into the load after that

}  // namespace

CostEstimator::CostEstimator(std::span<const Lever> levers, CostOf of, const CostEstimatorSettings& settings)
    : levers_(levers),
      of_(of),
      settings_(settings),
      states_(levers.size() + 1),
      p_(states_ * states_, 0.0),
      spread_(settings.first_spread),
      forecast_spread_(settings.first_spread) {
  assert(levers.size() <= most_levers);
  p_[0] = 1.0;
  forget_shares();
}

void CostEstimator::forget_shares() {
  for (std::size_t i = 0; i < levers_.size(); ++i) {
    const double share = levers_[i].share(of_);
    state_[i + 1] = share > 0.0 ? std::clamp(share, least_share, most_share) : 0.0;
    for (std::size_t j = 0; j < states_; ++j) p_[(i + 1) * states_ + j] = p_[j * states_ + i + 1] = 0.0;
    p_[(i + 1) * states_ + i + 1] = first_variance(i);
  }
}

double CostEstimator::first_variance(std::size_t lever) const {
  const double share = levers_[lever].share(of_);
  return share > 0.0 ? std::pow(std::min(settings_.share_error, settings_.share_doubt * share), 2) : 0.0;
}

double CostEstimator::modelled(const LeverLevels& levels) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < levers_.size(); ++i)
    if (levels[i] != 0 && state_[i + 1] > 0.0) sum += log_factor(state_[i + 1], levers_[i].steps[levels[i]].work);
  return sum;
}

double CostEstimator::slope(std::size_t lever, std::uint8_t level) const {
  const double share = state_[lever + 1], work = levers_[lever].steps[level].work;
  return share > 0.0 ? (work - 1.0) / (1.0 - share + share * work) : 0.0;
}

void CostEstimator::gradient(const LeverLevels& levels, std::array<double, most_states>& h) const {
  h[0] = 1.0;
  for (std::size_t i = 0; i < levers_.size(); ++i) h[i + 1] = slope(i, levels[i]);
}

CostEstimator::Forecast::Forecast(const CostEstimator& cost, const LeverLevels& levels)
    : cost_(&cost), levels_(levels), log_factors_(cost.modelled(levels)) {
  cost.gradient(levels, h_);
  for (std::size_t i = 0; i < cost.states_; ++i) {
    for (std::size_t j = 0; j < cost.states_; ++j) ph_[i] += cost.p_[i * cost.states_ + j] * h_[j];
    variance_ += h_[i] * ph_[i];
  }
}

void CostEstimator::Forecast::move(std::size_t lever, std::uint8_t level) {
  const double share = cost_->share(lever);
  if (share > 0.0) {
    const std::vector<LeverStep>& steps = cost_->levers_[lever].steps;
    log_factors_ += log_factor(share, steps[level].work) - log_factor(share, steps[levels_[lever]].work);
  }
  const double change = cost_->slope(lever, level) - h_[lever + 1];
  const double* const row = cost_->p_.data() + (lever + 1) * cost_->states_;
  variance_ += change * (2.0 * ph_[lever + 1] + change * row[lever + 1]);
  for (std::size_t i = 0; i < cost_->states_; ++i) ph_[i] += change * row[i];
  h_[lever + 1] += change;
  levels_[lever] = level;
}

void CostEstimator::update(double error, double noise_variance, const std::array<double, most_states>& h) {
  std::array<double, most_states> ph{};
  double s = noise_variance;
  for (std::size_t i = 0; i < states_; ++i) {
    for (std::size_t j = 0; j < states_; ++j) ph[i] += p_[i * states_ + j] * h[j];
    s += h[i] * ph[i];
  }
  for (std::size_t i = 0; i < states_; ++i) {
    state_[i] += ph[i] / s * error;
    for (std::size_t j = 0; j < states_; ++j) p_[i * states_ + j] -= ph[i] * ph[j] / s;
  }
  for (std::size_t i = 1; i < states_; ++i)
    if (levers_[i - 1].share(of_) > 0.0) state_[i] = std::clamp(state_[i], least_share, most_share);
}

double CostEstimator::since(std::uint64_t frame) const {
  double sum = 0.0;
  for (const Foreseen& one : foreseen_)
    if (frame >= one.frame) sum += one.log_ratio;
  return sum;
}

double CostEstimator::log_load(std::uint64_t frame) const { return state_[0] + since(frame); }

double CostEstimator::foreseen_variance(std::uint64_t frame) const {
  double sum = 0.0;
  for (const Foreseen& one : foreseen_)
    if (frame >= one.frame && !one.met) sum += std::pow(settings_.foreseen_error * one.log_ratio, 2);
  return sum;
}

void CostEstimator::foresee(std::uint64_t frame, double ratio) {
  if (!(ratio > 0.0) || !std::isfinite(ratio)) return;
  foreseen_.push_back({frame, std::log(ratio), false});
}

void CostEstimator::doubt(double deviation) {
  p_[0] += deviation * deviation;
  pending_ = false;
}

void CostEstimator::record(std::uint64_t frame, double log_cost) {
  recorded_[frame % recorded_.size()] = {frame, log_cost, true};
}

void CostEstimator::measure_spread(std::uint64_t frame, double load, TimingUse use) {
  // The differences into and out of an outlier are not those of usual frames.
  if (count_ > 0 && frame - last_load_frame_ <= 8 && use != TimingUse::outlier && use != TimingUse::spike) {
    // The mean size of the difference of two normal numbers is 2 sigma / sqrt(pi).
    const double clipped = std::min(std::abs(load - last_load_) * 0.886, clip_sigmas * spread_);
    ++spread_count_;
    const double gain = std::max(spread_gain, 1.0 / (double(spread_count_) + 8.0));
    spread_ = std::max(spread_ + gain * (clipped - spread_), settings_.least_spread);
  }
  last_load_ = load;
  last_load_frame_ = frame;
}

void CostEstimator::compare_with_forecast(std::uint64_t frame, double log_cost) {
  const Recorded& one = recorded_[frame % recorded_.size()];
  if (!one.there || one.frame != frame) return;
  // The mean size of a normal number is sigma sqrt(2 / pi).
  const double clipped = std::min(std::abs(log_cost - one.log_cost) * 1.2533, clip_sigmas * forecast_spread_);
  forecast_spread_ = std::max(forecast_spread_ + spread_gain * (clipped - forecast_spread_), settings_.least_spread);
}

void CostEstimator::count_spike() {
  steps_ *= chance_memory;
  spikes_ = spikes_ * chance_memory + 1.0;
}

TimingUse CostEstimator::resolve(double error, double noise, const LeverLevels& levels,
                                 std::array<double, most_states>& h) {
  double s = noise;
  for (std::size_t i = 0; i < states_; ++i)
    for (std::size_t j = 0; j < states_; ++j) s += h[i] * p_[i * states_ + j] * h[j];
  const bool far = std::abs(error) > std::max(settings_.outlier_sigmas * std::sqrt(s), settings_.least_outlier);
  if (!far) {
    const bool was = pending_;
    if (was) {
      if (pending_error_ > 0.0) count_spike();
      pending_ = false;
    }
    update(error, noise, h);
    return was ? TimingUse::spike : TimingUse::taken;
  }
  if (pending_ && (error > 0.0) == (pending_error_ > 0.0) && std::abs(error) > 0.4 * std::abs(pending_error_)) {
    if (error > 0.0) steps_ = steps_ * chance_memory + 1.0, spikes_ *= chance_memory;
    // Two timings agree: the load is new, and what is known of the shares stays.
    for (std::size_t j = 1; j < states_; ++j) p_[j] = p_[j * states_] = 0.0;
    p_[0] = error * error + noise;
    pending_ = false;
    trend_ = 0.0;
    update(error, noise, h);
    gradient(levels, h);
    return TimingUse::step;
  }
  if (pending_ && pending_error_ > 0.0) count_spike();
  pending_ = true;
  pending_error_ = error;
  return TimingUse::outlier;
}

TimingUse CostEstimator::add(std::uint64_t frame, double cost_ms, double clock, const LeverLevels& levels) {
  if (!(cost_ms > 0.0) || !std::isfinite(cost_ms) || !(clock > 0.0) || !std::isfinite(clock))
    return TimingUse::unusable;
  if (count_ > 0 && frame <= last_frame_) return TimingUse::unusable;
  const double log_work = std::log(cost_ms * clock), log_cost = std::log(cost_ms);
  const double load = log_work - modelled(levels) - since(frame);
  for (Foreseen& one : foreseen_)
    if (!one.met && frame >= one.frame) {
      one.met = true;
      p_[0] += std::pow(settings_.foreseen_error * one.log_ratio, 2);
    }
  if (count_ == 0) {
    state_[0] = load;
    p_[0] = spread_ * spread_;
    measure_spread(frame, load, TimingUse::taken);
    last_frame_ = frame, count_ = 1;
    return TimingUse::taken;
  }
  const double noise = spread_ * spread_, error = load - state_[0];
  const double gap = double(std::min<std::uint64_t>(frame - last_frame_, 16));
  // The smoothed error of independent ones has this deviation; where it is many times that, the load drifts.
  const double g = settings_.trend_gain, signal = std::abs(trend_) / (spread_ * std::sqrt(g / (2.0 - g)));
  const double part =
      std::clamp((signal - settings_.drift_from) / (settings_.drift_to - settings_.drift_from), 0.0, 1.0);
  const double gain = settings_.slow_gain + (settings_.fast_gain - settings_.slow_gain) * part;
  p_[0] += gap * noise * gain * gain / (1.0 - gain);
  for (std::size_t i = 1; i < states_; ++i) {
    double& variance = p_[i * states_ + i];
    if (levers_[i - 1].share(of_) > 0.0)
      variance = std::min(variance + gap * std::pow(settings_.share_drift, 2), first_variance(i - 1));
  }
  std::array<double, most_states> h{};
  gradient(levels, h);
  const TimingUse use = resolve(error, noise, levels, h);
  if (use == TimingUse::taken || use == TimingUse::spike) {
    trend_ += settings_.trend_gain * (error - trend_);
    compare_with_forecast(frame, log_cost);
  }
  if (use == TimingUse::step) recorded_.fill({});  // those forecasts were of another load
  measure_spread(frame, log_work - modelled(levels) - since(frame), use);
  last_frame_ = frame;
  ++count_;
  std::erase_if(foreseen_, [&](const Foreseen& one) {
    if (frame < one.frame + kept_frames) return false;
    state_[0] += one.log_ratio, last_load_ += one.log_ratio;
    return true;
  });
  return use;
}

}  // namespace seascape
