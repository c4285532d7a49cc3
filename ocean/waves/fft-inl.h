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
// a + i^Quarters b.
template <int Quarters>
HWY_INLINE Complex plus_quarters(Complex a, Complex b) {
  if constexpr (Quarters == 0) return a + b;
  else if constexpr (Quarters == 1) return plus_i(a, b);
  else if constexpr (Quarters == 2) return a - b;
  else return minus_i(a, b);
}
HWY_INLINE Complex turned(Complex a, Vector c, Vector s) {
  return {hn::Sub(hn::Mul(a.re, c), hn::Mul(a.im, s)), hn::Add(hn::Mul(a.re, s), hn::Mul(a.im, c))};
}
HWY_INLINE Complex turned(Complex a, const float* factor) {
  const Lanes d;
  return turned(a, hn::Set(d, factor[0]), hn::Set(d, factor[1]));
}
// An eighth of a turn.
HWY_INLINE Complex eighth(Complex a, Vector half_root) {
  return {hn::Mul(half_root, hn::Sub(a.re, a.im)), hn::Mul(half_root, hn::Add(a.re, a.im))};
}

HWY_INLINE void dft_4(Complex& a, Complex& b, Complex& c, Complex& d) {
  const Complex sum_ac = a + c, diff_ac = a - c, sum_bd = b + d, diff_bd = b - d;
  a = sum_ac + sum_bd;
  b = plus_i(diff_ac, diff_bd);
  c = sum_ac - sum_bd;
  d = minus_i(diff_ac, diff_bd);
}

// What the first stage reads: value j is the sum of its `Fold` values `fold_step` floats apart, each `Quarters` quarter turns
// further than the last, turned by the factor j where Turn. Functions, not lambdas: GCC leaves lambdas of this size out of line,
// which costs a third of the transform.
template <int Fold, int Quarters, bool Turn>
struct Inputs {
  const float* HWY_RESTRICT re;
  const float* HWY_RESTRICT im;
  std::ptrdiff_t step, fold_step;
  const float* factors;
  HWY_INLINE Complex at(std::ptrdiff_t offset) const {
    const Lanes d;
    return {hn::LoadU(d, re + offset), hn::LoadU(d, im + offset)};
  }
  HWY_INLINE Complex get(int j) const {
    const std::ptrdiff_t offset = j * step;
    Complex v = at(offset);
    if constexpr (Fold == 2) v = plus_quarters<Quarters>(v, at(offset + fold_step));
    if constexpr (Fold == 4)
      v = plus_quarters<Quarters>(plus_quarters<2 * Quarters % 4>(v, at(offset + 2 * fold_step)),
                                  plus_quarters<2 * Quarters % 4>(at(offset + fold_step), at(offset + 3 * fold_step)));
    if constexpr (Turn) v = turned(v, factors + 2 * j);
    return v;
  }
};

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

// The transform of four values `Gap` gaps apart.
template <int Gap, class From>
HWY_INLINE void four(const From& in, int first, int gap, Complex* v) {
  v[0] = in.get(first);
  v[1] = in.get(first + Gap * gap);
  v[2] = in.get(first + 2 * Gap * gap);
  v[3] = in.get(first + 3 * Gap * gap);
  dft_4(v[0], v[1], v[2], v[3]);
}

// One butterfly of radix R over the values first, first + gap, ... of what is read.
template <int R, class From, bool After>
HWY_INLINE void butterfly(const From& in, int first, int gap, const Results<After>& out) {
  const Lanes d;
  if constexpr (R == 16) {
    // Four transforms of four, turns by sixteenths, four of four.
    Complex v[16];
    const Vector c1 = hn::Set(d, 0.92387953251128674f), s1 = hn::Set(d, 0.38268343236508977f);
    const Vector half_root = hn::Set(d, 0.70710678118654752f);
    four<4>(in, first, gap, v);
    four<4>(in, first + gap, gap, v + 4);
    v[5] = turned(v[5], c1, s1);
    v[6] = eighth(v[6], half_root);
    v[7] = turned(v[7], s1, c1);
    four<4>(in, first + 2 * gap, gap, v + 8);
    v[9] = eighth(v[9], half_root);  // v[10] is left a quarter turn short
    v[11] = eighth(v[11], half_root);  // v[11] too
    four<4>(in, first + 3 * gap, gap, v + 12);
    v[13] = turned(v[13], s1, c1);
    v[14] = eighth(v[14], half_root);  // a quarter turn short
    v[15] = turned(v[15], c1, s1);     // half a turn short
    // Result k + 4 l.
    dft_4(v[0], v[4], v[8], v[12]);
    out.put(0, v[0]), out.put(4, v[4]), out.put(8, v[8]), out.put(12, v[12]);
    dft_4(v[1], v[5], v[9], v[13]);
    out.put(1, v[1]), out.put(5, v[5]), out.put(9, v[9]), out.put(13, v[13]);
    {
      const Complex sum_ac = plus_i(v[2], v[10]), diff_ac = minus_i(v[2], v[10]);
      const Complex sum_bd = plus_i(v[6], v[14]), diff_bd = minus_i(v[6], v[14]);
      out.put(2, sum_ac + sum_bd), out.put(6, plus_i(diff_ac, diff_bd));
      out.put(10, sum_ac - sum_bd), out.put(14, minus_i(diff_ac, diff_bd));
    }
    {
      const Complex sum_ac = plus_i(v[3], v[11]), diff_ac = minus_i(v[3], v[11]);
      const Complex sum_bd = v[7] - v[15], diff_bd = v[7] + v[15];
      out.put(3, sum_ac + sum_bd), out.put(7, plus_i(diff_ac, diff_bd));
      out.put(11, sum_ac - sum_bd), out.put(15, minus_i(diff_ac, diff_bd));
    }
  } else if constexpr (R == 8) {
    Complex v[8];
    four<2>(in, first, gap, v);
    four<2>(in, first + gap, gap, v + 4);
    // Odd results turned by q eighths of a turn; the quarter turn of the upper two is left to plus_i.
    const Vector half_root = hn::Set(d, 0.70710678118654752f);
    v[5] = eighth(v[5], half_root);
    v[7] = eighth(v[7], half_root);
    out.put(0, v[0] + v[4]), out.put(4, v[0] - v[4]);
    out.put(1, v[1] + v[5]), out.put(5, v[1] - v[5]);
    out.put(2, plus_i(v[2], v[6])), out.put(6, minus_i(v[2], v[6]));
    out.put(3, plus_i(v[3], v[7])), out.put(7, minus_i(v[3], v[7]));
  } else {
    static_assert(R == 4);
    Complex v[4];
    four<1>(in, first, gap, v);
    out.put(0, v[0]), out.put(1, v[1]), out.put(2, v[2]), out.put(3, v[3]);
  }
}

template <int R1, int R2, int Fold, int Quarters, bool Outer>
HWY_NOINLINE void core_stages(const Inputs<Fold, Quarters, Outer>& in, const float* inner, float* out_re, float* out_im,
                              std::ptrdiff_t out_step) {
  constexpr int width = 8, core = R1 * R2;
  alignas(64) float work_re[core * width], work_im[core * width];
  for (int j2 = 0; j2 < R2; ++j2)
    butterfly<R1>(in, j2, R2, Results<true>{work_re + j2 * width, work_im + j2 * width, R2 * width, inner + 2 * j2, 2 * R2});
  for (int q1 = 0; q1 < R1; ++q1)
    butterfly<R2>(Inputs<1, 0, false>{work_re + q1 * R2 * width, work_im + q1 * R2 * width, width, 0, nullptr}, 0, 1,
                  Results<false>{out_re + q1 * out_step, out_im + q1 * out_step, R1 * out_step, nullptr, 0});
}

// Results x = repeats q + r, for all q, of Lanes(Lanes()) transforms side by side. Value j (wave number j modulo band) lies
// at in + j in_step, result q goes to out + q out_step.
HWY_INLINE void transform_band(const FftPlan& plan, int r, const float* in_re, const float* in_im, std::ptrdiff_t in_step,
                               float* out_re, float* out_im, std::ptrdiff_t out_step) {
  const float* outer = plan.outer.data() + std::ptrdiff_t(2) * r * plan.core;
  const float* inner = plan.inner.data();
  const std::ptrdiff_t fold_step = plan.core * in_step;
#define SEASCAPE_STAGES(R1, R2, FOLD, QUARTERS, TURN)                                                                       \
  core_stages<R1, R2>(Inputs<FOLD, QUARTERS, TURN>{in_re, in_im, in_step, fold_step, outer}, inner, out_re, out_im, out_step)
#define SEASCAPE_RADICES(R1, R2)            \
  if (r == 0) SEASCAPE_STAGES(R1, R2, 1, 0, false); \
  else SEASCAPE_STAGES(R1, R2, 1, 0, true)
#define SEASCAPE_FOLDS(FOLD)                                 \
  if (r == 0) SEASCAPE_STAGES(16, 16, FOLD, 0, false);       \
  else if (quarters == 1) SEASCAPE_STAGES(16, 16, FOLD, 1, true); \
  else if (quarters == 2) SEASCAPE_STAGES(16, 16, FOLD, 2, true); \
  else SEASCAPE_STAGES(16, 16, FOLD, 3, true)
  if (plan.fold > 1) {
    // Value j + core of a band: m = j + core, or j - core where the band is two cores wide.
    const int quarters = (plan.fold == 2 ? 4 - 4 * r / plan.repeats : 4 * r / plan.repeats) % 4;
    if (plan.fold == 2) { SEASCAPE_FOLDS(2); }
    else { SEASCAPE_FOLDS(4); }
  } else if (plan.core == 256) { SEASCAPE_RADICES(16, 16);
  } else if (plan.core == 128) { SEASCAPE_RADICES(8, 16);
  } else if (plan.core == 64) { SEASCAPE_RADICES(8, 8);
  } else if (plan.core == 32) { SEASCAPE_RADICES(4, 8);
  } else { SEASCAPE_RADICES(4, 4);
  }
#undef SEASCAPE_FOLDS
#undef SEASCAPE_RADICES
#undef SEASCAPE_STAGES
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();
#endif
