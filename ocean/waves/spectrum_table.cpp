#include "ocean/waves/spectrum_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace seascape {

namespace {
constexpr double pi = std::numbers::pi;
}

SpectrumTable::SpectrumTable(const Spectrum& spectrum, double k_least, double k_most) : first_(std::log(k_least)) {
  const int rows = int((std::log(k_most) - first_) / (step * nodes_a_row)) + 3;
  nodes_ = (rows - 1) * nodes_a_row + 1;
  for (int c = 0; c < Spectrum::components; ++c) {
    if (!spectrum.present(c)) continue;
    to_rad_[c] = spectrum.to_rad(c);
    radial_[c].assign(std::size_t(nodes_), 0.0);
    spread_[c].assign(std::size_t(rows) * angles, 0.0);
  }
  // Every row is a function of its place alone, so the division into threads cannot change it.
  tbb::parallel_for(0, rows, [&](int row) {
    const int from = row * nodes_a_row, to = std::min(from + nodes_a_row, nodes_);
    for (int c = 0; c < Spectrum::components; ++c) {
      if (radial_[c].empty()) continue;
      for (int i = from; i < to; ++i) radial_[c][i] = spectrum.radial(c, std::exp(first_ + i * step));
      tabulate_spreading(spectrum.shape(c, std::exp(first_ + from * step)),
                         {&spread_[c][std::size_t(row) * angles], angles});
    }
  });
}

SpectrumTable::Band SpectrumTable::band(const Ladder& ladder, int index) const {
  std::vector<double> share(std::size_t(nodes_), 0.0);
  for (int i = 0; i < nodes_; ++i) share[i] = band_share(ladder, index, std::exp(first_ + i * step));
  Band result;
  for (int c = 0; c < Spectrum::components; ++c) {
    if (radial_[c].empty()) continue;
    Band::Train train{c, to_rad_[c], radial_[c]};
    double largest = 0.0;
    for (int i = 0; i < nodes_; ++i) largest = std::max(largest, train.density[i] *= share[i]);
    if (largest > 0.0) result.trains.push_back(std::move(train));
  }
  return result;
}

double SpectrumTable::operator()(const Band& band, double log_k, double to_rad) const {
  const double x = std::clamp((log_k - first_) / step, 0.0, nodes_ - 1.001);
  const int i = int(x), row = i / nodes_a_row;
  const double fx = x - i, fr = x / nodes_a_row - row;
  double sum = 0.0;
  for (const Band::Train& train : band.trains) {
    const double density = train.density[i] + fx * (train.density[i + 1] - train.density[i]);
    if (density == 0.0) continue;
    double angle = std::abs(to_rad - train.to_rad);
    if (angle > pi) angle = std::abs(std::remainder(angle, 2.0 * pi));
    const double a = angle * ((angles - 1) / pi);
    const int j = std::min(int(a), angles - 2);
    const double fa = a - j;
    const double* here = &spread_[train.component][std::size_t(row) * angles + j];
    const double* next = here + angles;
    const double lower = here[0] + fa * (here[1] - here[0]), upper = next[0] + fa * (next[1] - next[0]);
    sum += density * (lower + fr * (upper - lower));
  }
  return sum;
}

}  // namespace seascape
