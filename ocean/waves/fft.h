// Inverse complex two-dimensional transforms of a band of wave numbers, on the CPU.
#pragma once
#include <span>
#include <vector>

namespace seascape {

// f(x, z) = sum over m of F(mx, mz) exp(+2 pi i (mx x + mz z) / n), x and z from 0 to n - 1, no scaling. F is zero but
// for a band of -band/2 <= m < band/2, as the tiles of the sea have it; band = n is the ordinary dense transform.
//
// One dimension is `repeats` transforms of `core` points, core = min(band, 256). With x = repeats q + r and n = core
// repeats, exp(2 pi i m x / n) = exp(2 pi i m r / n) exp(2 pi i m q / core): transform r is that of its input turned by
// the outer factors, and no work is spent on zeros. Of a band wider than the core, the `fold` values that lie a
// multiple of core apart share the second factor, and the first but for a quarter turn each, so they are added up on
// the way in: the butterfly of a further stage at no cost but that of reading its input again. The core's transform is
// two stages of radix 4 to 16 that stay in the first-level cache. Columns of neighbouring x fill the vectors of one
// transform; a row is transposed between its stages instead. Neither contraction nor the order of sums depends on the
// instruction set or the number of threads.
struct FftPlan {
  int n = 0, band = 0, core = 0, fold = 0, repeats = 0;
  std::vector<float> outer;  // [r][cosine, sine][j] of 2 pi m r / n, m = j modulo band, 0 <= j < core
  std::vector<float> inner;  // [cosine, sine][q1][j2] of 2 pi q1 j2 / core, core = radix_1 radix_2
};

// n is a power of two from 16 to 1024, band one from 16 to n; throws std::invalid_argument otherwise.
FftPlan make_fft_plan(int n, int band);
// The band of a cascade of 64 x 64 waves: min(n, 64).
FftPlan make_fft_plan(int n);

// spectrum_re and _im: [mz + band/2][mx + band/2], band x band without padding. re and im: n rows of `stride` >= n
// floats, [z][x]. A power-of-two stride costs cache aliasing, memory that does not begin with a cache line (64 bytes)
// split accesses: pad the stride by 16 and align. `workspace`: inverse_fft_floats(plan) floats. One thread.
void inverse_fft(const FftPlan& plan, const float* spectrum_re, const float* spectrum_im, float* re, float* im,
                 int stride, std::span<float> workspace);
std::size_t inverse_fft_floats(const FftPlan& plan);

}  // namespace seascape
