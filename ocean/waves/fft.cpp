#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/waves/fft.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include "ocean/waves/fft-inl.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {

void inverse_fft_2d(const FftPlan& plan, const float* spectrum_re, const float* spectrum_im, float* re, float* im, int stride) {
  const int n = plan.n, band = plan.band, lanes = int(hn::Lanes(Lanes()));
  const int pad = band + 16;
  // Along z first: the columns of the band, then rows of the band become rows of the tile.
  std::vector<float> memory(std::size_t(2) * pad * band + std::size_t(2) * pad * n + std::size_t(4) * n * 8);
  float* in_re = memory.data();
  float* in_im = in_re + pad * band;
  float* mid_re = in_im + pad * band;  // [z][mx]
  float* mid_im = mid_re + std::ptrdiff_t(pad) * n;
  float* column_re = mid_im + std::ptrdiff_t(pad) * n;  // [mx modulo band][lane], lanes are rows of the tile
  float* column_im = column_re + std::ptrdiff_t(n) * 8;
  float* result_re = column_im + std::ptrdiff_t(n) * 8;  // [x][lane]
  float* result_im = result_re + std::ptrdiff_t(n) * 8;
  for (int j = 0; j < band; ++j)
    for (int i = 0; i < band; ++i) {
      const int row = (j + band / 2) % band;
      in_re[j * pad + i] = spectrum_re[row * band + i];
      in_im[j * pad + i] = spectrum_im[row * band + i];
    }
  for (int i = 0; i < band; i += lanes)
    for (int r = 0; r < plan.repeats; ++r)
      transform_band(plan, r, in_re + i, in_im + i, pad, mid_re + std::ptrdiff_t(r) * pad + i, mid_im + std::ptrdiff_t(r) * pad + i,
                     std::ptrdiff_t(plan.repeats) * pad);
  for (int z = 0; z < n; z += lanes) {
    for (int i = 0; i < band; ++i)
      for (int lane = 0; lane < lanes; ++lane) {
        const std::ptrdiff_t from = std::ptrdiff_t(z + lane) * pad + (i + band / 2) % band;
        column_re[i * 8 + lane] = mid_re[from];
        column_im[i * 8 + lane] = mid_im[from];
      }
    for (int r = 0; r < plan.repeats; ++r)
      transform_band(plan, r, column_re, column_im, 8, result_re + r * 8, result_im + r * 8, std::ptrdiff_t(plan.repeats) * 8);
    for (int lane = 0; lane < lanes; ++lane)
      for (int x = 0; x < n; ++x) {
        re[std::ptrdiff_t(z + lane) * stride + x] = result_re[x * 8 + lane];
        im[std::ptrdiff_t(z + lane) * stride + x] = result_im[x * 8 + lane];
      }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(inverse_fft_2d);

FftPlan make_fft_plan(int n, int band) {
  const auto allowed = [](int size, int most) { return size >= 16 && size <= most && (size & (size - 1)) == 0; };
  if (!allowed(n, 1024) || !allowed(band, n))
    throw std::invalid_argument("make_fft_plan: n is a power of two from 16 to 1024, band one from 16 to n");
  FftPlan plan;
  plan.n = n;
  plan.band = band;
  plan.core = std::min(band, 256);
  plan.fold = band / plan.core;
  plan.repeats = n / plan.core;
  const int radix_1 = plan.core >= 256 ? 16 : plan.core >= 64 ? 8 : 4, radix_2 = plan.core / radix_1;
  const auto push = [](std::vector<float>& table, double turns) {
    table.push_back(float(std::cos(2.0 * std::numbers::pi * turns)));
    table.push_back(float(std::sin(2.0 * std::numbers::pi * turns)));
  };
  for (int r = 0; r < plan.repeats; ++r)
    for (int j = 0; j < plan.core; ++j) push(plan.outer, double((j < band / 2 ? j : j - band) * r) / n);
  for (int q1 = 0; q1 < radix_1; ++q1)
    for (int j2 = 0; j2 < radix_2; ++j2) push(plan.inner, double(q1 * j2) / plan.core);
  return plan;
}

FftPlan make_fft_plan(int n) { return make_fft_plan(n, std::min(n, 64)); }

void inverse_fft(const FftPlan& plan, const float* spectrum_re, const float* spectrum_im, float* re, float* im, int stride) {
  HWY_DYNAMIC_DISPATCH(inverse_fft_2d)(plan, spectrum_re, spectrum_im, re, im, stride);
}

}  // namespace seascape
#endif
