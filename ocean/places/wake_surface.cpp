#include "ocean/places/wake_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace seascape {

namespace {
constexpr double most_squeeze = 0.8;  // as DynamicSurface has it
// The slopes of all weights together, over half of a window, at most: a presence falls by 1.5 times its mean slope, and
// two windows that change places fall and rise.
constexpr double weights_slope = 2.0 * 1.5 / double(gpu::wake_end - gpu::wake_whole);
}  // namespace

WakeSurface::WakeSurface(const DynamicWavesSettings& settings) : texel_m_(settings.windows.texel_m) {
  parts_.reserve(gpu::max_wake_windows);
  for (int i = 0; i < gpu::max_wake_windows; ++i) parts_.push_back({.surface = DynamicSurface(settings)});
}

void WakeSurface::evaluate(std::span<const Source> windows, double ahead_s, bool velocity) {
  assert(windows.size() <= parts_.size());
  count_ = int(windows.size());
  tbb::parallel_for(std::size_t{0}, windows.size(), [&](std::size_t i) {
    Part& part = parts_[i];
    part.body = windows[i].body;
    part.presence = windows[i].presence;
    part.middle_m = windows[i].middle_m;
    part.surface.evaluate(*windows[i].waves, ahead_s, velocity);
  });
  double squeeze = 0.0;
  for (int level = 0; level < levels(); ++level) {
    double own = 0.0, shift_m = 0.0;
    for (const Part& part : parts()) {
      const DynamicSurface::Extent extent = part.surface.extent(level);
      own = std::max(own, extent.squeeze);
      shift_m = std::max(shift_m, extent.shift_m / part.surface.share());
    }
    squeeze += own + weights_slope * shift_m / half_m(level);
  }
  share_ = squeeze > most_squeeze ? most_squeeze / squeeze : 1.0;
}

DynamicSurface::Extent WakeSurface::extent(int level) const {
  DynamicSurface::Extent most;
  for (const Part& part : parts()) {
    const DynamicSurface::Extent own = part.surface.extent(level);
    most.height_m = std::max(most.height_m, own.height_m);
    most.shift_m = std::max(most.shift_m, share_ * own.shift_m / part.surface.share());
    most.squeeze = std::max(most.squeeze, own.squeeze);
    most.bent_per_m = std::max(most.bent_per_m, own.bent_per_m);
    most.slope_moments = glm::max(most.slope_moments, own.slope_moments);
  }
  return most;
}

bool WakeSurface::still(int level) const {
  return std::ranges::all_of(parts(), [&](const Part& part) { return part.surface.still(level); });
}

bool WakeSurface::near(glm::dvec2 least, glm::dvec2 most, std::uint64_t without) const {
  const auto overlaps = [&](const Part& part, int level) {
    const double reach_m = double(gpu::wake_end) * half_m(level);
    const glm::dvec2 low = part.middle_m[std::size_t(level)] - reach_m,
                     high = part.middle_m[std::size_t(level)] + reach_m;
    return low.x < most.x && low.y < most.y && high.x > least.x && high.y > least.y;
  };
  return std::ranges::any_of(parts(), [&](const Part& part) {
    if (without != 0 && part.body == without) return false;
    for (int level = 0; level < levels(); ++level)
      if (overlaps(part, level)) return true;
    return false;
  });
}

DynamicSample WakeSurface::sea(glm::dvec2 rest, double footprint, std::uint64_t without) const {
  std::array<std::array<double, gpu::max_wake_levels>, gpu::max_wake_windows> weights{};
  for (int level = 0; level < levels(); ++level) {
    const auto l = std::size_t(level);
    float sum = 0.0f, all = 0.0f;
    for (std::size_t i = 0; i < parts().size(); ++i) {
      const Part& part = parts()[i];
      if (without != 0 && part.body == without) continue;
      const float present =
          float(part.presence) * gpu::wake_present(glm::vec2(rest - part.middle_m[l]), float(half_m(level)));
      weights[i][l] = present;
      sum += present;
      all = gpu::wake_joined(all, present);
    }
    const double counts = double(gpu::wake_share(sum, all)) * DynamicSurface::kept(footprint, texel_m(level));
    for (std::size_t i = 0; i < parts().size(); ++i) weights[i][l] *= counts;
  }
  DynamicSample result;
  for (std::size_t i = 0; i < parts().size(); ++i) parts()[i].surface.add(rest, weights[i], share_, result);
  return result;
}

}  // namespace seascape
