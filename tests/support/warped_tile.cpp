#include "tests/support/warped_tile.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace truth {

namespace {
constexpr double turn = 2.0 * std::numbers::pi;
using Complex = std::complex<double>;

Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
}  // namespace

double bessel_j0(double x) {
  constexpr double step = 1.0 / 128.0;
  static const std::vector<double> table = [] {
    std::vector<double> values;
    for (int i = 0; i <= 100 * 128 + 1; ++i) values.push_back(std::cyl_bessel_j(0.0, i * step));
    return values;
  }();
  const double at = std::abs(x) / step;
  if (at >= double(table.size() - 1)) return std::cyl_bessel_j(0.0, std::abs(x));
  const auto i = std::size_t(at);
  return table[i] + (at - double(i)) * (table[i + 1] - table[i]);
}

WarpedTile::WarpedTile(const SpectralTile& tile, double all)
    : side_m_(tile.side_m), cosine_(std::cos(tile.rotation_rad)), sine_(std::sin(tile.rotation_rad)), warp_(tile.warp) {
  const int half = tile.half;
  const auto variance = [&](int mx, int mz) {
    return tile.variance[std::size_t(mz + half) * 2 * std::size_t(half) + std::size_t(mx + half)];
  };
  double sum = 0.0;
  for (int mz = 0; mz < half; ++mz)
    for (int mx = mz == 0 ? 1 : -half + 1; mx < half; ++mx) {
      const double share = (variance(mx, mz) + variance(-mx, -mz)) / all;
      if (!(share > 0.0)) continue;
      const double u = turn * mx / side_m_, v = turn * mz / side_m_;
      bins_.push_back({cosine_ * u - sine_ * v, sine_ * u + cosine_ * v, share, mx, mz});
      sum += share;
    }
  const auto keep = [&](double most, const auto& before) {
    std::sort(bins_.begin(), bins_.end(), before);
    double kept = 0.0;
    std::size_t count = 0;
    while (count < bins_.size() && kept < most * sum) kept += bins_[count++].share;
    return count;
  };
  bins_.resize(keep(0.95, [](const Bin& a, const Bin& b) { return a.share > b.share; }));
  const auto k = [](const Bin& bin) { return std::hypot(bin.kx, bin.kz); };
  const std::size_t middle = keep(0.5, [&](const Bin& a, const Bin& b) { return k(a) < k(b); });
  if (middle > 0) middle_wave_m_ = turn / k(bins_[middle - 1]);
  std::sort(bins_.begin(), bins_.end(),
            [](const Bin& a, const Bin& b) { return std::pair(a.mz, a.mx) < std::pair(b.mz, b.mx); });
}

double WarpedTile::most_shift_m(int ix, int iz) const {
  double sum = 0.0;
  for (const WarpWave& way : ways_at(side_m_ * (cosine_ * ix - sine_ * iz), side_m_ * (sine_ * ix + cosine_ * iz)))
    sum += std::hypot(way.way_x, way.way_z);
  return sum;
}

std::vector<WarpWave> WarpedTile::ways_at(double x, double z) const {
  std::vector<WarpWave> ways = warp_;
  for (WarpWave& wave : ways) {
    const double apart = 2.0 * std::sin(0.5 * turn * (wave.along_x * x + wave.along_z * z));
    wave.way_x *= apart, wave.way_z *= apart;
  }
  return ways;
}

double WarpedTile::product(const Bin& bin, const std::vector<WarpWave>& ways) const {
  double product = 1.0;
  for (const WarpWave& wave : ways) product *= bessel_j0(bin.kx * wave.way_x + bin.kz * wave.way_z);
  return product;
}

double WarpedTile::at(double x, double z) const {
  const std::vector<WarpWave> ways = ways_at(x, z);
  double sum = 0.0;
  for (const Bin& bin : bins_) sum += bin.share * product(bin, ways) * std::cos(bin.kx * x + bin.kz * z);
  return sum;
}

void WarpedTile::around(int ix, int iz, double reach, double step, const std::function<double()>& least,
                        const std::function<void(double, double, double)>& put) const {
  // In the tile's own axes the sum over a row of bins is shared by all lags of a column. Bins lie row by row.
  const int count = int(reach / (3.0 * step)) + 1;  // of steps to each side of a part's middle
  const int size = 2 * count + 1;
  std::vector<Complex> row(static_cast<std::size_t>(size)), sums;
  std::vector<double> products(bins_.size());
  for (int part = 0; part < 9; ++part) {
    const double u0 = side_m_ * ix + (part % 3 - 1) * size * step, v0 = side_m_ * iz + (part / 3 - 1) * size * step;
    const std::vector<WarpWave> ways = ways_at(cosine_ * u0 - sine_ * v0, sine_ * u0 + cosine_ * v0);
    double most = 0.0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      products[i] = bins_[i].share * product(bins_[i], ways);
      most += std::abs(products[i]);
    }
    if (most <= least()) continue;
    sums.assign(std::size_t(size) * std::size_t(size), Complex{});
    for (auto bin = bins_.begin(); bin != bins_.end();) {
      const int mz = bin->mz;
      std::fill(row.begin(), row.end(), Complex{});
      for (; bin != bins_.end() && bin->mz == mz; ++bin) {
        const double ku = turn * bin->mx / side_m_;
        Complex wave = std::polar(1.0, ku * (u0 - count * step)) * products[std::size_t(bin - bins_.begin())];
        const Complex next = std::polar(1.0, ku * step);
        for (Complex& sum : row) sum += wave, wave = times(wave, next);
      }
      const double kv = turn * mz / side_m_;
      Complex wave = std::polar(1.0, kv * (v0 - count * step));
      const Complex next = std::polar(1.0, kv * step);
      for (int v = 0; v < size; ++v, wave = times(wave, next))
        for (int u = 0; u < size; ++u)
          sums[std::size_t(v) * std::size_t(size) + std::size_t(u)] += times(row[std::size_t(u)], wave);
    }
    for (int v = 0; v < size; ++v)
      for (int u = 0; u < size; ++u) {
        const double x = u0 + (u - count) * step, z = v0 + (v - count) * step;
        put(cosine_ * x - sine_ * z, sine_ * x + cosine_ * z,
            sums[std::size_t(v) * std::size_t(size) + std::size_t(u)].real());
      }
  }
}

}  // namespace truth
