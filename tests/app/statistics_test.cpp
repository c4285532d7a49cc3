#include "app/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace seascape {
namespace {

// Control: the nearest rank instead of a straight line gives 2 for the median of 1, 2, 3, 4.
TEST(Statistics, PercentilesOfKnownSamples) {
  std::vector<double> samples;
  for (int i = 100; i >= 0; --i) samples.push_back(i);  // 0 to 100: the percentile is its own value
  const Summary summary = summarise(samples);
  EXPECT_EQ(summary.count, 101u);
  EXPECT_DOUBLE_EQ(summary.min, 0.0);
  EXPECT_DOUBLE_EQ(summary.p5, 5.0);
  EXPECT_DOUBLE_EQ(summary.median, 50.0);
  EXPECT_DOUBLE_EQ(summary.p95, 95.0);
  EXPECT_DOUBLE_EQ(summary.p99, 99.0);
  EXPECT_DOUBLE_EQ(summary.max, 100.0);
  EXPECT_DOUBLE_EQ(summary.mean, 50.0);
  const std::vector<double> four{4.0, 1.0, 3.0, 2.0};
  EXPECT_DOUBLE_EQ(summarise(four).median, 2.5);
  EXPECT_NEAR(summarise(four).p95, 3.85, 1e-12);  // R's quantile(1:4, 0.95, type = 7)
}

// The bounds hold the true median 95 times of 100, of samples far from normal. Control seen: bounds two thirds as far
// apart (0.73).
TEST(Statistics, TheMediansIntervalHoldsIt) {
  std::mt19937 random(3);
  std::exponential_distribution<double> skewed(1.0);
  for (const int count : {20, 100, 1000}) {
    int held = 0;
    double width = 0.0;
    constexpr int trials = 2000;
    for (int trial = 0; trial < trials; ++trial) {
      std::vector<double> samples(static_cast<std::size_t>(count));
      for (double& one : samples) one = skewed(random);
      const Interval interval = median_interval(samples);
      EXPECT_LE(interval.low, interval.middle);
      EXPECT_LE(interval.middle, interval.high);
      held += interval.low <= std::log(2.0) && std::log(2.0) <= interval.high;
      width += (interval.high - interval.low) / trials;
    }
    EXPECT_GT(held, trials * 93 / 100) << count;
    EXPECT_LT(held, trials * 98 / 100) << count;
    // The median's deviation is 1 / (2 f sqrt(n)) with the density f = 1/2 there.
    EXPECT_NEAR(width, 2.0 * 1.96 / std::sqrt(count), 0.25 * width) << count;
  }
  EXPECT_EQ(median_interval({}).high, 0.0);
  const std::vector<double> few{3.0, 1.0, 2.0};
  EXPECT_EQ(median_interval(few).low, 1.0);
  EXPECT_EQ(median_interval(few).middle, 2.0);
  EXPECT_EQ(median_interval(few).high, 3.0);
}

// Control: without the early return of no samples the mean is 0/0.
TEST(Statistics, FewSamples) {
  EXPECT_EQ(summarise({}).count, 0u);
  EXPECT_EQ(summarise({}).median, 0.0);
  const std::vector<double> one{7.0};
  const Summary summary = summarise(one);
  for (const double value :
       {summary.min, summary.p5, summary.median, summary.p95, summary.p99, summary.max, summary.mean})
    EXPECT_EQ(value, 7.0);
}

// Control: with isfinite left out sorting puts NaN anywhere and the mean is NaN.
TEST(Statistics, NotFiniteIsCountedApart) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> samples{nan, 3.0, infinity, 1.0, -infinity, 2.0};
  const Summary summary = summarise(samples);
  EXPECT_EQ(summary.count, 3u);
  EXPECT_EQ(summary.not_finite, 3u);
  EXPECT_EQ(summary.median, 2.0);
  EXPECT_EQ(summary.mean, 2.0);
}

// Control: a plain sum of these overflows to infinity.
TEST(Statistics, HugeSamples) {
  const std::vector<double> samples(10, 1.5e308);
  EXPECT_DOUBLE_EQ(summarise(samples).mean, 1.5e308);
}

// Control: >= in place of > counts the frame that is exactly on its budget.
TEST(Statistics, MissedFrames) {
  const double budget = 1000.0 / 90.0;
  const std::vector<double> times{budget, std::nextafter(budget, 100.0), 13.0, 14.0, 8.0, std::nan("")};
  EXPECT_EQ(count_missed(times, 90), 4u);  // just over, 13, 14 and the one without a time
  EXPECT_EQ(count_missed(times, 72), 2u);  // 14 > 13.89
  EXPECT_EQ(count_missed(times, 80), 3u);
  EXPECT_EQ(count_missed(times, 120), 5u);  // all but 8 ms
}

}  // namespace
}  // namespace seascape
