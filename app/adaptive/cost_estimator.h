// What a frame would cost at given lever levels, learnt from timings that arrive late, out of order or not at all.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "app/adaptive/lever.h"

namespace seascape {

// What became of a timing.
enum class TimingUse : std::uint8_t {
  unusable,  // zero, negative, not finite, or older than one already used
  taken,
  outlier,  // far from the forecast; the next timing tells a single spike from a step
  step,     // the second of two such: the load has changed
  spike,    // taken, and the one before it was a single spike
};

struct CostEstimatorSettings {
  double share_error = 0.25;    // standard deviation of a lever's first guess of its share, at most;
  double share_doubt = 0.6;     // and as a part of the guess
  double share_drift = 2e-4;    // by which shares may change in a frame, standard deviation
  double first_spread = 0.03;   // of the cost between frames, before it is measured: relative standard deviation
  double least_spread = 0.003;  // floor on the measured one
  double outlier_sigmas = 4.5;  // a timing so far from its forecast is an outlier
  double least_outlier = 0.05;  // and at least so far, relative
  double slow_gain = 0.015;     // of the load's filter while it is steady
  double fast_gain = 0.5;       // while it drifts
  // The load drifts if its errors keep one sign: their smoothed mean (Trigg and Leach 1967) is more than drift_from
  // of its own standard deviations; from drift_to on the gain is the fast one.
  double trend_gain = 0.12, drift_from = 3.2, drift_to = 5.0;
  double foreseen_error = 0.25;  // standard deviation of a foreseen change, as a part of its logarithm
};

// The model: cost = load x product over levers (1 - share + share x work). One extended Kalman filter over the
// logarithm of the load and the shares (Kalman 1960; the logarithm makes noise and levers additive). A timing is always
// compared with the model at the levels that made it, so the forecast holds whatever is in flight: the dead time of
// measuring, reading back and applying is outside the loop (Smith 1957).
class CostEstimator {
 public:
  // `levers` must outlive this.
  CostEstimator(std::span<const Lever> levers, CostOf of, const CostEstimatorSettings& settings = {});

  // A frame's cost, ms, and the levels it was drawn with. `clock`: the processor's clock then, relative to its highest;
  // the load is counted in work, ms at the highest clock.
  TimingUse add(std::uint64_t frame, double cost_ms, double clock, const LeverLevels& levels);

  // From this frame on, the load will be `ratio` times what it was. May be called ahead of time or afterwards; timings
  // of older frames are then scaled.
  void foresee(std::uint64_t frame, double ratio);

  // Widens the load's variance: it may have changed unseen (standard deviation of its logarithm).
  void doubt(double deviation);

  // What was learnt of the levers: the first guesses count again.
  void forget_shares();

  bool known() const { return count_ > 0; }
  std::uint64_t last_frame() const { return last_frame_; }

  // Natural logarithms, at the highest clock: the load of that frame, and its variance without foreseen changes.
  double log_load(std::uint64_t frame) const;
  double load_variance() const { return p_[0]; }
  // Added to a forecast of that frame for foreseen changes not yet measured.
  double foreseen_variance(std::uint64_t frame) const;
  double share(std::size_t lever) const { return state_[lever + 1]; }
  // The variance of a forecast's logarithm at these levels: of the load and of the shares, without the spread.
  double model_variance(const LeverLevels& levels) const { return Forecast(*this, levels).variance(); }

  // A forecast's logarithm without the load, and its variance, as levels move one at a time.
  class Forecast {
   public:
    Forecast(const CostEstimator& cost, const LeverLevels& levels);
    void move(std::size_t lever, std::uint8_t level);
    double log_factors() const { return log_factors_; }
    double variance() const { return variance_ > 0.0 ? variance_ : 0.0; }

   private:
    const CostEstimator* cost_;
    LeverLevels levels_;
    std::array<double, most_levers + 1> h_{}, ph_{};  // the gradient, and the covariance times it
    double log_factors_, variance_ = 0.0;
  };

  // The standard deviation of single frames about the load, relative (robust: single spikes do not widen it).
  double spread() const { return spread_; }
  // The same about the forecasts that were recorded ahead of the frames; includes drift and lag.
  double forecast_spread() const { return forecast_spread_; }
  // The forecast that a frame's levels were chosen by.
  void record(std::uint64_t frame, double log_cost);

  // An upward outlier waits for its second: by how much (logarithm) and how likely it is a step and no spike, from
  // those seen so far (Laplace's rule). 0 and 0 otherwise.
  double pending_rise() const { return pending_ && pending_error_ > 0.0 ? pending_error_ : 0.0; }
  double step_chance() const { return (steps_ + 1.0) / (steps_ + spikes_ + 2.0); }

 private:
  struct Foreseen {
    std::uint64_t frame;
    double log_ratio;
    bool met;  // a timing from after it has been used
  };
  struct Recorded {
    std::uint64_t frame = 0;
    double log_cost = 0.0;
    bool there = false;
  };
  static constexpr std::size_t most_states = most_levers + 1;

  double modelled(const LeverLevels& levels) const;
  double slope(std::size_t lever, std::uint8_t level) const;
  double first_variance(std::size_t lever) const;
  void gradient(const LeverLevels& levels, std::array<double, most_states>& h) const;
  void update(double error, double noise_variance, const std::array<double, most_states>& h);
  double since(std::uint64_t frame) const;
  void count_spike();
  void measure_spread(std::uint64_t frame, double load, TimingUse use);
  void compare_with_forecast(std::uint64_t frame, double log_cost);
  TimingUse resolve(double error, double noise, const LeverLevels& levels, std::array<double, most_states>& h);

  std::span<const Lever> levers_;
  CostOf of_;
  CostEstimatorSettings settings_;
  std::size_t states_;
  std::array<double, most_states> state_{};  // log load, then shares
  std::vector<double> p_;                    // covariance, states_ x states_
  std::vector<Foreseen> foreseen_;
  std::array<Recorded, 64> recorded_{};
  std::uint64_t last_frame_ = 0, count_ = 0;
  double spread_, forecast_spread_;
  double last_load_ = 0.0;
  std::uint64_t last_load_frame_ = 0, spread_count_ = 0;
  double trend_ = 0.0;  // smoothed error
  bool pending_ = false;
  double pending_error_ = 0.0;
  double steps_ = 0.0, spikes_ = 0.0;
};

}  // namespace seascape
