#include "ocean/places/wave_level.h"

#include <algorithm>
#include <cassert>
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
      to_waves_(make_fft_plan(samples, samples)),
      sums_(samples) {
  const std::size_t waves = std::size_t(band_) * std::size_t(band_), texels = std::size_t(n_) * std::size_t(n_ + 16);
  for (auto* list : {&modes_, &turn_, &half_turn_, &pushed_.head, &pushed_.rise}) list->resize(waves);
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
  sums_.shape(texel_m, coarsest ? 0.25 * n_ : 24.0);
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

// As a source of that shape: its waves are those of the texels' Fourier sum.
void WaveLevel::add_pressure(LodIndex first, std::span<const float> head_m) {
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
  if (!pushed_.heads) std::fill(pushed_.head.begin(), pushed_.head.end(), 0.0);
  pushed_.heads = true;
  const double scale = 1.0 / (double(n_) * n_);
  for (std::size_t i = 0; i < pushed_.head.size(); ++i)
    pushed_.head[i] += scale * std::complex<double>(spectrum_re_[i], spectrum_im_[i]);
}

void WaveLevel::turn(double dt, double damping, LodIndex first, std::span<const WaveSource> sources,
                     std::span<const float> head_m) {
  pushed_.heads = pushed_.rises = false;
  if (!sources.empty())
    sums_.add(sources, dt, first, row_first_, row_end_,
              {to_waves_, re_, im_, spectrum_re_, spectrum_im_, workspace_, n_ + 16}, pushed_);
  if (!head_m.empty()) add_pressure(first, head_m);
  const bool heads = pushed_.heads, rises = pushed_.rises;
  if (heads || rises) still_ = false;
  if (still_) return;
  turn_table(dt, damping);
  const double loss = std::exp(-0.5 * damping * dt);
  const auto times = [](std::complex<double> a, std::complex<double> b) {
    return std::complex<double>(a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real());
  };
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    if (!(share_[i] > 0.0)) continue;
    const std::complex<double> head = heads ? share_[i] * pushed_.head[i] : 0.0;
    modes_[i] = loss * (times(turn_[i], modes_[i] + head) - head);
    if (rises) modes_[i] += share_[i] * times(half_turn_[i], pushed_.rise[i]);
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

void WaveLevel::draw_towards(const WaveLevel& other, float share, std::span<const float> along_x,
                             std::span<const float> along_z) {
  assert(other.n_ == n_ && other.texel_m_ == texel_m_);
  if (still_ && other.still_) return;
  still_ = false;
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const std::complex<double> between = other.modes_[i] - modes_[i];
    spectrum_re_[i] = float(between.real()), spectrum_im_[i] = float(between.imag());
  }
  const std::size_t n = std::size_t(n_), stride = n + 16;
  inverse_fft(to_texels_, spectrum_re_.data(), spectrum_im_.data(), re_.data(), im_.data(), int(stride), workspace_);
  for (std::size_t z = 0; z < n; ++z) {
    const float across = share * along_z[z];
    for (std::size_t x = 0; x < n; ++x) {
      const float by = across * along_x[x];
      re_[z * stride + x] *= by, im_[z * stride + x] *= by;
    }
  }
  forward_band(to_waves_, band_, re_.data(), im_.data(), int(stride), spectrum_re_.data(), spectrum_im_.data(),
               workspace_);
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
