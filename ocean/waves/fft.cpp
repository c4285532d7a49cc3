#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/waves/fft.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include "ocean/waves/fft-inl.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {

namespace {
using Wide = hn::CappedTag<float, 16>;
constexpr std::ptrdiff_t line = 16;  // floats
std::ptrdiff_t middle_stride(const FftPlan& plan) { return plan.n + line; }
// A dense transform goes through its result: its columns are then read before any of them is written.
bool in_place(const FftPlan& plan) { return plan.band == plan.n; }
}  // namespace

std::size_t floats_2d(const FftPlan& plan) {
  return std::size_t(line + row_work(plan) + column_work<Wide>(plan) * (in_place(plan) ? plan.repeats : 1) +
                     (in_place(plan) ? 0 : 2 * plan.band * middle_stride(plan)));
}

void inverse_fft_2d(const FftPlan& plan, const float* spectrum_re, const float* spectrum_im, float* re, float* im,
                    int stride, float* workspace) {
  const int n = plan.n, band = plan.band, lanes = int(hn::Lanes(Wide()));
  float* columns =
      workspace + (line - std::ptrdiff_t(reinterpret_cast<std::uintptr_t>(workspace) / sizeof(float)) % line) % line;
  const std::ptrdiff_t work = column_work<Wide>(plan);
  float* rows = columns + work * (in_place(plan) ? plan.repeats : 1);
  float* middle_re = in_place(plan) ? re : rows + row_work(plan);  // [mz + band/2][x]
  float* middle_im = in_place(plan) ? im : middle_re + band * middle_stride(plan);
  const std::ptrdiff_t middle = in_place(plan) ? stride : middle_stride(plan);
  // Rows first: of these there are only as many as the band has, and each has to be transposed within.
  for (std::ptrdiff_t i = 0; i < band; ++i)
    transform_row(plan, spectrum_re + i * band, spectrum_im + i * band, middle_re + i * middle, middle_im + i * middle,
                  rows);
  for (int x = 0; x < n; x += lanes) {
    if (in_place(plan)) {
      for (int r = 0; r < plan.repeats; ++r)
        columns_in<Wide>(plan, r, middle_re + x, middle_im + x, middle, columns + r * work);
      for (std::ptrdiff_t r = 0; r < plan.repeats; ++r)
        columns_out<Wide>(plan, int(r), columns + r * work, re + r * stride + x, im + r * stride + x,
                          plan.repeats * std::ptrdiff_t(stride));
    } else {
      for (std::ptrdiff_t r = 0; r < plan.repeats; ++r) {
        columns_in<Wide>(plan, int(r), middle_re + x, middle_im + x, middle, columns);
        columns_out<Wide>(plan, int(r), columns, re + r * stride + x, im + r * stride + x,
                          plan.repeats * std::ptrdiff_t(stride));
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(inverse_fft_2d);
HWY_EXPORT(floats_2d);

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
  plan.outer.resize(std::size_t(2) * plan.n);
  plan.inner.resize(std::size_t(2) * plan.core);
  const auto put = [](float* cosines, int size, int at, double turns) {
    cosines[at] = float(std::cos(2.0 * std::numbers::pi * turns));
    cosines[size + at] = float(std::sin(2.0 * std::numbers::pi * turns));
  };
  for (int r = 0; r < plan.repeats; ++r)
    for (int j = 0; j < plan.core; ++j)
      put(&plan.outer[std::size_t(2) * r * plan.core], plan.core, j, double((j < band / 2 ? j : j - band) * r) / n);
  for (int q1 = 0; q1 < radix_1; ++q1)
    for (int j2 = 0; j2 < radix_2; ++j2)
      put(plan.inner.data(), plan.core, q1 * radix_2 + j2, double(q1 * j2) / plan.core);
  return plan;
}

FftPlan make_fft_plan(int n) { return make_fft_plan(n, std::min(n, 64)); }

std::size_t inverse_fft_floats(const FftPlan& plan) { return HWY_DYNAMIC_DISPATCH(floats_2d)(plan); }

void inverse_fft(const FftPlan& plan, const float* spectrum_re, const float* spectrum_im, float* re, float* im,
                 int stride, std::span<float> workspace) {
  assert(workspace.size() >= inverse_fft_floats(plan));
  HWY_DYNAMIC_DISPATCH(inverse_fft_2d)(plan, spectrum_re, spectrum_im, re, im, stride, workspace.data());
}

}  // namespace seascape
#endif
