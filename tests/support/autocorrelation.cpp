#include "tests/support/autocorrelation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "tests/support/warped_tile.h"

namespace truth {

namespace {
constexpr double turn = 2.0 * std::numbers::pi;
using Complex = std::complex<double>;

// Radix 2 in place (Cooley and Tukey 1965), exponent +, twiddles exp(i turn j / n) for j < n / 2.
void transform(Complex* x, int n, const std::vector<Complex>& twiddle) {
  for (int i = 1, j = 0; i < n; ++i) {
    int bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j |= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (int length = 2; length <= n; length *= 2)
    for (int start = 0; start < n; start += length)
      for (int j = 0; j < length / 2; ++j) {
        const Complex w = twiddle[std::size_t(j * (n / length))], a = x[start + j], b = x[start + j + length / 2];
        const Complex wb(w.real() * b.real() - w.imag() * b.imag(), w.real() * b.imag() + w.imag() * b.real());
        x[start + j] = a + wb;
        x[start + j + length / 2] = a - wb;
      }
}
}  // namespace

double SpectralTile::total() const {
  double sum = 0.0;
  for (const double v : variance) sum += v;
  return sum;
}

PeriodicField::PeriodicField(int half, int size, const std::function<double(int, int)>& at_m)
    : size_(size), mask_(size - 1), values_(std::size_t(size) * std::size_t(size)) {
  std::vector<Complex> twiddle;
  for (int j = 0; j < size / 2; ++j) twiddle.push_back(std::polar(1.0, turn * j / size));
  // Rows of wave numbers along x first, only those that are not empty; then columns, whose real part is the sum of
  // cosines.
  std::vector<std::vector<Complex>> rows;
  for (int mz = -half + 1; mz < half; ++mz) {
    std::vector<Complex> row(std::size_t(size), Complex{});
    for (int mx = -half + 1; mx < half; ++mx) row[std::size_t(mx & mask_)] = at_m(mx, mz);
    transform(row.data(), size, twiddle);
    rows.push_back(std::move(row));
  }
  std::vector<Complex> column(static_cast<std::size_t>(size));
  for (int x = 0; x < size; ++x) {
    std::fill(column.begin(), column.end(), Complex{});
    for (int mz = -half + 1; mz < half; ++mz)
      column[std::size_t(mz & mask_)] = rows[std::size_t(mz + half - 1)][std::size_t(x)];
    transform(column.data(), size, twiddle);
    for (int y = 0; y < size; ++y)
      values_[std::size_t(y) * std::size_t(size) + std::size_t(x)] = float(column[std::size_t(y)].real());
  }
}

double PeriodicField::linear(double u, double v) const {
  const double x = (u - std::floor(u)) * size_, y = (v - std::floor(v)) * size_;
  const int ix = int(x), iy = int(y);
  const double fx = x - ix, fy = y - iy;
  const double low = cell(ix, iy) + fx * (cell(ix + 1, iy) - cell(ix, iy));
  const double high = cell(ix, iy + 1) + fx * (cell(ix + 1, iy + 1) - cell(ix, iy + 1));
  return low + fy * (high - low);
}

double PeriodicField::cubic(double u, double v) const {
  const double x = (u - std::floor(u)) * size_, y = (v - std::floor(v)) * size_;
  const int ix = int(x), iy = int(y);
  const auto through = [](double a, double b, double c, double d, double t) {
    return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
  };
  double row[4];
  for (int j = 0; j < 4; ++j)
    row[j] = through(cell(ix - 1, iy + j - 1), cell(ix, iy + j - 1), cell(ix + 1, iy + j - 1), cell(ix + 2, iy + j - 1),
                     x - ix);
  return through(row[0], row[1], row[2], row[3], y - iy);
}

ContinuousAutocorrelation::ContinuousAutocorrelation(const std::function<double(double, double)>& density,
                                                     double variance, double longest_wave_m)
    : side_m_(std::max(12000.0, 60.0 * longest_wave_m)) {
  constexpr int size = 1024;
  const double step = turn / side_m_, scale = variance > 0.0 ? step * step / variance : 0.0;
  field_ = PeriodicField(size / 2, size, [&](int mx, int mz) {
    const bool out = (mx == 0 && mz == 0) || mx * mx + mz * mz >= size * size / 4;
    return out ? 0.0 : scale * density(step * mx, step * mz);
  });
}

namespace {
class Search {
 public:
  Search(std::span<const SpectralTile> tiles, const ContinuousAutocorrelation& continuous, double from, double to)
      : tiles_(tiles), continuous_(continuous), from_(from), to_(to) {
    double sum = 0.0;
    for (const SpectralTile& tile : tiles) sum += tile.total();
    for (const SpectralTile& tile : tiles) {
      int size = 2;
      while (size < 8 * tile.half) size *= 2;  // eight cells to the shortest wave
      const auto at = [&](int mx, int mz) {
        return tile.variance[std::size_t(mz + tile.half) * 2 * std::size_t(tile.half) + std::size_t(mx + tile.half)] /
               sum;
      };
      fields_.emplace_back(tile.half, size, at);
      shares_.push_back(tile.total() / sum);
      if (!tile.warp.empty()) warped_.emplace_back(tile, sum), kept_ = 10;
      for (int mz = -tile.half + 1; mz < tile.half; ++mz)
        for (int mx = -tile.half + 1; mx < tile.half; ++mx)
          waves_.push_back({tile.side_m / std::max(1e-9, std::hypot(double(mx), double(mz))), at(mx, mz)});
    }
    std::sort(waves_.begin(), waves_.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    double longer = 0.0;
    for (const auto& [length, share] : waves_)
      if ((longer += share) >= 0.9) {
        step_ = std::max(3.0, length / 6.0);
        break;
      }
  }

  double tiles_at(double x, double z, bool cubic, double least_share = 0.0) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (shares_[i] <= least_share || !tiles_[i].warp.empty()) continue;
      const double c = std::cos(tiles_[i].rotation_rad), s = std::sin(tiles_[i].rotation_rad);
      const double u = (c * x + s * z) / tiles_[i].side_m, v = (-s * x + c * z) / tiles_[i].side_m;
      sum += cubic ? fields_[i].cubic(u, v) : fields_[i].linear(u, v);
    }
    return sum;
  }
  double excess(double x, double z) const { return tiles_at(x, z, true) + warped_at(x, z) - continuous_.at(x, z); }
  double warped_at(double x, double z) const {
    double sum = 0.0;
    for (const WarpedTile& tile : warped_) sum += tile.at(x, z);
    return sum;
  }

  Excess run() {
    const int count = int(to_ / step_) + 1;
    for (int iz = 0; iz <= count; ++iz)
      for (int ix = -count; ix <= count; ++ix) {
        const double x = ix * step_, z = iz * step_, r2 = x * x + z * z;
        if (r2 < from_ * from_ || r2 > to_ * to_) continue;
        propose({tiles_at(x, z, false, 0.002) - continuous_.at(x, z), x, z, 0.0, 0.0, -1});
      }
    settle();
    std::size_t warped = 0;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (!tiles_[i].warp.empty()) {
        search_warped(warped_[warped++], tiles_[i].side_m, int(i));
        continue;
      }
      if (shares_[i] < 0.002) continue;
      const double side = tiles_[i].side_m, c = std::cos(tiles_[i].rotation_rad), s = std::sin(tiles_[i].rotation_rad);
      const int most = int(to_ / side);
      for (int iz = 0; iz <= most; ++iz)
        for (int ix = -most; ix <= most; ++ix) {
          const double u = ix * side, v = iz * side, r2 = u * u + v * v;
          if (r2 < from_ * from_ || r2 > to_ * to_) continue;
          const double x = c * u - s * v, z = s * u + c * v;
          // Of tiles that repeat so often what warped tiles add counts in the climb alone: at most a few hundredths
          // more.
          const double value = shares_[i] < 0.07 ? tiles_at(x, z, true) - continuous_.at(x, z) : excess(x, z);
          propose({value, x, z, 0.0, 0.0, int(i)});
        }
      settle();
    }
    best_.tiles = tiles_at(best_.x_m, best_.z_m, true) + warped_at(best_.x_m, best_.z_m);
    best_.continuous = continuous_.at(best_.x_m, best_.z_m);
    return best_;
  }

 private:
  static bool more(const Excess& a, const Excess& b) { return a.value > b.value; }
  void propose(const Excess& e) {  // a heap whose first is the least of the best
    if (candidates_.size() == kept_ && e.value <= candidates_.front().value) return;
    if (candidates_.size() == kept_) {
      std::pop_heap(candidates_.begin(), candidates_.end(), more);
      candidates_.pop_back();
    }
    candidates_.push_back(e);
    std::push_heap(candidates_.begin(), candidates_.end(), more);
  }
  void search_warped(const WarpedTile& tile, double side, int lattice) {
    const double wave = tile.middle_wave_m();
    const int most = int(to_ / side) + 1;
    for (int iz = 0; iz <= most; ++iz)
      for (int ix = iz == 0 ? 1 : -most; ix <= most; ++ix) {
        const double r = side * std::hypot(double(ix), double(iz)), reach = tile.most_shift_m(ix, iz) + wave;
        if (r + reach < from_ || r - reach > to_) continue;
        tile.around(
            ix, iz, reach, wave / 6.0,
            [&] { return candidates_.size() < kept_ ? 0.0 : std::max(candidates_.front().value, 0.0); },
            [&](double x, double z, double value) {
              const double lag = std::hypot(x, z);
              if (lag >= from_ && lag <= to_) propose({value, x, z, 0.0, 0.0, lattice});
            });
      }
    settle();
    for (int i = 0; i < 1000; ++i) {  // evenly over the half plane, by the golden ratio
      const double r = std::sqrt(from_ * from_ + (to_ * to_ - from_ * from_) * (i + 0.5) / 1000.0),
                   angle = std::fmod(i * 0.6180339887498949, 1.0) * std::numbers::pi;
      propose({excess(r * std::cos(angle), r * std::sin(angle)), r * std::cos(angle), r * std::sin(angle), 0.0, 0.0,
               lattice});
    }
    settle();
  }
  // Climbs from each candidate by the best of eight neighbours, the step halved when none is better.
  void settle() {
    for (Excess e : candidates_) {
      e.value = excess(e.x_m, e.z_m);
      for (double step = step_; step > step_ / 50.0;) {
        Excess next = e;
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            const double x = e.x_m + i * step, z = e.z_m + j * step, r = std::hypot(x, z);
            if (r < from_ || r > to_) continue;
            const double value = excess(x, z);
            if (value > next.value) next = {value, x, z, 0.0, 0.0, e.lattice};
          }
        if (next.value > e.value)
          e = next;
        else
          step /= 2.0;
      }
      if (e.value > best_.value) best_ = e;
    }
    candidates_.clear();
  }

  std::span<const SpectralTile> tiles_;
  const ContinuousAutocorrelation& continuous_;
  double from_, to_, step_ = 3.0;
  std::size_t kept_ = 40;  // candidates; fewer where a climb is a long sum
  std::vector<PeriodicField> fields_;
  std::vector<WarpedTile> warped_;
  std::vector<double> shares_;
  std::vector<std::pair<double, double>> waves_;  // length (m), share of the variance
  std::vector<Excess> candidates_;
  Excess best_;
};
}  // namespace

Excess largest_excess(std::span<const SpectralTile> tiles, const ContinuousAutocorrelation& continuous, double from_m,
                      double to_m) {
  return Search(tiles, continuous, from_m, to_m).run();
}

}  // namespace truth
