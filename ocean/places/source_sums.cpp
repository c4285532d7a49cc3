#include "ocean/places/source_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ocean/places/band_transform.h"
#include "ocean/places/wave_level_simd.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double common_texels = 5.0;  // length of the Gaussian that widens all sources
constexpr double nothing = 14.0;       // exp(-14) is 8e-7
constexpr std::size_t together = 16;   // humps
// Up to so many sums of heads and of rises it is quicker to go wave by wave: 128 and 256 samples, measured.
constexpr int few = 16;

double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double after(double value, int n) { return value - n * std::floor(value / n); }

// Of what real sources come to, waves of opposite numbers are conjugate: half of them are summed up.
template <class Each>
void each_of_half(int band, std::span<const int> row_first, std::span<const int> row_end, const Each& each) {
  for (int j = 1; j <= band / 2; ++j)
    for (int i = std::max(row_first[std::size_t(j)], 1); i < row_end[std::size_t(j)]; ++i) {
      const std::size_t at = std::size_t(j) * std::size_t(band) + std::size_t(i),
                        opposite = std::size_t(band - j) * std::size_t(band) + std::size_t(band - i);
      each(i, j, at, opposite);
    }
}

}  // namespace

SourceSums::SourceSums(int samples) : n_(samples), band_(samples / 4) {
  const std::size_t band = std::size_t(band_);
  for (int i = 0; i < band_; ++i) narrow_.push_back(std::exp(std::pow(common_texels * (i - band_ / 2) / n_, 2)));
  for (auto* list : {&of_x_, &of_z_}) list->resize(std::size_t(n_));
  for (auto* list : {&x_re_, &x_im_, &z_re_, &z_im_}) list->resize(together * band);
  for (auto* list : {&row_re_, &row_im_}) list->resize(together);
}

// A source is one hump, or two where it acts so deep that the band's waves feel it differently.
void SourceSums::gather(const WaveSource& s, double dt, LodIndex first) {
  const glm::dvec2 middle = s.place_m - s.velocity_mps * (0.5 * dt), at = middle / texel_m_ - 0.5;
  double inside = 1.0;
  for (int axis = 0; axis < 2; ++axis)
    inside *= smooth(std::min(at[axis] - double(first[axis]), double(first[axis]) + n_ - 1 - at[axis]) / (n_ / 8));
  const double length2 = s.length_m * s.length_m / (texel_m_ * texel_m_), area = inside * length2 / (pi * n_ * n_);
  std::array<DepthTerm, 2> terms;
  const int count =
      depth_terms(s.depth_m, 2.0 * pi / (longest_ * texel_m_), 2.0 * pi / (8.0 * texel_m_), std::span(terms));
  for (int i = 0; i < count; ++i) {
    const DepthTerm& term = terms[std::size_t(i)];
    const double wide2 = length2 + 4.0 * pi * pi * term.width_m2 / (texel_m_ * texel_m_),
                 strength = area * term.amplitude, head = strength * s.head_m, rise = strength * s.rise_mps * dt;
    if (!(std::abs(head) + std::abs(rise) > 0.0)) continue;
    if (wide2 / (longest_ * longest_) - std::log(term.amplitude) > nothing) continue;
    humps_.push_back({after(at.x, n_), after(at.y, n_), wide2, head, rise});
  }
}

// The Fourier coefficients of Gaussians, exact: no texel cuts them short.
void SourceSums::sum_waves(std::span<const Hump> humps, std::span<const int> row_first, std::span<const int> row_end,
                           SourceWaves& waves) {
  const std::size_t band = std::size_t(band_), half = band / 2;
  for (std::size_t h = 0; h < humps.size(); ++h)
    for (std::size_t i = 0; i < half; ++i) {  // the first has no opposite, and carries nothing
      const double m = double(i), part = std::exp(-m * m * humps[h].length2 / (double(n_) * n_));
      const std::complex<double> of_x = std::polar(part, -2.0 * pi * m * humps[h].x / n_),
                                 of_z = std::polar(part, -2.0 * pi * m * humps[h].z / n_);
      const std::size_t more = h * band + half + i, less = h * band + half - i;
      x_re_[more] = x_re_[less] = of_x.real(), z_re_[more] = z_re_[less] = of_z.real();
      x_im_[more] = of_x.imag(), x_im_[less] = -of_x.imag();
      z_im_[more] = of_z.imag(), z_im_[less] = -of_z.imag();
    }
  if (waves.heads) sum_rows(humps, true, row_first, row_end, waves.head);
  if (waves.rises) sum_rows(humps, false, row_first, row_end, waves.rise);
}

void SourceSums::sum_rows(std::span<const Hump> humps, bool heads, std::span<const int> row_first,
                          std::span<const int> row_end, std::vector<std::complex<double>>& to) {
  const std::size_t band = std::size_t(band_), count = humps.size();
  const auto strength = [&](std::size_t h) { return heads ? humps[h].head : humps[h].rise; };
  bool any = false;
  for (std::size_t h = 0; h < count; ++h) any = any || strength(h) != 0.0;
  if (!any) return;
  for (std::size_t j = 1; j <= band / 2; ++j) {
    for (std::size_t h = 0; h < count; ++h) {
      row_re_[h] = strength(h) * z_re_[h * band + j];
      row_im_[h] = strength(h) * z_im_[h * band + j];
    }
    const std::size_t begin = std::size_t(row_first[j]), end = std::size_t(row_end[j]);
    add_products({to.data() + j * band + begin, end - begin}, {row_re_.data(), count}, {row_im_.data(), count},
                 x_re_.data() + begin, x_im_.data() + begin, band_);
  }
}

// exp(-pi^2 d^2 / width2) at all texels, d from `at`, those that wrap around added up. The next value is this times a
// ratio, and the ratio's own is constant.
SourceSums::Run SourceSums::profile(double at, double width2, std::vector<float>& to) const {
  const double reach = std::sqrt(nothing * width2) / pi;
  const int middle = int(std::floor(at)), before = int(reach), mask = n_ - 1;
  std::fill(to.begin(), to.end(), 0.0f);
  const double a = pi * pi / width2, off = middle - at, shrink = std::exp(-2.0 * a);
  for (const int side : {1, -1}) {
    double value = std::exp(-a * off * off), ratio = std::exp(-a * (2.0 * side * off + 1.0));
    for (int i = 0; i <= before + 1; ++i) {
      if (i > 0 || side > 0) to[std::size_t((middle + side * i) & mask)] += float(value);
      value *= ratio, ratio *= shrink;
    }
  }
  const int count = std::min(2 * before + 3, n_);
  return {(middle - before - 1) & mask, count};
}

// Heads are the real part of one complex field and rises its imaginary part, of the same strength at their strongest,
// so that neither drowns in the other's rounding. Their transforms part by what is conjugate at opposite numbers.
void SourceSums::sum_texels(const Room& room, std::span<const int> row_first, std::span<const int> row_end,
                            SourceWaves& waves) {
  double head = 0.0, rise = 0.0;
  for (const Hump& hump : humps_)
    head = std::max(head, std::abs(hump.head)), rise = std::max(rise, std::abs(hump.rise));
  const double texels = double(n_) * n_, of_head = head > 0.0 ? 1.0 / head : 0.0,
               of_rise = rise > 0.0 ? 1.0 / rise : 0.0;
  std::fill(room.re.begin(), room.re.end(), 0.0f);
  std::fill(room.im.begin(), room.im.end(), 0.0f);
  for (const Hump& hump : humps_) {
    const double width2 = hump.length2 + common_texels * common_texels, scale = pi / width2 * texels;
    const Run x = profile(hump.x, width2, of_x_), z = profile(hump.z, width2, of_z_);
    const auto add = [&](float* to, double strength) {
      if (strength == 0.0) return;
      add_outer_product(to, n_, room.stride, {x.first, x.count, z.first, z.count}, of_x_.data(), of_z_.data(),
                        float(scale * strength));
    };
    add(room.re.data(), hump.head * of_head);
    add(room.im.data(), hump.rise * of_rise);
  }
  forward_band(room.to_waves, band_, room.re.data(), room.im.data(), room.stride, room.spectrum_re.data(),
               room.spectrum_im.data(), room.workspace);
  each_of_half(band_, row_first, row_end, [&](int i, int j, std::size_t at, std::size_t opposite) {
    const std::complex<double> a(room.spectrum_re[at], room.spectrum_im[at]),
        b(room.spectrum_re[opposite], -room.spectrum_im[opposite]);
    const double scale = 0.5 / texels * narrow_[std::size_t(i)] * narrow_[std::size_t(j)];
    if (waves.heads) waves.head[at] += scale * head * (a + b);
    const std::complex<double> twice = a - b;
    if (waves.rises) waves.rise[at] += scale * rise * std::complex<double>(twice.imag(), -twice.real());
  });
}

void SourceSums::add(std::span<const WaveSource> sources, double dt, LodIndex first, std::span<const int> row_first,
                     std::span<const int> row_end, const Room& room, SourceWaves& waves) {
  humps_.clear();
  humps_.reserve(2 * sources.size());
  for (const WaveSource& s : sources) gather(s, dt, first);
  int sums = 0;
  bool heads = false, rises = false;
  for (const Hump& hump : humps_) {
    sums += int(hump.head != 0.0) + int(hump.rise != 0.0);
    heads = heads || hump.head != 0.0, rises = rises || hump.rise != 0.0;
  }
  if (heads && !waves.heads) std::fill(waves.head.begin(), waves.head.end(), 0.0);
  if (rises && !waves.rises) std::fill(waves.rise.begin(), waves.rise.end(), 0.0);
  waves.heads = waves.heads || heads, waves.rises = waves.rises || rises;
  if (humps_.empty()) return;
  if (by == 1 || (by < 0 && sums > few)) {
    sum_texels(room, row_first, row_end, waves);
  } else {
    for (std::size_t h = 0; h < humps_.size(); h += together)
      sum_waves(std::span(humps_).subspan(h, std::min(together, humps_.size() - h)), row_first, row_end, waves);
  }
  each_of_half(band_, row_first, row_end, [&](int, int j, std::size_t at, std::size_t opposite) {
    if (j == band_ / 2) return;  // its own opposite row is summed whole
    if (heads) waves.head[opposite] = std::conj(waves.head[at]);
    if (rises) waves.rise[opposite] = std::conj(waves.rise[at]);
  });
}

}  // namespace seascape
