#include "ocean/waves/ladder.h"

#include <algorithm>
#include <numbers>

#include "ocean/waves/spectrum.h"

namespace seascape {

namespace {
constexpr double longest_side = 16937.0,
                 longest_last = 2.47;  // sides of the first and the last tile of the longest class
constexpr int classes = 8;             // each half as long as the one before
constexpr int straight = 3;            // of them; the rest are warped
// Share of the variance that the shorter tiles may carry. The last straight class may leave more: it has tiled no more
// than is allowed with what the next one would take over, and a warped sea's copies add next to nothing.
constexpr double most_left(int index) { return index + 1 < straight ? 0.125 : 0.15; }
constexpr double no_help = 0.5;  // of ripples that even the last class leaves, and a tile of 4.2 km may as well
// A warped tile has no place for waves that are long beside it: their copies are hardly shifted, and few bins hold
// them.
constexpr double long_beside = 1.0 / 16.0, most_long = 0.02;
// |m| between which a tile hands over to the next.
constexpr std::array<double, 2> fade{25.0, 31.0}, long_fade{108.0, 127.0};
constexpr double golden_quarter = 0.9708055193627733;  // 90 degrees divided by the golden ratio: lattices never line up
// Off the geometric row by a little, so that no side is near a whole multiple of another.
constexpr std::array<double, gpu::max_cascades> jitter{1.0, 1.0263, 0.9881, 1.0117, 1.0};

// The variance of waves longer than 2 pi / k for each k of `ks`, which rise, over that of all.
template <std::size_t N>
std::array<double, N> share_below(const SeaState& sea, const std::array<double, N>& ks) {
  const Spectrum spectrum(sea);
  std::array<double, N> below{};
  double all = 0.0;
  constexpr double from = 1e-4, to = 60.0, step = 0.02;  // rad/m; over ln k. Narrow swells are some ten steps wide
  for (double ln_k = std::log(from); ln_k < std::log(to); ln_k += step) {
    const double k = std::exp(ln_k);
    double density = 0.0;
    for (int component = 0; component < Spectrum::components; ++component)
      if (spectrum.present(component)) density += spectrum.radial(component, k);
    all += density * k * k;
    for (std::size_t i = 0; i < N; ++i)
      if (k < ks[i]) below[i] += density * k * k;
  }
  for (double& share : below) share = all > 0.0 ? share / all : 1.0;
  return below;
}

double share_above(double k, const std::array<double, 2>& edge) {
  if (edge[1] <= 0.0 || k >= edge[1]) return 1.0;
  if (k <= edge[0]) return 0.0;
  const double t = std::log(k / edge[0]) / std::log(edge[1] / edge[0]);
  return t * t * (3.0 - 2.0 * t);
}
}  // namespace

Ladder ladder(const SeaState& sea) {
  std::array<double, 2 * classes> edges;  // where each class hands over, and what is long beside it
  for (int i = 0; i < classes; ++i) {
    edges[i] = std::numbers::pi * (long_fade[0] + long_fade[1]) * std::exp2(i) / longest_side;
    edges[classes + i] = 2.0 * std::numbers::pi * std::exp2(i) / (long_beside * longest_side);
  }
  int chosen = straight - 1;
  if (longest_peak_wave_m(sea) > 0.0) {
    const auto below = share_below(sea, edges);
    const auto fits = [&](int index) { return index < straight || below[classes + index] <= most_long; };
    chosen = 0;
    while (chosen + 1 < classes && 1.0 - below[chosen] > most_left(chosen) && fits(chosen + 1)) ++chosen;
    if (1.0 - below[chosen] > no_help) chosen = straight - 1;
  }
  const double first = longest_side * std::exp2(-chosen),
               last = longest_last * std::pow(0.78, std::min(chosen, straight - 1));
  // The wave at which each tile hands over falls by one ratio.
  const auto middle = [](const std::array<double, 2>& edge) { return 0.5 * (edge[0] + edge[1]); };
  const double longest = first / middle(long_fade), shortest = last / middle(fade);
  const double ratio = std::pow(longest / shortest, 1.0 / (gpu::max_cascades - 1));

  Ladder result{};
  for (int i = 0; i < gpu::max_cascades; ++i) {
    Cascade& c = result[i];
    c.side_m = (i == 0 ? first : longest * std::pow(ratio, -i) * middle(fade)) * jitter[i];
    c.rotation_rad = 0.2137 + i * golden_quarter;
    const double step = 2.0 * std::numbers::pi / c.side_m;
    const auto& edge = i == 0 ? long_fade : fade;
    c.k_out = {edge[0] * step, edge[1] * step};
    c.k_in = i == 0 ? std::array<double, 2>{0.0, 0.0} : result[i - 1].k_out;
    c.warped = i == 0 && chosen >= straight;
  }
  return result;
}

double band_share(const Ladder& ladder, int index, double k) {
  return share_above(k, ladder[index].k_in) * (1.0 - share_above(k, ladder[index].k_out));
}

double longest_wave(const Cascade& cascade) {
  const double k = std::max(cascade.k_in[0], 2.0 * std::numbers::pi / cascade.side_m);
  return 2.0 * std::numbers::pi / k;
}

double kept_share(double longest_m, double footprint_m) {
  return std::clamp(2.0 - 2.0 * footprint_m / longest_m, 0.0, 1.0);
}

double shortest_wave(const Cascade& cascade) { return 2.0 * std::numbers::pi / cascade.k_out[1]; }

double sampled_share(int mx, int mz, int samples) {
  const auto axis = [&](int m) {
    const double x = std::numbers::pi * std::min(std::abs(m) / double(samples), 0.25);
    const double sinc = x > 0.0 ? std::sin(x) / x : 1.0;
    return sinc * sinc;
  };
  return axis(mx) * axis(mz);
}

}  // namespace seascape
