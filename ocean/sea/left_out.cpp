#include "ocean/sea/left_out.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace seascape {

double left_out_variance(const WaveBins& bins, const WaveQuality& quality) {
  double sum = 0.0;
  for (int cascade = 0; cascade < bins.cascades; ++cascade) {
    const int half = bins_of(cascade) / 2, samples = tile_samples(quality, cascade);
    const bool kept = cascade < quality.cascades;
    // Of one axis: what linear interpolation keeps of a wave, its mean square, and by how much tiles raise it.
    struct Axis {
      double keeps, square, raise;
    };
    std::vector<Axis> axis;
    for (int m = 0; kept && m <= half; ++m) {
      const double x = std::numbers::pi * m / samples, sinc = m == 0 ? 1.0 : std::sin(x) / x;
      axis.push_back({sinc * sinc, (2.0 + std::cos(2.0 * x)) / 3.0, 1.0 / sampled_share(m, 0, samples)});
    }
    for (int mz = -half; mz < half; ++mz)
      for (int mx = -half; mx < half; ++mx) {
        const glm::dvec2 amplitude(bins.at(cascade, mx, mz).amplitude);
        const double variance = 0.5 * glm::dot(amplitude, amplitude);
        if (!(variance > 0.0)) continue;
        if (!kept || mx * mx + mz * mz >= samples * samples / 4) {
          sum += variance;
          continue;
        }
        const Axis &u = axis[std::size_t(std::abs(mx))], &v = axis[std::size_t(std::abs(mz))];
        const double raise = u.raise * v.raise;
        sum += variance * (raise * raise * u.square * v.square - 2.0 * raise * u.keeps * v.keeps + 1.0);
      }
  }
  return sum;
}

}  // namespace seascape
