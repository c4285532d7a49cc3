// Butterflies of radix 4, 8 and 16 in registers, what they read and where they leave it, for the instruction set that
// Highway compiles this for.
#include <hwy/highway.h>

#include <cstddef>

#if defined(SEASCAPE_FFT_BUTTERFLIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_FFT_BUTTERFLIES_INL_H
#undef SEASCAPE_FFT_BUTTERFLIES_INL_H
#else
#define SEASCAPE_FFT_BUTTERFLIES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Complex {
  V re, im;
};
template <class V>
HWY_INLINE Complex<V> operator+(Complex<V> a, Complex<V> b) {
  return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)};
}
template <class V>
HWY_INLINE Complex<V> operator-(Complex<V> a, Complex<V> b) {
  return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)};
}
// a + i^Quarters b.
template <int Quarters, class V>
HWY_INLINE Complex<V> plus_quarters(Complex<V> a, Complex<V> b) {
  if constexpr (Quarters == 0)
    return a + b;
  else if constexpr (Quarters == 1)
    return {hn::Sub(a.re, b.im), hn::Add(a.im, b.re)};
  else if constexpr (Quarters == 2)
    return a - b;
  else
    return {hn::Add(a.re, b.im), hn::Sub(a.im, b.re)};
}
template <class V>
HWY_INLINE Complex<V> plus_i(Complex<V> a, Complex<V> b) {
  return plus_quarters<1>(a, b);
}
template <class V>
HWY_INLINE Complex<V> minus_i(Complex<V> a, Complex<V> b) {
  return plus_quarters<3>(a, b);
}
template <class V>
HWY_INLINE Complex<V> turned(Complex<V> a, V c, V s) {
  return {hn::Sub(hn::Mul(a.re, c), hn::Mul(a.im, s)), hn::Add(hn::Mul(a.re, s), hn::Mul(a.im, c))};
}
// An eighth of a turn.
template <class V>
HWY_INLINE Complex<V> eighth(Complex<V> a, V half_root) {
  return {hn::Mul(half_root, hn::Sub(a.re, a.im)), hn::Mul(half_root, hn::Add(a.re, a.im))};
}

template <class V>
HWY_INLINE void dft_4(Complex<V>& a, Complex<V>& b, Complex<V>& c, Complex<V>& d) {
  const Complex<V> sum_ac = a + c, diff_ac = a - c, sum_bd = b + d, diff_bd = b - d;
  a = sum_ac + sum_bd;
  b = plus_i(diff_ac, diff_bd);
  c = sum_ac - sum_bd;
  d = minus_i(diff_ac, diff_bd);
}

// Cosines and sines of factors: one for all lanes where the lanes are different transforms, one a lane where they are
// different values of one.
enum class Lay { columns, row };
template <Lay L, class D>
HWY_INLINE hn::Vec<D> factor(D d, const float* at) {
  if constexpr (L == Lay::columns)
    return hn::Set(d, *at);
  else
    return hn::LoadU(d, at);
}

// What the first stage reads: value k of R is the sum of its `Fold` values, each `Quarters` quarter turns further than
// the last, turned where Turn. In memory the most negative wave number comes first. Functions, not lambdas: GCC leaves
// lambdas of this size out of line, which costs a third of the transform.
template <class D, Lay L, int R, int Fold, int Quarters, bool Turn>
struct Inputs {
  using V = hn::Vec<D>;
  const float* HWY_RESTRICT re;
  const float* HWY_RESTRICT im;
  std::ptrdiff_t gap;                 // floats from one value to the next
  const float* HWY_RESTRICT cosines;  // factor k at k * factor_gap
  const float* HWY_RESTRICT sines;
  int factor_gap;
  HWY_INLINE Complex<V> at(std::ptrdiff_t offset) const {
    const D d;
    return {hn::LoadU(d, re + offset), hn::LoadU(d, im + offset)};
  }
  HWY_INLINE Complex<V> get(int k) const {
    // Wave number j modulo the band lies half a band further on: of one fold half the values, of more half the folds.
    const std::ptrdiff_t offset = gap * (Fold == 1 ? (k + R / 2) % R : k), fold = gap * R;
    Complex<V> v = at(offset + (Fold / 2) * fold);
    if constexpr (Fold == 2) v = plus_quarters<Quarters>(v, at(offset));
    if constexpr (Fold == 4)
      v = plus_quarters<Quarters>(plus_quarters<2 * Quarters % 4>(v, at(offset)),
                                  plus_quarters<2 * Quarters % 4>(at(offset + 3 * fold), at(offset + fold)));
    if constexpr (Turn) v = turned(v, factor<L>(D(), cosines + k * factor_gap), factor<L>(D(), sines + k * factor_gap));
    return v;
  }
};

// What the second stage of columns reads.
template <class D>
struct Lines {
  using V = hn::Vec<D>;
  const float* HWY_RESTRICT re;
  const float* HWY_RESTRICT im;
  std::ptrdiff_t gap;
  HWY_INLINE Complex<V> get(int k) const {
    const D d;
    return {hn::Load(d, re + k * gap), hn::Load(d, im + k * gap)};
  }
};

// What the second stage of a row reads: vectors across rows of a matrix whose blocks of 4 x 4 are transposed already
// (see row_core).
template <class D>
struct Blocks {
  using V = hn::Vec<D>;
  const float* HWY_RESTRICT re;
  const float* HWY_RESTRICT im;
  std::ptrdiff_t row;  // floats from one row to the next
  template <int N>
  HWY_INLINE hn::Vec<hn::FixedTag<float, N>> gathered(const float* from) const {
    const hn::FixedTag<float, N> d;
    if constexpr (N == 4)
      return hn::LoadU(d, from);
    else
      return hn::Combine(d, gathered<N / 2>(from + N / 2 * row), gathered<N / 2>(from));
  }
  HWY_INLINE Complex<V> get(int k) const {
    const std::ptrdiff_t offset = (k % 4) * row + k / 4 * 4;
    return {gathered<int(hn::MaxLanes(D()))>(re + offset), gathered<int(hn::MaxLanes(D()))>(im + offset)};
  }
};

// Where a butterfly leaves its results: value q at q * step, turned by the factor at q * factor_step where Turn.
template <class D, Lay L, bool Turn>
struct Results {
  using V = hn::Vec<D>;
  float* HWY_RESTRICT re;
  float* HWY_RESTRICT im;
  std::ptrdiff_t step;
  const float* HWY_RESTRICT cosines;
  const float* HWY_RESTRICT sines;
  int factor_step;
  HWY_INLINE void put(int q, Complex<V> v) const {
    const D d;
    if constexpr (Turn) v = turned(v, factor<L>(d, cosines + q * factor_step), factor<L>(d, sines + q * factor_step));
    hn::StoreU(v.re, d, re + q * step);
    hn::StoreU(v.im, d, im + q * step);
  }
};

// The transform of values first, first + gap ...
template <class From, class V>
HWY_INLINE void four(const From& in, int first, int gap, Complex<V>* v) {
  v[0] = in.get(first);
  v[1] = in.get(first + gap);
  v[2] = in.get(first + 2 * gap);
  v[3] = in.get(first + 3 * gap);
  dft_4(v[0], v[1], v[2], v[3]);
}

template <int R, class D, class From, class To>
HWY_INLINE void butterfly(D d, const From& in, const To& out) {
  using V = hn::Vec<D>;
  using C = Complex<V>;
  if constexpr (R == 16) {
    // Four transforms of four, turns by sixteenths, four of four.
    C v[16];
    const V c1 = hn::Set(d, 0.92387953251128674f), s1 = hn::Set(d, 0.38268343236508977f);
    const V half_root = hn::Set(d, 0.70710678118654752f);
    four(in, 0, 4, v);
    four(in, 1, 4, v + 4);
    v[5] = turned(v[5], c1, s1);
    v[6] = eighth(v[6], half_root);
    v[7] = turned(v[7], s1, c1);
    four(in, 2, 4, v + 8);
    v[9] = eighth(v[9], half_root);
    v[11] = eighth(v[11], half_root);  // still a quarter turn short, as v[10] is
    four(in, 3, 4, v + 12);
    v[13] = turned(v[13], s1, c1);
    v[14] = eighth(v[14], half_root);  // a quarter turn short
    v[15] = turned(v[15], c1, s1);     // half a turn short
    // Results k, k + 4, k + 8, k + 12.
    dft_4(v[0], v[4], v[8], v[12]);
    out.put(0, v[0]), out.put(4, v[4]), out.put(8, v[8]), out.put(12, v[12]);
    dft_4(v[1], v[5], v[9], v[13]);
    out.put(1, v[1]), out.put(5, v[5]), out.put(9, v[9]), out.put(13, v[13]);
    {
      const C sum_ac = plus_i(v[2], v[10]), diff_ac = minus_i(v[2], v[10]);
      const C sum_bd = plus_i(v[6], v[14]), diff_bd = minus_i(v[6], v[14]);
      out.put(2, sum_ac + sum_bd), out.put(6, plus_i(diff_ac, diff_bd));
      out.put(10, sum_ac - sum_bd), out.put(14, minus_i(diff_ac, diff_bd));
    }
    {
      const C sum_ac = plus_i(v[3], v[11]), diff_ac = minus_i(v[3], v[11]);
      const C sum_bd = v[7] - v[15], diff_bd = v[7] + v[15];
      out.put(3, sum_ac + sum_bd), out.put(7, plus_i(diff_ac, diff_bd));
      out.put(11, sum_ac - sum_bd), out.put(15, minus_i(diff_ac, diff_bd));
    }
  } else if constexpr (R == 8) {
    C v[8];
    four(in, 0, 2, v);
    four(in, 1, 2, v + 4);
    // Odd results turned by q eighths of a turn; the quarter turn of the upper two is left to plus_i.
    const V half_root = hn::Set(d, 0.70710678118654752f);
    v[5] = eighth(v[5], half_root);
    v[7] = eighth(v[7], half_root);
    out.put(0, v[0] + v[4]), out.put(4, v[0] - v[4]);
    out.put(1, v[1] + v[5]), out.put(5, v[1] - v[5]);
    out.put(2, plus_i(v[2], v[6])), out.put(6, minus_i(v[2], v[6]));
    out.put(3, plus_i(v[3], v[7])), out.put(7, minus_i(v[3], v[7]));
  } else {
    static_assert(R == 4);
    C v[4];
    four(in, 0, 1, v);
    out.put(0, v[0]), out.put(1, v[1]), out.put(2, v[2]), out.put(3, v[3]);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();
#endif
