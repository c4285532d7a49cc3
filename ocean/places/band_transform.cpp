#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/places/band_transform.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include "ocean/places/band_transform.h"
#include "ocean/waves/fft-inl.h"

#include <cassert>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
using Wide = hn::CappedTag<float, 16>;
constexpr std::ptrdiff_t line = 16;  // floats
}  // namespace

std::size_t forward_floats(const FftPlan& plan, int band) {
  return std::size_t(line + column_work<Wide>(plan) * plan.repeats + row_work(plan) + 2 * plan.n +
                     std::ptrdiff_t(2) * plan.n * (band + line) +
                     std::ptrdiff_t(2) * plan.n * std::ptrdiff_t(hn::MaxLanes(Wide())));
}

// With real and imaginary parts exchanged on the way in and out, the inverse transform is the forward one. It counts
// its inputs from -n/2, so that a factor of (-1)^m remains an axis.
void forward_2d(const FftPlan& plan, int band, const float* re, const float* im, int stride, float* out_re,
                float* out_im, float* workspace) {
  const std::ptrdiff_t n = plan.n, lanes = std::ptrdiff_t(hn::Lanes(Wide())), middle = band + line, half = band / 2;
  float* columns =
      workspace + (line - std::ptrdiff_t(reinterpret_cast<std::uintptr_t>(workspace) / sizeof(float)) % line) % line;
  const std::ptrdiff_t work = column_work<Wide>(plan);
  float* rows = columns + work * plan.repeats;
  float *row_re = rows + row_work(plan), *row_im = row_re + n;
  float *middle_re = row_im + n, *middle_im = middle_re + n * middle;  // [z][mx + band/2]
  float *result_re = middle_im + n * middle, *result_im = result_re + n * lanes;
  for (std::ptrdiff_t z = 0; z < n; ++z) {
    transform_row(plan, im + z * stride, re + z * stride, row_im, row_re, rows);
    for (std::ptrdiff_t i = 0; i < half; ++i) {
      middle_re[z * middle + i] = row_re[n - half + i];
      middle_im[z * middle + i] = row_im[n - half + i];
      middle_re[z * middle + half + i] = row_re[i];
      middle_im[z * middle + half + i] = row_im[i];
    }
  }
  for (std::ptrdiff_t x = 0; x < band; x += lanes) {
    for (int r = 0; r < plan.repeats; ++r)
      columns_in<Wide>(plan, r, middle_im + x, middle_re + x, middle, columns + r * work);
    for (std::ptrdiff_t r = 0; r < plan.repeats; ++r)
      columns_out<Wide>(plan, int(r), columns + r * work, result_im + r * lanes, result_re + r * lanes,
                        plan.repeats * lanes);
    for (std::ptrdiff_t j = 0; j < band; ++j) {
      const std::ptrdiff_t from = (j < half ? n - half + j : j - half) * lanes;
      for (std::ptrdiff_t i = 0; i < lanes; ++i) {
        const float sign = (i + x + j) % 2 != 0 ? -1.0f : 1.0f;  // half is even: m and its place are odd alike
        out_re[j * band + x + i] = sign * result_re[from + i];
        out_im[j * band + x + i] = sign * result_im[from + i];
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(forward_2d);
HWY_EXPORT(forward_floats);

std::size_t forward_band_floats(const FftPlan& dense, int band) {
  return HWY_DYNAMIC_DISPATCH(forward_floats)(dense, band);
}

void forward_band(const FftPlan& dense, int band, const float* re, const float* im, int stride, float* spectrum_re,
                  float* spectrum_im, std::span<float> workspace) {
  assert(dense.band == dense.n && band <= dense.n && workspace.size() >= forward_band_floats(dense, band));
  HWY_DYNAMIC_DISPATCH(forward_2d)(dense, band, re, im, stride, spectrum_re, spectrum_im, workspace.data());
}

}  // namespace seascape
#endif
