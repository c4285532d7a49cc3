// The formulas of shaders/shared/surface_slope.h and flow_height.h for vectors, for the instruction set that Highway
// compiles this for. Nothing fuses a multiplication with an addition: all instruction sets give the same bits.
#include <hwy/highway.h>

#include <glm/glm.hpp>

#if defined(SEASCAPE_FORMULAS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_FORMULAS_INL_H
#undef SEASCAPE_FORMULAS_INL_H
#else
#define SEASCAPE_FORMULAS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// What slopes are made of; the names are those of surface_slope().
template <class V>
struct Folded {
  V one_xx, one_zz, xz, zx;
  V jacobian, held;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE Folded<V> fold(D d, V xx, V zz, V xz, V zx) {
  const auto one = hn::Set(d, 1.0f);
  Folded<V> f{hn::Add(one, xx), hn::Add(one, zz), xz, zx, one, one};
  f.jacobian = hn::Sub(hn::Mul(f.one_xx, f.one_zz), hn::Mul(xz, zx));
  const auto size = hn::Max(hn::Abs(f.jacobian), hn::Set(d, 1e-3f));
  f.held = hn::IfThenElse(hn::Lt(f.jacobian, hn::Zero(d)), hn::Neg(size), size);
  return f;
}
template <class V>
HWY_INLINE V slope_x(const Folded<V>& f, V height_x, V height_z) {
  return hn::Div(hn::Sub(hn::Mul(f.one_zz, height_x), hn::Mul(f.zx, height_z)), f.held);
}
template <class V>
HWY_INLINE V slope_z(const Folded<V>& f, V height_x, V height_z) {
  return hn::Div(hn::Sub(hn::Mul(f.one_xx, height_z), hn::Mul(f.xz, height_x)), f.held);
}

// exp(-x) of -80 and more, to some 2e-7 of itself; 0 beyond 80. In operations that all instruction sets round alike.
template <class D>
HWY_INLINE hn::Vec<D> exp_minus(D d, hn::Vec<D> x) {
  const hn::RebindToSigned<D> di;
  const auto turns = hn::Mul(hn::Min(x, hn::Set(d, 80.0f)), hn::Set(d, -1.44269504f));
  const auto whole = hn::Round(turns);
  const auto rest = hn::Mul(hn::Sub(turns, whole), hn::Set(d, 0.69314718f));  // within +-0.35
  auto sum = hn::Set(d, 1.0f / 720.0f);
  for (const float c : {1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f})
    sum = hn::Add(hn::Mul(sum, rest), hn::Set(d, c));
  const auto power = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127)));
  return hn::IfThenElse(hn::Lt(x, hn::Set(d, 80.0f)), hn::Mul(sum, hn::BitCast(d, power)), hn::Zero(d));
}

// flow_height() of patterns that are so far alike.
template <class D>
HWY_INLINE hn::Vec<D> height_of_alike(D d, hn::Vec<D> alike, float first) {
  const float second = 1.0f - first;
  const auto sum =
      hn::Add(hn::Set(d, first * first + second * second), hn::Mul(hn::Set(d, 2.0f * first * second), alike));
  return hn::Div(hn::Set(d, 1.0f), hn::Sqrt(sum));
}
template <class D>
HWY_INLINE hn::Vec<D> flow_height(D d, glm::vec3 decay_per_m2, hn::Vec<D> way_x, hn::Vec<D> way_z, float first) {
  const auto by_x =
                 hn::Add(hn::Mul(hn::Set(d, decay_per_m2.x), way_x), hn::Mul(hn::Set(d, 2.0f * decay_per_m2.z), way_z)),
             apart = hn::Add(hn::Mul(by_x, way_x), hn::Mul(hn::Mul(hn::Set(d, decay_per_m2.y), way_z), way_z));
  return height_of_alike(d, exp_minus(d, apart), first);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#endif
