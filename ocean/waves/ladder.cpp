#include "ocean/waves/ladder.h"

#include <algorithm>
#include <numbers>

#include "ocean/waves/spectrum.h"

namespace seascape {

namespace {
constexpr double waves_of_longest_tile = 18.0;  // peak waves along the longest tile
constexpr double fade_from = 25.0, fade_to = 31.0;  // |m| between which a tile hands over to the next
constexpr double golden_quarter = 0.9708055193627733;  // 90 degrees divided by the golden ratio: lattices never line up
// Off the geometric row by a little, so that no side is near a whole multiple of another.
constexpr std::array<double, gpu::max_cascades> jitter{1.0, 1.0173, 0.9881, 1.0117, 1.0};

double share_above(double k, const std::array<double, 2>& edge) {
  if (edge[1] <= 0.0 || k >= edge[1]) return 1.0;
  if (k <= edge[0]) return 0.0;
  const double t = std::log(k / edge[0]) / std::log(edge[1] / edge[0]);
  return t * t * (3.0 - 2.0 * t);
}
}  // namespace

Ladder ladder(const SeaState& sea) {
  const double longest = longest_peak_wave_m(sea);
  // Classes 0 to 3 are factors of 1/4 to 2 on 1500 m.
  const double ideal = longest > 0.0 ? std::round(std::log2(waves_of_longest_tile * longest / 1500.0)) : -2.0;
  const double scale = std::exp2(std::clamp(ideal, -2.0, 1.0));
  const double first = 1499.3 * scale;
  const double last = 1.73 * std::pow(scale, 0.7);
  const double ratio = std::pow(first / last, 1.0 / (gpu::max_cascades - 1));

  Ladder result{};
  for (int i = 0; i < gpu::max_cascades; ++i) {
    Cascade& c = result[i];
    c.side_m = first * std::pow(ratio, -i) * jitter[i];
    c.rotation_rad = 0.2137 + i * golden_quarter;
    const double step = 2.0 * std::numbers::pi / c.side_m;
    c.k_out = {fade_from * step, fade_to * step};
    c.k_in = i == 0 ? std::array<double, 2>{0.0, 0.0} : result[i - 1].k_out;
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

double kept_share(const Cascade& cascade, double footprint_m) {
  return std::clamp(2.0 - 2.0 * footprint_m / longest_wave(cascade), 0.0, 1.0);
}

}  // namespace seascape
