#include "app/statistics.h"

#include <algorithm>
#include <cmath>

namespace seascape {

double percentile(std::span<const double> sorted, double fraction) {
  if (sorted.empty()) return 0.0;
  const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  const double part = place - static_cast<double>(below);
  return sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

Interval median_interval(std::span<const double> samples) {
  if (samples.empty()) return {};
  std::vector<double> sorted(samples.begin(), samples.end());
  std::sort(sorted.begin(), sorted.end());
  const double count = static_cast<double>(sorted.size());
  const double rank = std::floor(0.5 * (count - 1.96 * std::sqrt(count)));  // so many samples lie below the bound
  const std::size_t low = rank > 0.0 ? static_cast<std::size_t>(rank) : 0;
  return {sorted[low], percentile(sorted, 0.5), sorted[sorted.size() - 1 - low]};
}

Summary summarise(std::span<const double> samples) {
  std::vector<double> sorted;
  sorted.reserve(samples.size());
  for (const double sample : samples)
    if (std::isfinite(sample)) sorted.push_back(sample);
  Summary summary;
  summary.count = sorted.size();
  summary.not_finite = samples.size() - sorted.size();
  if (sorted.empty()) return summary;
  std::sort(sorted.begin(), sorted.end());
  double mean = 0.0;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    mean += (sorted[i] - mean) / static_cast<double>(i + 1);  // no sum to overflow
  summary.mean = mean;
  summary.min = sorted.front();
  summary.max = sorted.back();
  summary.p5 = percentile(sorted, 0.05);
  summary.median = percentile(sorted, 0.5);
  summary.p95 = percentile(sorted, 0.95);
  summary.p99 = percentile(sorted, 0.99);
  return summary;
}

bool is_missed(double frame_ms, int rate_hz) { return !(frame_ms <= budget_ms(rate_hz)); }

std::size_t count_missed(std::span<const double> frame_ms, int rate_hz) {
  return static_cast<std::size_t>(
      std::count_if(frame_ms.begin(), frame_ms.end(), [&](double ms) { return is_missed(ms, rate_hz); }));
}

}  // namespace seascape
