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

// One butterfly over R values `in_step` floats apart, `out_step` floats apart afterwards. `before` turns value j by its
// factor at j * before_step, `after` turns result q likewise; null leaves them.
template <int R, bool Before, bool After>
HWY_INLINE void butterfly(const float* HWY_RESTRICT in_re, const float* HWY_RESTRICT in_im, std::ptrdiff_t in_step,
                          const float* before, int before_step, float* HWY_RESTRICT out_re, float* HWY_RESTRICT out_im,
                          std::ptrdiff_t out_step, const float* after, int after_step) {
  const Lanes d;
  const auto load = [&](int j) HWY_ATTR {
    const Complex v{hn::LoadU(d, in_re + j * in_step), hn::LoadU(d, in_im + j * in_step)};
    if constexpr (Before) return turned(v, before + j * before_step);
    return v;
  };
  const auto store = [&](int q, Complex v) HWY_ATTR {
    if constexpr (After) v = turned(v, after + q * after_step);
    hn::StoreU(v.re, d, out_re + q * out_step);
    hn::StoreU(v.im, d, out_im + q * out_step);
  };
  Complex a = load(0), b = load(R / 4), c = load(R / 2), e = load(3 * R / 4);
  dft_4(a, b, c, e);
  if constexpr (R == 4) {
    store(0, a), store(1, b), store(2, c), store(3, e);
  } else {
    static_assert(R == 8);
    Complex f = load(1), g = load(3), h = load(5), i = load(7);
    dft_4(f, g, h, i);
    // Odd results turned by q eighths of a turn; the quarter turn of the upper two is left to plus_i.
    const Vector half_root = hn::Set(d, 0.70710678118654752f);
    g = {hn::Mul(half_root, hn::Sub(g.re, g.im)), hn::Mul(half_root, hn::Add(g.re, g.im))};
    i = {hn::Mul(half_root, hn::Sub(i.re, i.im)), hn::Mul(half_root, hn::Add(i.re, i.im))};
    store(0, a + f), store(4, a - f);
    store(1, b + g), store(5, b - g);
    store(2, plus_i(c, h)), store(6, minus_i(c, h));
    store(3, plus_i(e, i)), store(7, minus_i(e, i));
  }
}

template <int R1, int R2, bool Outer>
HWY_INLINE void band_stages(const float* outer, const float* inner, const float* in_re, const float* in_im,
                            std::ptrdiff_t in_step, float* out_re, float* out_im, std::ptrdiff_t out_step) {
  constexpr int width = 8, band = R1 * R2;
  alignas(64) float work_re[band * width], work_im[band * width];
  for (int j2 = 0; j2 < R2; ++j2)
    butterfly<R1, Outer, true>(in_re + j2 * in_step, in_im + j2 * in_step, R2 * in_step, outer + 2 * j2, 2 * R2,
                               work_re + j2 * width, work_im + j2 * width, R2 * width, inner + 2 * j2, 2 * R2);
  for (int q1 = 0; q1 < R1; ++q1)
    butterfly<R2, false, false>(work_re + q1 * R2 * width, work_im + q1 * R2 * width, width, nullptr, 0,
                                out_re + q1 * out_step, out_im + q1 * out_step, R1 * out_step, nullptr, 0);
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
