#include "app/lab/pareto.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace seascape {

namespace {

double times_more(double mine, double other) {
  if (mine <= other) return 1.0;
  return other > 0.0 ? mine / other : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<std::size_t> pareto_front(std::span<const Tradeoff> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].time != points[b].time ? points[a].time < points[b].time : points[a].error < points[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  return front;
}

double off_front(const Tradeoff& point, std::span<const Tradeoff> others) {
  double off = 1.0;
  for (const Tradeoff& other : others) {
    if (other.time > point.time || other.error > point.error) continue;
    off = std::max(off, std::min(times_more(point.time, other.time), times_more(point.error, other.error)));
  }
  return off;
}

}  // namespace seascape
