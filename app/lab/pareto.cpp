#include "app/lab/pareto.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace seascape {

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
  for (const Tradeoff& other : others)
    if (other.error <= point.error && other.time < point.time)
      off = std::max(off, other.time > 0.0 ? point.time / other.time : std::numeric_limits<double>::infinity());
  return off;
}

std::vector<std::size_t> near_front(std::span<const Tradeoff> points, double times) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (off_front(points[i], points) <= times) near.push_back(i);
  return near;
}

}  // namespace seascape
