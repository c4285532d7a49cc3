// The table of waves of a sea: which waves its tiles carry, drawn from the spectrum by key.
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <numbers>

#include "engine/error.h"
#include "ocean/waves/gaussian.h"
#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

namespace {
constexpr int half_bins = gpu::wave_bins / 2;

// Gauss-Legendre nodes and weights on [-1/2, 1/2].
struct Rule {
  int n;
  std::array<double, 5> node, weight;
};
constexpr Rule three{3, {-0.3872983346207417, 0.0, 0.3872983346207417}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};
constexpr Rule five{5,
                    {-0.4530899229693320, -0.2692346550528416, 0.0, 0.2692346550528416, 0.4530899229693320},
                    {0.1184634425280945, 0.2393143352496832, 0.2844444444444444, 0.2393143352496832, 0.1184634425280945}};

// Variance of the waves of bin m: the spectrum's share integrated over the bin's cell, not sampled at its centre, since a
// swell may be narrower than a bin. Near the origin, where everything varies fast within a cell, the cell is cut up: a
// peak's width is about a seventh of its wave number, so from |m| = 10 on it spans more than a cell.
double bin_variance(const Spectrum& spectrum, const Ladder& ladder, int index, int mx, int mz) {
  const Cascade& cascade = ladder[index];
  const double step = 2.0 * std::numbers::pi / cascade.side_m;
  const double m = std::hypot(double(mx), double(mz));
  constexpr double half_diagonal = 0.7072;
  if (step * (m + half_diagonal) <= cascade.k_in[0] || step * (m - half_diagonal) >= cascade.k_out[1]) return 0.0;
  const int cuts = m < 4.0 ? 4 : m < 10.0 ? 2 : 1;
  const Rule& rule = cuts == 4 ? five : three;
  const double c = std::cos(cascade.rotation_rad), s = std::sin(cascade.rotation_rad);
  double sum = 0.0;
  for (int j = 0; j < cuts * rule.n; ++j)
    for (int i = 0; i < cuts * rule.n; ++i) {
      const double x = mx + ((i / rule.n + 0.5) - 0.5 * cuts + rule.node[i % rule.n]) / cuts;
      const double z = mz + ((j / rule.n + 0.5) - 0.5 * cuts + rule.node[j % rule.n]) / cuts;
      const glm::dvec2 k{step * (c * x - s * z), step * (s * x + c * z)};
      const double share = band_share(ladder, index, glm::length(k));
      if (share > 0.0) sum += rule.weight[i % rule.n] * rule.weight[j % rule.n] * share * spectrum(k);
    }
  return sum * step * step / (cuts * cuts);
}

// Turns a tick times 2^64: w / (2 pi) * 2^64 / 2^20. Long double keeps all bits that a 64-bit product can use.
std::uint64_t turns_per_tick(double gravity, double side_m, double m2) {
  const long double k = 2.0L * std::numbers::pi_v<long double> / side_m * std::sqrt(static_cast<long double>(m2));
  const long double w = std::sqrt(gravity * k);
  return static_cast<std::uint64_t>(std::round(w / (2.0L * std::numbers::pi_v<long double>)*0x1p44L));
}
}  // namespace

WaveBins make_wave_bins(const SeaState& sea, const WaveQuality& quality) {
  validate(quality);
  const Spectrum spectrum(sea);
  WaveBins result;
  result.ladder = ladder(sea);
  result.cascades = quality.cascades;
  result.bins.assign(std::size_t(quality.cascades) * gpu::wave_bins * gpu::wave_bins, gpu::WaveBin{});
  const double limit = std::min(quality.resolution / 2, half_bins);
  // Every bin is a function of its key alone, so the division into threads cannot change it.
  tbb::parallel_for(0, quality.cascades * gpu::wave_bins, [&](int row) {
    const int index = row / gpu::wave_bins, mz = row % gpu::wave_bins - half_bins;
    for (int mx = -half_bins; mx < half_bins; ++mx) {
      const double m2 = double(mx) * mx + double(mz) * mz;
      if (m2 == 0.0 || m2 >= limit * limit || mx == -half_bins || mz == -half_bins) continue;
      gpu::WaveBin& bin = result.bins[(std::size_t(row) * gpu::wave_bins) + mx + half_bins];
      const std::uint64_t turns = turns_per_tick(sea.gravity_mps2, result.ladder[index].side_m, m2);
      bin.turns_high = std::uint32_t(turns >> 32);
      bin.turns_low = std::uint32_t(turns);
      if (spectrum.flat()) continue;
      const double scale = std::sqrt(bin_variance(spectrum, result.ladder, index, mx, mz));
      bin.amplitude = glm::vec2(scale * gaussian_pair(sea.seed, index, mx, mz));
    }
  });
  return result;
}

std::int64_t ticks_from_seconds(double time_s) {
  const double ticks = time_s * double(gpu::ticks_per_second);
  if (!(std::abs(ticks) < 0x1p62)) throw Error("time", "is not a finite number of seconds below 4e12", "give a smaller time");
  return std::llround(ticks);
}

}  // namespace seascape
