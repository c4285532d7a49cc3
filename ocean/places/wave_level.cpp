#include "ocean/places/wave_level.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/places/band_transform.h"
#include "ocean/places/wave_level_simd.h"
#include "ocean/waves/dispersion.h"

namespace seascape {

namespace {

constexpr double pi = std::numbers::pi;

double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double fades_in(double texels_a_wave) { return smooth(std::log(texels_a_wave / 8.0) / std::log(1.5)); }

double after(double value, int n) { return value - n * std::floor(value / n); }

}  // namespace

double wave_share(double texels_a_wave, bool coarsest, int samples) {
  const double rest =
      coarsest ? smooth(std::log(texels_a_wave * 6.0 / samples) / std::log(1.5)) : fades_in(0.5 * texels_a_wave);
  return fades_in(texels_a_wave) * (1.0 - rest);
}

WaveLevel::WaveLevel(int samples)
    : n_(samples),
      band_(samples / 4),
      to_texels_(make_fft_plan(samples, samples / 4)),
      to_waves_(make_fft_plan(samples, samples)) {
  const std::size_t waves = std::size_t(band_) * std::size_t(band_), texels = std::size_t(n_) * std::size_t(n_ + 16);
  for (auto* list : {&modes_, &turn_, &half_turn_, &head_, &rise_}) list->resize(waves);
  for (auto* list : {&share_, &frequency_}) list->resize(waves);
  for (auto* list : {&row_first_, &row_end_}) list->resize(std::size_t(band_));
  for (auto* list : {&spectrum_re_, &spectrum_im_}) list->resize(waves);
  for (auto* list : {&re_, &im_}) list->resize(texels);
  workspace_.resize(std::max(inverse_fft_floats(to_texels_), forward_band_floats(to_waves_, band_)));
}

void WaveLevel::shape(double texel_m, bool coarsest, double gravity, double depth) {
  texel_m_ = texel_m;
  depth_m_ = depth;
  table_dt_ = -1.0;
  const double side = texel_m * n_;
  for (int j = 0; j < band_; ++j)
    for (int i = 0; i < band_; ++i) {
      const std::size_t at = std::size_t(j) * std::size_t(band_) + std::size_t(i);
      const double m = std::hypot(double(i - band_ / 2), double(j - band_ / 2));
      // The first of each axis has no opposite; it is out of reach anyway.
      share_[at] = m > 0.0 && i > 0 && j > 0 ? wave_share(n_ / m, coarsest, n_) : 0.0;
      frequency_[at] = airy_frequency(2.0 * pi * m / side, gravity, depth);
      if (!(share_[at] > 0.0)) modes_[at] = 0.0;
    }
  for (int j = 0; j < band_; ++j) {
    const double* row = share_.data() + std::ptrdiff_t(j) * band_;
    int first = 0, end = band_;
    while (first < end && !(row[first] > 0.0)) ++first;
    while (end > first && !(row[end - 1] > 0.0)) --end;
    row_first_[std::size_t(j)] = first / 8 * 8,
    row_end_[std::size_t(j)] = first < end ? (end + 7) / 8 * 8 : first / 8 * 8;
  }
  longest_speed_ = airy_group_speed(2.0 * pi / (coarsest ? 0.25 * side : 24.0 * texel_m), gravity, depth);
}

void WaveLevel::clear() {
  std::fill(modes_.begin(), modes_.end(), 0.0);
  still_ = true;
}

void WaveLevel::turn_table(double dt, double damping) {
  if (dt == table_dt_ && damping == table_damping_) return;
  table_dt_ = dt, table_damping_ = damping;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    turn_[i] = std::polar(1.0, -std::remainder(frequency_[i] * dt, 2.0 * pi));
    half_turn_[i] = std::polar(std::exp(-0.25 * damping * dt), -std::remainder(0.5 * frequency_[i] * dt, 2.0 * pi));
  }
}

// The Fourier coefficients of a Gaussian, exact: no texel cuts it short. Gives whether there is anything of it.
bool WaveLevel::gather(const WaveSource& s, double dt, LodIndex first) {
  const glm::dvec2 at = s.place_m / texel_m_ - 0.5;  // in texels
  double inside = 1.0;
  for (int axis = 0; axis < 2; ++axis)
    inside *= smooth(std::min(at[axis] - double(first[axis]), double(first[axis]) + n_ - 1 - at[axis]) / (n_ / 8));
  const double area = inside * s.length_m * s.length_m / (pi * texel_m_ * texel_m_ * n_ * n_), head = area * s.head_m,
               rise = area * s.rise_mps * dt;
  if (!(std::abs(head) + std::abs(rise) > 0.0)) return false;
  const std::size_t from = sources_.head.size() * std::size_t(band_), half = std::size_t(band_ / 2);
  sources_.head.push_back(head);
  sources_.rise.push_back(rise);
  const double x = after(at.x, n_), z = after(at.y, n_);
  for (std::size_t i = 0; i < half; ++i) {  // the first has no opposite, and carries nothing
    const double m = double(i), part = std::exp(-std::pow(m * s.length_m / (texel_m_ * n_), 2));
    const std::complex<double> of_x = std::polar(part, -2.0 * pi * m * x / n_),
                               of_z = std::polar(part, -2.0 * pi * m * z / n_);
    sources_.x_re[from + half + i] = sources_.x_re[from + half - i] = of_x.real();
    sources_.z_re[from + half + i] = sources_.z_re[from + half - i] = of_z.real();
    sources_.x_im[from + half + i] = of_x.imag(), sources_.x_im[from + half - i] = -of_x.imag();
    sources_.z_im[from + half + i] = of_z.imag(), sources_.z_im[from + half - i] = -of_z.imag();
  }
  return true;
}

// Of what real sources come to, waves of opposite numbers are conjugate: half of them are summed up (mirror).
void WaveLevel::spread(bool& heads, bool& rises) {
  const std::size_t count = sources_.head.size(), band = std::size_t(band_);
  for (auto* list : {&head_, &rise_}) {
    const std::vector<double>& strength = list == &head_ ? sources_.head : sources_.rise;
    bool& any = list == &head_ ? heads : rises;
    if (std::all_of(strength.begin(), strength.end(), [](double one) { return one == 0.0; })) continue;
    if (!any) std::fill(list->begin(), list->end(), 0.0);
    any = true;
    for (std::size_t j = 1; j <= band / 2; ++j) {
      for (std::size_t s = 0; s < count; ++s) {
        sources_.row_re[s] = strength[s] * sources_.z_re[s * band + j];
        sources_.row_im[s] = strength[s] * sources_.z_im[s * band + j];
      }
      const std::size_t begin = std::size_t(row_first_[j]), end = std::size_t(row_end_[j]);
      add_products({list->data() + j * band + begin, end - begin}, {sources_.row_re.data(), count},
                   {sources_.row_im.data(), count}, sources_.x_re.data() + begin, sources_.x_im.data() + begin, band_);
    }
  }
  sources_.head.clear();
  sources_.rise.clear();
}

void WaveLevel::mirror(std::vector<std::complex<double>>& list) const {
  const std::size_t band = std::size_t(band_);
  for (std::size_t j = 1; j < band / 2; ++j)
    for (std::size_t i = std::max(std::size_t(row_first_[j]), std::size_t(1)); i < std::size_t(row_end_[j]); ++i)
      list[(band - j) * band + band - i] = std::conj(list[j * band + i]);
}

void WaveLevel::add_sources(std::span<const WaveSource> sources, double dt, LodIndex first, bool& heads, bool& rises) {
  constexpr std::size_t together = 16;
  if (sources.empty()) return;
  for (auto* list : {&sources_.x_re, &sources_.x_im, &sources_.z_re, &sources_.z_im})
    list->resize(together * std::size_t(band_));
  for (auto* list : {&sources_.row_re, &sources_.row_im}) list->resize(together);
  for (auto* list : {&sources_.head, &sources_.rise}) list->reserve(together);
  for (WaveSource s : sources) {
    s.place_m -= s.velocity_mps * (0.5 * dt);
    if (gather(s, dt, first) && sources_.head.size() == together) spread(heads, rises);
  }
  spread(heads, rises);
  if (heads) mirror(head_);
  if (rises) mirror(rise_);
}

// As a source of that shape: its waves are those of the texels' Fourier sum.
void WaveLevel::add_pressure(LodIndex first, std::span<const float> head_m, bool& heads) {
  const std::size_t n = std::size_t(n_), stride = n + 16;
  const auto inside = [&](std::int64_t w, std::int64_t begin) {
    return float(smooth(std::min(double(w - begin), double(begin + n_ - 1 - w)) / (n_ / 8)));
  };
  for (std::int64_t z = first.y; z < first.y + n_; ++z) {
    const std::size_t row = std::size_t(z & (n_ - 1));
    const float across = inside(z, first.y);
    for (std::int64_t x = first.x; x < first.x + n_; ++x) {
      const std::size_t column = std::size_t(x & (n_ - 1));
      re_[row * stride + column] = across * inside(x, first.x) * head_m[row * n + column];
      im_[row * stride + column] = 0.0f;
    }
  }
  forward_band(to_waves_, band_, re_.data(), im_.data(), int(stride), spectrum_re_.data(), spectrum_im_.data(),
               workspace_);
  if (!heads) std::fill(head_.begin(), head_.end(), 0.0);
  heads = true;
  const double scale = 1.0 / (double(n_) * n_);
  for (std::size_t i = 0; i < head_.size(); ++i)
    head_[i] += scale * std::complex<double>(spectrum_re_[i], spectrum_im_[i]);
}

void WaveLevel::turn(double dt, double damping, LodIndex first, std::span<const WaveSource> sources,
                     std::span<const float> head_m) {
  bool heads = false, rises = false;
  add_sources(sources, dt, first, heads, rises);
  if (!head_m.empty()) add_pressure(first, head_m, heads);
  if (heads || rises) still_ = false;
  if (still_) return;
  turn_table(dt, damping);
  const double loss = std::exp(-0.5 * damping * dt);
  const auto times = [](std::complex<double> a, std::complex<double> b) {
    return std::complex<double>(a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real());
  };
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    if (!(share_[i] > 0.0)) continue;
    const std::complex<double> head = heads ? share_[i] * head_[i] : 0.0;
    modes_[i] = loss * (times(turn_[i], modes_[i] + head) - head);
    if (rises) modes_[i] += share_[i] * times(half_turn_[i], rise_[i]);
  }
}

void WaveLevel::take_off(std::span<const float> along_x, std::span<const float> along_z, const float* open) {
  if (still_) return;
  const int stride = n_ + 16;
  floats_from_modes(modes_, spectrum_re_.data(), spectrum_im_.data());
  inverse_fft(to_texels_, spectrum_re_.data(), spectrum_im_.data(), re_.data(), im_.data(), stride, workspace_);
  // What is taken away is what goes back: of the rest no transform rounds anything.
  multiply_by_loss(re_.data(), im_.data(), n_, stride, along_x.data(), along_z.data(), open);
  forward_band(to_waves_, band_, re_.data(), im_.data(), stride, spectrum_re_.data(), spectrum_im_.data(), workspace_);
  add_to_modes(modes_, share_.data(), 1.0 / (double(n_) * n_), spectrum_re_.data(), spectrum_im_.data());
}

void WaveLevel::add(std::span<const float> height, std::span<const float> quarter) {
  still_ = false;
  forward_band(to_waves_, band_, height.data(), quarter.data(), n_, spectrum_re_.data(), spectrum_im_.data(),
               workspace_);
  add_to_modes(modes_, share_.data(), 1.0 / (double(n_) * n_), spectrum_re_.data(), spectrum_im_.data());
}

void WaveLevel::shift_by(glm::dvec2 by) {
  for (int j = 0; j < band_; ++j)
    for (int i = 0; i < band_; ++i)
      modes_[std::size_t(j) * std::size_t(band_) + std::size_t(i)] *=
          std::polar(1.0, 2.0 * pi * ((i - band_ / 2) * by.x + (j - band_ / 2) * by.y) / n_);
}

void WaveLevel::surface(std::span<float> height, std::span<float> quarter) const {
  if (still_) {
    std::fill(height.begin(), height.end(), 0.0f);
    std::fill(quarter.begin(), quarter.end(), 0.0f);
    return;
  }
  floats_from_modes(modes_, spectrum_re_.data(), spectrum_im_.data());
  inverse_fft(to_texels_, spectrum_re_.data(), spectrum_im_.data(), height.data(), quarter.data(), n_, workspace_);
}

double WaveLevel::energy_m2() const {
  double sum = 0.0;
  for (const std::complex<double>& a : modes_) sum += a.real() * a.real() + a.imag() * a.imag();
  return sum;
}

double WaveLevel::highest_m() const {
  double sum = 0.0;
  for (const std::complex<double>& a : modes_) sum += std::sqrt(a.real() * a.real() + a.imag() * a.imag());
  return sum;
}

}  // namespace seascape
