// Rules of picture scale in the field, written anew from the constants that their makers publish.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

#include "app/lab/trace_player.h"

namespace seascape {

namespace {

// The Lab's renderer (Valve, ValveCamera.cs): nine scales 15 % of area apart, by the GPU times of the last three
// frames, with waits after each change.
class Valve : public AreaRule {
 public:
  double area(const PlayedFrame& frame) override {
    for (const PlayedTiming& one : frame.timings) {
      if (!(one.cost_ms > 0.0)) continue;
      shares_.push_front(one.cost_ms / frame.period_ms);
      if (shares_.size() > 3) shares_.pop_back();
    }
    if (wait_ > 0) --wait_;
    if (wait_ == 0 && shares_.size() == 3 && !frame.timings.empty()) decide();
    return scales[std::size_t(level_)] * scales[std::size_t(level_)];
  }

 private:
  void decide() {
    constexpr double high = 0.9, extrapolate = 0.85, low = 0.7;
    const double f0 = shares_[0], f1 = shares_[1], f2 = shares_[2];
    if (f0 > high)
      move(level_ == 2 ? -1 : -2, 1);
    else if (f0 > extrapolate && f0 + std::max(f0 - f1, 0.5 * (f0 - f2)) > high)
      move(-2, f0 - f1 >= 0.5 * (f0 - f2) ? 2 : 3);
    else if (f0 < low && f1 < low && f2 < low)
      move(1, 3);
  }
  void move(int by, int wait) {
    const int to = std::clamp(level_ + by, 0, int(scales.size()) - 1);
    if (to == level_) return;
    level_ = to;
    wait_ = 2 + wait;
  }
  static constexpr std::array scales{0.8, 0.858, 0.92, 0.987, 1.058, 1.135, 1.217, 1.305, 1.399};
  std::deque<double> shares_;
  int level_ = 3, wait_ = 0;
};

// Unreal Engine 5 (DynamicResolution.cpp): a weighted mean of 16 frames, cost taken as proportional to area.
class Unreal : public AreaRule {
 public:
  double area(const PlayedFrame& frame) override {
    ++since_change_;
    for (const PlayedTiming& one : frame.timings) {
      if (!(one.cost_ms > 0.0)) continue;
      history_.push_front({one.cost_ms / frame.period_ms, std::sqrt(one.area / most_area)});
      if (history_.size() > 16) history_.pop_back();
      over_ = one.cost_ms > frame.period_ms ? over_ + 1 : 0;
    }
    if (history_.empty() || frame.timings.empty()) return fraction_ * fraction_ * most_area;
    constexpr double target = 0.9;
    if (over_ >= 2) {  // act at once
      take(history_[0].fraction * std::sqrt(target / history_[0].share));
      history_.clear();
      over_ = 0;
    } else if (since_change_ >= 8) {
      double share = 0.0, mean = 0.0, sum = 0.0, weight = 1.0;
      for (const Entry& one : history_) {
        share += weight * one.share, mean += weight * one.fraction, sum += weight;
        weight *= 0.9;
      }
      double wanted = mean / sum * std::sqrt(target / (share / sum));
      if (wanted > fraction_) wanted = fraction_ + 0.9 * (wanted - fraction_);
      if (std::abs(wanted - fraction_) >= 0.02 * fraction_) take(wanted);
    }
    return fraction_ * fraction_ * most_area;
  }

 private:
  struct Entry {
    double share, fraction;
  };
  void take(double fraction) {
    fraction_ = std::clamp(fraction, std::sqrt(least_area / most_area), 1.0);
    since_change_ = 0;
  }
  std::deque<Entry> history_;
  double fraction_ = std::sqrt(1.0 / most_area);
  int since_change_ = 0, over_ = 0;
};

// Filament (View.cpp, PIDController.h): a PI controller in velocity form on area, on the median of 15 frames.
class Filament : public AreaRule {
 public:
  explicit Filament(double headroom) : headroom_(headroom) {}
  double area(const PlayedFrame& frame) override {
    bool fresh = false;
    for (const PlayedTiming& one : frame.timings) {
      if (!(one.cost_ms > 0.0)) continue;
      history_.push_front(one.cost_ms);
      if (history_.size() > 15) history_.pop_back();
      fresh = true;
    }
    if (fresh) {
      std::vector<double> sorted(history_.begin(), history_.end());
      std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2), sorted.end());
      const double target = (1.0 - headroom_) * frame.period_ms;
      const double error = (target - sorted[sorted.size() / 2]) / target;
      const double integral = std::clamp(integral_ + error, -100.0, 100.0);
      double command = 0.1175 * error + 0.002 * integral;
      if (command > -0.01 && command < 0.05) command = 0.0;
      const double wanted = area_ * (command < 0.0 ? 1.0 / (1.0 - command) : 1.0 + command);
      area_ = std::clamp(wanted, least_area, most_area);
      if (wanted == area_) integral_ = integral;
    }
    return area_;
  }

 private:
  double headroom_, area_ = 1.0, integral_ = 0.0;
  std::deque<double> history_;
};

// Unity's sample (DynamicResolution.cs): down at once by the overshoot, up by small steps when a counter is full.
class Unity : public AreaRule {
 public:
  double area(const PlayedFrame& frame) override {
    for (const PlayedTiming& one : frame.timings) {
      if (!(one.cost_ms > 0.0)) continue;
      const double share = one.cost_ms / frame.period_ms, headroom = 1.0 - share;
      const double delta = last_ > 0.0 ? share - last_ : 0.0;
      last_ = share;
      if (headroom < 0.0) {
        scale_ *= 1.0 + headroom;  // of the scale, in each direction
        counter_ = 0;
      } else {
        ++counter_;
        if (headroom > 0.06 && delta < 0.035) counter_ += 3;
        if (delta < 0.0) counter_ += 10;
        if (counter_ >= 360) {
          scale_ *= 1.0 + 0.009 + (0.035 - 0.009) * std::clamp((headroom - 0.06) / 0.34, 0.0, 1.0);
          counter_ = 0;
        }
      }
      scale_ = std::clamp(scale_, std::sqrt(least_area), std::sqrt(most_area));
    }
    return scale_ * scale_;
  }

 private:
  double scale_ = 1.0, last_ = 0.0;
  int counter_ = 0;
};

}  // namespace

std::unique_ptr<AreaRule> valve() { return std::make_unique<Valve>(); }
std::unique_ptr<AreaRule> unreal() { return std::make_unique<Unreal>(); }
std::unique_ptr<AreaRule> filament(double headroom) { return std::make_unique<Filament>(headroom); }
std::unique_ptr<AreaRule> unity() { return std::make_unique<Unity>(); }

std::span<const NamedRule> field_rules() {
  static const NamedRule rules[] = {
      {"ours", [] { return ours(); }},
      {"Valve", valve},
      {"Unreal", unreal},
      {"Filament", [] { return filament(0.0); }},
      {"Filament, 10 % headroom", [] { return filament(0.1); }},
      {"Unity", unity},
  };
  return rules;
}

}  // namespace seascape
