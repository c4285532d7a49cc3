// Vectors of numbers with their derivatives, by forward differentiation (Wengert 1964), for the instruction set that
// Highway compiles this for: one formula gives a value and, where derivatives are wanted, what it changes by.
#include <hwy/highway.h>

#include <array>

#if defined(SEASCAPE_DUAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_DUAL_INL_H
#undef SEASCAPE_DUAL_INL_H
#else
#define SEASCAPE_DUAL_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// A value and its derivatives by `count` numbers. The value is the same to the bit for any count.
template <class V, int count>
struct Dual {
  V value;
  std::array<V, std::size_t(count)> by;
};

template <int count, class V>
HWY_INLINE Dual<V, count> constant(V value) {
  Dual<V, count> result{value, {}};
  for (V& by : result.by) by = hn::Zero(hn::DFromV<V>());
  return result;
}
template <class V, int count>
HWY_INLINE Dual<V, count> operator+(const Dual<V, count>& a, const Dual<V, count>& b) {
  Dual<V, count> result{hn::Add(a.value, b.value), {}};
  for (std::size_t i = 0; i < std::size_t(count); ++i) result.by[i] = hn::Add(a.by[i], b.by[i]);
  return result;
}
template <class V, int count>
HWY_INLINE Dual<V, count> operator-(const Dual<V, count>& a, const Dual<V, count>& b) {
  Dual<V, count> result{hn::Sub(a.value, b.value), {}};
  for (std::size_t i = 0; i < std::size_t(count); ++i) result.by[i] = hn::Sub(a.by[i], b.by[i]);
  return result;
}
template <class V, int count>
HWY_INLINE Dual<V, count> operator*(const Dual<V, count>& a, const Dual<V, count>& b) {
  Dual<V, count> result{hn::Mul(a.value, b.value), {}};
  for (std::size_t i = 0; i < std::size_t(count); ++i)
    result.by[i] = hn::Add(hn::Mul(a.by[i], b.value), hn::Mul(a.value, b.by[i]));
  return result;
}
// Of a function whose value and derivative at `a` these are.
template <class V, int count>
HWY_INLINE Dual<V, count> chained(const Dual<V, count>& a, V value, V derivative) {
  Dual<V, count> result{value, {}};
  for (std::size_t i = 0; i < std::size_t(count); ++i) result.by[i] = hn::Mul(a.by[i], derivative);
  return result;
}
template <class V, int count>
HWY_INLINE Dual<V, count> times(const Dual<V, count>& a, float by) {
  const auto factor = hn::Set(hn::DFromV<V>(), by);
  return chained(a, hn::Mul(a.value, factor), factor);
}
template <class V, int count>
HWY_INLINE Dual<V, count> plus(const Dual<V, count>& a, float more) {
  return {hn::Add(a.value, hn::Set(hn::DFromV<V>(), more)), a.by};
}
template <class V, int count>
HWY_INLINE Dual<V, count> operator/(const Dual<V, count>& a, const Dual<V, count>& b) {
  Dual<V, count> result{hn::Div(a.value, b.value), {}};
  if constexpr (count > 0) {
    const auto inverse = hn::Div(hn::Set(hn::DFromV<V>(), 1.0f), b.value);
    for (std::size_t i = 0; i < std::size_t(count); ++i)
      result.by[i] = hn::Mul(hn::Sub(a.by[i], hn::Mul(result.value, b.by[i])), inverse);
  }
  return result;
}
template <class V, int count, class M>
HWY_INLINE Dual<V, count> select(M mask, const Dual<V, count>& yes, const Dual<V, count>& no) {
  Dual<V, count> result{hn::IfThenElse(mask, yes.value, no.value), {}};
  for (std::size_t i = 0; i < std::size_t(count); ++i) result.by[i] = hn::IfThenElse(mask, yes.by[i], no.by[i]);
  return result;
}
template <class V, int count, class M>
HWY_INLINE Dual<V, count> only(M mask, const Dual<V, count>& a) {
  Dual<V, count> result{hn::IfThenElseZero(mask, a.value), {}};
  for (std::size_t i = 0; i < std::size_t(count); ++i) result.by[i] = hn::IfThenElseZero(mask, a.by[i]);
  return result;
}
// Of 0 and more; changes nothing at 0.
template <class V, int count>
HWY_INLINE Dual<V, count> root(const Dual<V, count>& a) {
  const hn::DFromV<V> d;
  const auto value = hn::Sqrt(a.value);
  auto derivative = value;
  if constexpr (count > 0)
    derivative = hn::IfThenElseZero(hn::Gt(value, hn::Zero(d)), hn::Div(hn::Set(d, 0.5f), value));
  return chained(a, value, derivative);
}
template <class V, int count>
HWY_INLINE Dual<V, count> larger(const Dual<V, count>& a, const Dual<V, count>& b) {
  Dual<V, count> result{hn::Max(a.value, b.value), {}};
  for (std::size_t i = 0; i < std::size_t(count); ++i)
    result.by[i] = hn::IfThenElse(hn::Gt(a.value, b.value), a.by[i], b.by[i]);
  return result;
}
// Within 0 and 1.
template <class V, int count>
HWY_INLINE Dual<V, count> clamped(const Dual<V, count>& a) {
  const hn::DFromV<V> d;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  Dual<V, count> result{hn::Min(hn::Max(a.value, zero), one), {}};
  const auto within = hn::And(hn::Gt(a.value, zero), hn::Lt(a.value, one));
  for (std::size_t i = 0; i < std::size_t(count); ++i) result.by[i] = hn::IfThenElseZero(within, a.by[i]);
  return result;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#endif
