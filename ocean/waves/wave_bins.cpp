// The table of waves of a sea: which waves its tiles carry, drawn from the spectrum by key.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/error.h"
#include "ocean/waves/dispersion.h"
#include "ocean/waves/gaussian.h"
#include "ocean/waves/spectrum_table.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

namespace {
constexpr double turn = 2.0 * std::numbers::pi;

// Gauss-Legendre nodes and weights on [-1/2, 1/2].
struct Rule {
  int n;
  std::array<double, 3> node, weight;
};
constexpr Rule two{2, {-0.2886751345948129, 0.2886751345948129}, {0.5, 0.5}};
constexpr Rule three{3, {-0.3872983346207417, 0.0, 0.3872983346207417}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};

// Where the spectrum is asked for a bin's cell, in the tile's own axes and in units of its wave-number step: they are
// the same for every sea and cascade. Cells are integrated over, not sampled at their centre, since a swell may be
// narrower than a bin. Near the origin, where everything varies fast within a cell, the cell is cut up: a peak's width
// is about a seventh of its wave number, so from |m| = 10 on it spans more than a cell, and two nodes a side leave
// errors below 1e-4.
class Cells {
 public:
  struct Node {
    double log_m, to_rad, weight;  // direction clockwise from the tile's -z, -pi to pi; the weights of a cell add to 1
  };
  explicit Cells(int bins) : half_(bins / 2) {
    offset_.reserve(std::size_t(bins) * std::size_t(bins) + 1);
    for (int mz = -half_; mz < half_; ++mz)
      for (int mx = -half_; mx < half_; ++mx) {
        offset_.push_back(nodes_.size());
        add(mx, mz);
      }
    offset_.push_back(nodes_.size());
  }
  const Node* begin(int mx, int mz) const { return &nodes_[offset_[place(mx, mz)]]; }
  const Node* end(int mx, int mz) const { return nodes_.data() + offset_[place(mx, mz) + 1]; }

 private:
  std::size_t place(int mx, int mz) const {
    return std::size_t(mz + half_) * std::size_t(2 * half_) + std::size_t(mx + half_);
  }
  void add(int mx, int mz) {
    const double m = std::hypot(double(mx), double(mz));
    if (m == 0.0 || m >= half_) return;
    const int cuts = m < 7.0 ? 4 : m < 10.0 ? 2 : 1;
    const Rule& rule = m < 7.0 ? three : two;
    for (int j = 0; j < cuts * rule.n; ++j)
      for (int i = 0; i < cuts * rule.n; ++i) {
        const double x = mx + ((i / rule.n + 0.5) - 0.5 * cuts + rule.node[i % rule.n]) / cuts;
        const double z = mz + ((j / rule.n + 0.5) - 0.5 * cuts + rule.node[j % rule.n]) / cuts;
        nodes_.push_back({0.5 * std::log(x * x + z * z), std::atan2(x, -z),
                          rule.weight[i % rule.n] * rule.weight[j % rule.n] / (cuts * cuts)});
      }
  }
  int half_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> offset_;
};

const Cells& cells_of(int cascade) {  // constants, some 6 MB, that every sea asks for
  static const Cells of_longest(bins_of(0)), of_others(bins_of(1));
  return cascade == 0 ? of_longest : of_others;
}

// Frequency of each m^2 = mx^2 + mz^2 below half_bins^2 in turns a tick, times 2^64; 0 where no bin has that m^2.
std::vector<std::uint64_t> turns_of(const SeaState& sea, double side_m, int half_bins) {
  std::vector<std::uint64_t> turns(std::size_t(half_bins) * std::size_t(half_bins), 0);
  const std::int64_t loop = std::llround(sea.loop_s * double(gpu::ticks_per_second));
  for (int a = 0; a < half_bins; ++a)
    for (int b = a; b < half_bins && a * a + b * b < half_bins * half_bins; ++b) {
      std::uint64_t& result = turns[std::size_t(a * a + b * b)];
      if (a + b == 0 || result != 0) continue;
      // Long double keeps all bits that a 64-bit product can use.
      const long double k =
          2.0L * std::numbers::pi_v<long double> / side_m * std::sqrt(static_cast<long double>(a * a + b * b));
      const long double w =
          wave_frequency(k, static_cast<long double>(sea.gravity_mps2), static_cast<long double>(sea.depth_m));
      const long double turns_a_second = w / (2.0L * std::numbers::pi_v<long double>);
      result = loop > 0 && w > 0
                   ? loop_turns(std::max<std::int64_t>(1, std::llround(turns_a_second * sea.loop_s)), loop)
                   : static_cast<std::uint64_t>(std::round(turns_a_second * 0x1p44L));
    }
  return turns;
}
}  // namespace

std::uint64_t loop_turns(std::int64_t turns, std::int64_t ticks) {
  // Long division in steps of 16 bits: no step overflows for loops below 2^47 ticks.
  std::uint64_t quotient = 0, rest = std::uint64_t(turns % ticks);
  for (int i = 0; i < 4; ++i) {
    rest <<= 16;
    quotient = (quotient << 16) | (rest / std::uint64_t(ticks));
    rest %= std::uint64_t(ticks);
  }
  return quotient + (rest > 0);
}

double period_in_loop(double period_s, double loop_s) {
  return loop_s > 0.0 ? loop_s / std::max(std::round(loop_s / period_s), 1.0) : period_s;
}

WaveBins make_wave_bins(const SeaState& sea, const WaveQuality& quality) {
  return make_wave_bins(sea, quality, ladder(sea));
}

WaveBins make_wave_bins(const SeaState& sea, const WaveQuality& quality, const Ladder& ladder) {
  validate(quality);
  const Spectrum spectrum(sea);
  WaveBins result;
  result.ladder = ladder;
  result.cascades = quality.cascades;
  result.bins.assign(WaveBins::first(quality.cascades), gpu::WaveBin{});
  if (!(sea.depth_m > 0.0)) return result;
  const auto step = [&](int index) { return turn / result.ladder[index].side_m; };
  const SpectrumTable table(spectrum, 0.25 * step(0),
                            0.75 * bins_of(quality.cascades - 1) * step(quality.cascades - 1));
  struct Prepared {
    SpectrumTable::Band band;
    std::vector<std::uint64_t> turns;
  };
  std::vector<Prepared> prepared(std::size_t(quality.cascades));
  tbb::parallel_for(0, quality.cascades, [&](int i) {
    prepared[i] = {table.band(result.ladder, i), turns_of(sea, result.ladder[i].side_m, bins_of(i) / 2)};
  });
  // Every bin is a function of its key alone, so the division into threads cannot change it.
  const auto fill_row = [&](int index, int mz) {
    const Cascade& cascade = result.ladder[index];
    const Cells& cells = cells_of(index);
    const int half_bins = bins_of(index) / 2, limit = std::min(tile_samples(quality, index) / 2, half_bins);
    const double log_step = std::log(step(index)), area = step(index) * step(index);
    const double rotation = std::remainder(cascade.rotation_rad, turn);
    for (int mx = -half_bins; mx < half_bins; ++mx) {
      const int m2 = mx * mx + mz * mz;
      if (m2 == 0 || m2 >= limit * limit) continue;
      gpu::WaveBin& bin = result.at(index, mx, mz);
      const std::uint64_t turns = prepared[index].turns[std::size_t(m2)];
      bin.turns_high = std::uint32_t(turns >> 32);
      bin.turns_low = std::uint32_t(turns);
      const double m = std::sqrt(double(m2));
      constexpr double half_diagonal = 0.7072;
      if (step(index) * (m + half_diagonal) <= cascade.k_in[0] || step(index) * (m - half_diagonal) >= cascade.k_out[1])
        continue;
      double density = 0.0;
      for (const Cells::Node* node = cells.begin(mx, mz); node != cells.end(mx, mz); ++node)
        density += node->weight * table(prepared[index].band, node->log_m + log_step, node->to_rad + rotation);
      if (density > 0.0) bin.amplitude = glm::vec2(std::sqrt(density * area) * gaussian_pair(sea.seed, index, mx, mz));
    }
  };
  for (int index = 0; index < quality.cascades; ++index)
    tbb::parallel_for(-bins_of(index) / 2, bins_of(index) / 2, [&](int mz) { fill_row(index, mz); });
  return result;
}

glm::vec2 drawn_amplitude(const gpu::WaveBin& bin, int mx, int mz, int samples) {
  return float(1.0 / sampled_share(mx, mz, samples)) * bin.amplitude;
}

float moment_share(const WaveBins& bins, int cascade, int samples) {
  const int half = bins_of(cascade) / 2;
  double waves = 0.0, texels = 0.0;
  for (int mz = -half; mz < half; ++mz)
    for (int mx = -half; mx < half; ++mx) {
      const glm::dvec2 a(bins.at(cascade, mx, mz).amplitude);
      const double slopes = glm::dot(a, a) * (double(mx) * mx + double(mz) * mz),
                   share = sampled_share(mx, mz, samples);
      waves += slopes;
      texels += slopes / (share * share);
    }
  return texels > 0.0 ? float(waves / texels) : 1.0f;
}

std::int64_t ticks_from_seconds(double time_s) {
  const double ticks = time_s * double(gpu::ticks_per_second);
  if (!(std::abs(ticks) < 0x1p62))
    throw Error("time", "is not a finite number of seconds below 4e12", "give a smaller time");
  return std::llround(ticks);
}

bool keeps_all(const WaveQuality& quality, const WaveBins& bins) {
  bool all = quality.cascades >= bins.cascades;
  for (int i = 0; all && i < bins.cascades; ++i) all = tile_samples(quality, i) >= bins_of(i);
  return all;
}

WaveBins kept_bins(const WaveBins& bins, const WaveQuality& quality) {
  WaveBins result = bins;
  result.cascades = std::min(bins.cascades, quality.cascades);
  result.bins.resize(WaveBins::first(result.cascades));
  for (int i = 0; i < result.cascades; ++i) {
    const int half = bins_of(i) / 2, limit = tile_samples(quality, i) / 2;
    for (int mz = -half; mz < half; ++mz)
      for (int mx = -half; mx < half; ++mx)
        if (mx * mx + mz * mz >= limit * limit) result.at(i, mx, mz) = {};
  }
  return result;
}

}  // namespace seascape
