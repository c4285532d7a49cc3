// Percentiles of frame times, and how often a display's rate would have been missed.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace seascape {

inline constexpr int display_rates_hz[] = {72, 80, 90, 120};

inline constexpr double budget_ms(int rate_hz) { return 1000.0 / rate_hz; }

struct Summary {
  std::size_t count = 0;       // finite samples, which all below are of
  std::size_t not_finite = 0;  // NaN and infinity, left out
  double min = 0.0, max = 0.0, mean = 0.0;
  double p5 = 0.0, median = 0.0, p95 = 0.0, p99 = 0.0;
};

// `fraction` from 0 to 1 of samples sorted ascending; between two of them in a straight line (Hyndman and Fan 1996,
// "Sample quantiles in statistical packages", definition 7). 0 of none.
double percentile(std::span<const double> sorted, double fraction);

struct Interval {
  double low = 0.0, middle = 0.0, high = 0.0;
};

// The median of what `samples` are drawn from, with bounds that hold it 95 times of 100 whatever their distribution:
// two of the samples, by the binomial law of how many lie below the median (Conover 1999, "Practical nonparametric
// statistics", section 3.2, normal approximation; the least and the greatest of fewer than 6). `samples` are finite;
// all 0 of none.
Interval median_interval(std::span<const double> samples);

// All zero of no samples.
Summary summarise(std::span<const double> samples);

// How many samples are over the budget of `rate_hz`; exactly on it is no miss, NaN is one.
std::size_t count_missed(std::span<const double> frame_ms, int rate_hz);
bool is_missed(double frame_ms, int rate_hz);

}  // namespace seascape
