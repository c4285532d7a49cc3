#include "ocean/places/shallow_water.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/dispersion.h"

namespace seascape {

namespace {
constexpr double least_depth_m = 1e-5, most_depth_m = 20000.0;
constexpr int nodes = 2048;
const double first = std::log(least_depth_m), step = (std::log(most_depth_m) - first) / (nodes - 1);
constexpr double power = 6.0;

// Linear theory depends on x = w^2 h / g alone: k h as k / (w^2 / g), the wave number over the deep's, and the speed of
// energy over the deep's g / 2 w.
struct Airy {
  double wave_number, group_speed;
};
Airy airy(double x) {
  const double kh = airy_wave_number(std::sqrt(x), 1.0, 1.0);
  return {kh / x, 2.0 * std::sqrt(x) * airy_group_speed(kh, 1.0, 1.0)};
}

// Waves of a cascade by their frequency: ln(w^2 / g) in steps as wide as the depths' table has them, so that all sums
// over waves and depths meet the same few values of x. A wave is shared between the two frequencies around its own.
struct Waves {
  int from = 0;                      // of the first of the following
  std::vector<double> flux, number;  // variance times cg0 / (g / 2 w), and variance over k0 / (w^2 / g)
  double variance = 0.0;

  void add(double k, double wave_variance, const SeaState& sea) {
    if (!(wave_variance > 0.0) || !(k > 0.0) || !(sea.depth_m > 0.0)) return;
    const double w = airy_frequency(k, sea.gravity_mps2, sea.depth_m), deep_k = w * w / sea.gravity_mps2;
    if (!(deep_k > 1e-30)) return;  // a film of less than 1e-24 m: its waves stand still, and no table goes so far
    const double place = std::log(deep_k) / step, low = std::floor(place), high_share = place - low;
    const double speed = airy_group_speed(k, sea.gravity_mps2, sea.depth_m) * 2.0 * w / sea.gravity_mps2;
    for (const int side : {0, 1}) {
      const double share = wave_variance * (side ? high_share : 1.0 - high_share);
      const std::size_t i = index(int(low) + side);
      flux[i] += share * speed;
      number[i] += share * deep_k / k;
    }
    variance += wave_variance;
  }

 private:
  std::size_t index(int place) {
    if (flux.empty()) from = place;
    if (place < from) {
      flux.insert(flux.begin(), std::size_t(from - place), 0.0),
          number.insert(number.begin(), std::size_t(from - place), 0.0);
      from = place;
    }
    const auto i = std::size_t(place - from);
    if (i >= flux.size()) flux.resize(i + 1, 0.0), number.resize(i + 1, 0.0);
    return i;
  }
};

Waves waves_of(const SeaState& sea, const WaveBins& bins, int index) {
  Waves result;
  const double k_step = 2.0 * std::numbers::pi / bins.ladder[std::size_t(index)].side_m;
  const int half = bins_of(index) / 2;
  // Bins of one |m| have one wave number.
  std::vector<double> by_square(std::size_t(2 * half * half) + 1, 0.0);
  for (int mz = -half; mz < half; ++mz)
    for (int mx = -half; mx < half; ++mx) {
      const glm::dvec2 a(bins.at(index, mx, mz).amplitude);
      by_square[std::size_t(mx * mx + mz * mz)] += 0.5 * glm::dot(a, a);
    }
  for (std::size_t square = 1; square < by_square.size(); ++square)
    result.add(k_step * std::sqrt(double(square)), by_square[square], sea);
  return result;
}
}  // namespace

OtherWaves other_waves(const TileSources& sources) {
  double variance = 0.0, length = 0.0;
  for (const auto& source : sources) {
    const double of_one = source->statistics().height_variance;
    variance += of_one;
    const std::span<const Laying> layings = source->layings();
    for (const Laying& laying : layings)
      length += of_one / double(layings.size()) * 0.5 * std::log(laying.longest_m * laying.shortest_m);
  }
  return variance > 0.0 ? OtherWaves{std::exp(length / variance), 4.0 * std::sqrt(variance)} : OtherWaves{};
}

ShallowWater::ShallowWater(const SeaState& sea, const WaveBins& bins, OtherWaves others) {
  std::vector<Waves> trains;
  for (int i = 0; i < bins.cascades; ++i) trains.push_back(waves_of(sea, bins, i));
  trains.emplace_back();
  if (others.wavelength_m > 0.0)
    trains.back().add(2.0 * std::numbers::pi / others.wavelength_m, others.height_m * others.height_m / 16.0, sea);

  // Every x that is met: ln x = first + (node + place) step.
  int least = 0, most = 0;
  for (const Waves& train : trains) {
    if (train.flux.empty()) continue;
    least = std::min(least, train.from), most = std::max(most, train.from + int(train.flux.size()));
  }
  std::vector<double> wave_number(std::size_t(most - least + nodes)), inverse_speed(wave_number.size());
  for (std::size_t i = 0; i < wave_number.size(); ++i) {
    const Airy a = airy(std::exp(first + (double(i) + least) * step));
    wave_number[i] = a.wave_number, inverse_speed[i] = 1.0 / a.group_speed;
  }

  factors_.assign(trains.size(), Table(nodes));
  steepenings_.assign(trains.size() - 1, Table(nodes));
  left_.resize(nodes), heights_.resize(nodes);
  std::vector<double> shoaling(trains.size());
  for (std::size_t node = 0; node < nodes; ++node) {
    const double depth = std::exp(first + double(node) * step);
    double variance = 0.0;
    for (std::size_t t = 0; t < trains.size(); ++t) {
      const Waves& train = trains[t];
      double flux = 0.0, number = 0.0;
      const std::size_t at = node + std::size_t(train.from - least);
      for (std::size_t i = 0; i < train.flux.size(); ++i)
        flux += train.flux[i] * inverse_speed[at + i], number += train.number[i] * wave_number[at + i];
      shoaling[t] = train.variance > 0.0 ? std::min(std::sqrt(flux / train.variance), most_shoaling) : 1.0;
      if (t < steepenings_.size())
        steepenings_[t][node] = float(train.variance > 0.0 ? std::min(number / train.variance, most_steepening) : 1.0);
      variance += train.variance * shoaling[t] * shoaling[t];
    }
    const double height = 4.0 * std::sqrt(variance),
                 share = std::max(height, least_height_m) / (most_height_of_depth * depth);
    // Of a share above 1 its inverse, whose power does not overflow.
    const double kept = share < 1.0 ? std::pow(1.0 + std::pow(share, power), -1.0 / power)
                                    : std::pow(1.0 + std::pow(share, -power), -1.0 / power) / share;
    for (std::size_t t = 0; t < trains.size(); ++t) factors_[t][node] = float(shoaling[t] * kept);
    left_[node] = float(kept * kept);
    heights_[node] = float(height * kept);
  }
}

float ShallowWater::at(const Table& table, double depth_m) const {
  if (!(depth_m > 0.0)) return 0.0f;
  if (depth_m <= least_depth_m) {
    const double share = depth_m / least_depth_m;
    return float(table[0] * (&table == &left_ ? share * share : share));
  }
  const double place = std::min((std::log(depth_m) - first) / step, double(nodes - 1));
  const std::size_t low = std::min(std::size_t(place), std::size_t(nodes - 2));
  const float between = float(place - double(low));
  return table[low] + (table[low + 1] - table[low]) * between;
}

double ShallowWater::steepening(int cascade, double depth_m) const {
  const Table& table = steepenings_[std::size_t(cascade)];
  return depth_m > least_depth_m ? double(at(table, depth_m)) : double(table[0]);
}

}  // namespace seascape
