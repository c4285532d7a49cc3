#include "app/lab/wave_sum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seascape {

double wave_sum(const WaveBins& bins, int cascade, int half_band, std::int64_t ticks, glm::dvec2 at) {
  double sum = 0.0;
  const int half = std::min(bins_of(cascade) / 2, half_band);
  for (int mz = 1 - half; mz < half; ++mz)
    for (int mx = 1 - half; mx < half; ++mx) {
      const gpu::WaveBin& bin = bins.at(cascade, mx, mz);
      if (bin.amplitude == glm::vec2(0.0f)) continue;
      const std::uint64_t turns =
          (std::uint64_t(bin.turns_high) << 32 | bin.turns_low) * std::uint64_t(ticks);  // whole turns fall off
      const double phase = 2.0 * std::numbers::pi * (mx * at.x + mz * at.y - std::ldexp(double(turns), -64));
      sum += double(bin.amplitude.x) * std::cos(phase) - double(bin.amplitude.y) * std::sin(phase);
    }
  return sum;
}

}  // namespace seascape
