#include "ocean/waves/pattern_moments.h"

#include <cmath>
#include <numbers>

namespace seascape {

PatternMoments pattern_moments(const WaveBins& bins, int index) {
  const Cascade& cascade = bins.ladder[std::size_t(index)];
  const int half = bins_of(index) / 2;
  PatternMoments sum;
  const double dk = 2.0 * std::numbers::pi / cascade.side_m, c = std::cos(cascade.rotation_rad),
               s = std::sin(cascade.rotation_rad);
  for (int mz = -half; mz < half; ++mz)
    for (int mx = -half; mx < half; ++mx) {
      const gpu::WaveBin& bin = bins.at(index, mx, mz);
      const double power =
          0.5 * (double(bin.amplitude.x) * bin.amplitude.x + double(bin.amplitude.y) * bin.amplitude.y);
      const double kx = dk * (c * mx - s * mz), kz = dk * (s * mx + c * mz);
      sum.height_variance += power;
      sum.slope_moments += power * glm::dvec3(kx * kx, kz * kz, kx * kz);
    }
  return sum;
}

PatternMoments pattern_moments(const TileSource& source, const Laying& laying) {
  double squares = 0.0;
  for (const Laying& one : source.layings()) squares += one.size * one.size;
  const SourceStatistics statistics = source.statistics();
  return {statistics.height_variance * laying.size * laying.size / squares, statistics.slope_moments};
}

}  // namespace seascape
