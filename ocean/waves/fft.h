// Inverse complex two-dimensional transforms of a band of wave numbers, on the CPU.
#pragma once
#include <span>
#include <vector>

namespace seascape {

// f(x, z) = sum over m of F(mx, mz) exp(+2 pi i (mx x + mz z) / n), x and z from 0 to n - 1, no scaling. F is zero but for a
// band of -band/2 <= m < band/2 with band = min(n, 64), as the tiles of the sea have it.
//
// With x = repeats q + r and repeats = n / band, exp(2 pi i m x / n) = exp(2 pi i m r / n) exp(2 pi i m q / band): one
// dimension is `repeats` transforms of `band` points, each after a turn of its input by the outer factors, and no work is
// spent on zeros. The band's transform is two stages of radix 4 or 8 that stay in the first-level cache; vectors run across
// the other dimension. Neither contraction nor the order of sums depends on the instruction set or the number of threads.
struct FftPlan {
  int n = 0, band = 0, repeats = 0;
  int radix_1 = 0, radix_2 = 0;  // band = radix_1 radix_2
  std::vector<float> outer;      // [r][j]: cosine, sine of 2 pi m r / n, j = m modulo band
  std::vector<float> inner;      // [q1][j2]: cosine, sine of 2 pi q1 j2 / band
};

// n is a power of two from 16 to 1024; throws std::invalid_argument otherwise.
FftPlan make_fft_plan(int n);

// spectrum_re and _im: [mz + band/2][mx + band/2], band x band without padding. re and im: n rows of `stride` >= n floats, [z][x].
// A power-of-two stride costs cache aliasing: pad it by 16 or so. One thread.
void inverse_fft(const FftPlan& plan, const float* spectrum_re, const float* spectrum_im, float* re, float* im, int stride);

}  // namespace seascape
