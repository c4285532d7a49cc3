// The transform of a band along one dimension, for the instruction set that Highway compiles this for.
#include <hwy/highway.h>

#include "ocean/waves/fft.h"

#if defined(SEASCAPE_FFT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_FFT_INL_H
#undef SEASCAPE_FFT_INL_H
#else
#define SEASCAPE_FFT_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// Wider vectors gain nothing here and would push the scratch of a strip out of the first-level cache.
using Lanes = hn::CappedTag<float, 8>;
using Vector = hn::Vec<Lanes>;

struct Complex {
  Vector re, im;
};
HWY_INLINE Complex operator+(Complex a, Complex b) { return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)}; }
HWY_INLINE Complex operator-(Complex a, Complex b) { return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)}; }
// a + i b and a - i b.
HWY_INLINE Complex plus_i(Complex a, Complex b) { return {hn::Sub(a.re, b.im), hn::Add(a.im, b.re)}; }
HWY_INLINE Complex minus_i(Complex a, Complex b) { return {hn::Add(a.re, b.im), hn::Sub(a.im, b.re)}; }
HWY_INLINE Complex turned(Complex a, const float* factor) {
  const Lanes d;
  const Vector c = hn::Set(d, factor[0]), s = hn::Set(d, factor[1]);
  return {hn::Sub(hn::Mul(a.re, c), hn::Mul(a.im, s)), hn::Add(hn::Mul(a.re, s), hn::Mul(a.im, c))};
}

HWY_INLINE void dft_4(Complex& a, Complex& b, Complex& c, Complex& d) {
  const Complex sum_ac = a + c, diff_ac = a - c, sum_bd = b + d, diff_bd = b - d;
  a = sum_ac + sum_bd;
  b = plus_i(diff_ac, diff_bd);
  c = sum_ac - sum_bd;
  d = minus_i(diff_ac, diff_bd);
}

// Functions, not lambdas: GCC leaves lambdas of this size out of line, which costs a third of the transform.
template <bool Turn>
HWY_INLINE Complex loaded(const float* HWY_RESTRICT re, const float* HWY_RESTRICT im, std::ptrdiff_t at, const float* factor) {
  const Lanes d;
  const Complex v{hn::LoadU(d, re + at), hn::LoadU(d, im + at)};
  if constexpr (Turn) return turned(v, factor);
  return v;
}

// Where a butterfly leaves its results: value q at q * step, turned by the factor at q * factor_step where Turn.
template <bool Turn>
struct Results {
  float* HWY_RESTRICT re;
  float* HWY_RESTRICT im;
  std::ptrdiff_t step;
  const float* factors;
  int factor_step;
  HWY_INLINE void put(int q, Complex v) const {
    const Lanes d;
    if constexpr (Turn) v = turned(v, factors + q * factor_step);
    hn::StoreU(v.re, d, re + q * step);
    hn::StoreU(v.im, d, im + q * step);
  }
};

// One butterfly over R values `step` floats apart, value j first turned by its factor at j * factor_step where Before.
template <int R, bool Before, bool After>
HWY_INLINE void butterfly(const float* in_re, const float* in_im, std::ptrdiff_t step, const float* factors, int factor_step,
                          const Results<After>& out) {
  const Lanes d;
  Complex v[R];
  v[0] = loaded<Before>(in_re, in_im, 0, factors);
  v[1] = loaded<Before>(in_re, in_im, (R / 4) * step, factors + (R / 4) * factor_step);
  v[2] = loaded<Before>(in_re, in_im, (R / 2) * step, factors + (R / 2) * factor_step);
  v[3] = loaded<Before>(in_re, in_im, (3 * R / 4) * step, factors + (3 * R / 4) * factor_step);
  dft_4(v[0], v[1], v[2], v[3]);
  if constexpr (R == 4) {
    out.put(0, v[0]);
    out.put(1, v[1]);
    out.put(2, v[2]);
    out.put(3, v[3]);
  } else {
    static_assert(R == 8);
    v[4] = loaded<Before>(in_re, in_im, step, factors + factor_step);
    v[5] = loaded<Before>(in_re, in_im, 3 * step, factors + 3 * factor_step);
    v[6] = loaded<Before>(in_re, in_im, 5 * step, factors + 5 * factor_step);
    v[7] = loaded<Before>(in_re, in_im, 7 * step, factors + 7 * factor_step);
    dft_4(v[4], v[5], v[6], v[7]);
    // Odd results turned by q eighths of a turn; the quarter turn of the upper two is left to plus_i.
    const Vector half_root = hn::Set(d, 0.70710678118654752f);
    v[5] = {hn::Mul(half_root, hn::Sub(v[5].re, v[5].im)), hn::Mul(half_root, hn::Add(v[5].re, v[5].im))};
    v[7] = {hn::Mul(half_root, hn::Sub(v[7].re, v[7].im)), hn::Mul(half_root, hn::Add(v[7].re, v[7].im))};
    out.put(0, v[0] + v[4]);
    out.put(4, v[0] - v[4]);
    out.put(1, v[1] + v[5]);
    out.put(5, v[1] - v[5]);
    out.put(2, plus_i(v[2], v[6]));
    out.put(6, minus_i(v[2], v[6]));
    out.put(3, plus_i(v[3], v[7]));
    out.put(7, minus_i(v[3], v[7]));
  }
}

template <int R1, int R2, bool Outer>
HWY_INLINE void band_stages(const float* outer, const float* inner, const float* in_re, const float* in_im,
                            std::ptrdiff_t in_step, float* out_re, float* out_im, std::ptrdiff_t out_step) {
  constexpr int width = 8, band = R1 * R2;
  alignas(64) float work_re[band * width], work_im[band * width];
  for (int j2 = 0; j2 < R2; ++j2)
    butterfly<R1, Outer, true>(in_re + j2 * in_step, in_im + j2 * in_step, R2 * in_step, outer + 2 * j2, 2 * R2,
                               Results<true>{work_re + j2 * width, work_im + j2 * width, R2 * width, inner + 2 * j2, 2 * R2});
  for (int q1 = 0; q1 < R1; ++q1)
    butterfly<R2, false, false>(work_re + q1 * R2 * width, work_im + q1 * R2 * width, width, inner, 0,
                                Results<false>{out_re + q1 * out_step, out_im + q1 * out_step, R1 * out_step, nullptr, 0});
}

// Results x = repeats q + r, for all q, of Lanes(Lanes()) transforms side by side. Value j (wave number j modulo band) lies
// at in + j in_step, result q goes to out + q out_step.
HWY_INLINE void transform_band(const FftPlan& plan, int r, const float* in_re, const float* in_im, std::ptrdiff_t in_step,
                               float* out_re, float* out_im, std::ptrdiff_t out_step) {
  const float* outer = plan.outer.data() + std::ptrdiff_t(2) * r * plan.band;
  const float* inner = plan.inner.data();
  if (plan.band == 64) {
    if (r == 0) band_stages<8, 8, false>(outer, inner, in_re, in_im, in_step, out_re, out_im, out_step);
    else band_stages<8, 8, true>(outer, inner, in_re, in_im, in_step, out_re, out_im, out_step);
  } else if (plan.band == 32) {
    band_stages<4, 8, false>(outer, inner, in_re, in_im, in_step, out_re, out_im, out_step);
  } else {
    band_stages<4, 4, false>(outer, inner, in_re, in_im, in_step, out_re, out_im, out_step);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();
#endif
