// The transform of a field to its band of wave numbers: the way back of inverse_fft (fft.h).
#pragma once
#include <cstddef>
#include <span>

#include "ocean/waves/fft.h"

namespace seascape {

// F(mx, mz) = sum over x and z of f(x, z) exp(-2 pi i (mx x + mz z) / n) for -band/2 <= m < band/2, no scaling:
// inverse_fft of what this gives is n^2 times the field's own band. `dense` is make_fft_plan(n, n); band a power of two
// from 16 to n. re, im: n rows of `stride` >= n floats, [z][x]; spectrum_re, _im: [mz + band/2][mx + band/2] without
// padding. workspace: forward_band_floats(dense, band) floats. One thread. The rows are transformed whole, of the
// columns only the band's.
void forward_band(const FftPlan& dense, int band, const float* re, const float* im, int stride, float* spectrum_re,
                  float* spectrum_im, std::span<float> workspace);
std::size_t forward_band_floats(const FftPlan& dense, int band);

}  // namespace seascape
