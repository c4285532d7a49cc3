// Cosines and sines of turns, for the instruction set that Highway compiles this for.
#include <hwy/highway.h>

#if defined(SEASCAPE_TURNS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_TURNS_INL_H
#undef SEASCAPE_TURNS_INL_H
#else
#define SEASCAPE_TURNS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// gpu::cos_sin_turns (shaders/shared/phase.h), the same operations in the same order.
template <class D>
HWY_INLINE void cos_sin_turns(D d, hn::Vec<hn::RebindToSigned<D>> turns, hn::Vec<D>& cosine, hn::Vec<D>& sine) {
  using Vector = hn::Vec<D>;
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const auto quarter = hn::ShiftRight<30>(hn::BitCast(du, hn::Add(turns, hn::Set(di, 0x20000000))));
  const auto rest = hn::Sub(turns, hn::BitCast(di, hn::ShiftLeft<30>(quarter)));
  const Vector f = hn::Mul(hn::ConvertTo(d, rest), hn::Set(d, 2.3283064365386963e-10f));
  const Vector f2 = hn::Mul(f, f);
  Vector s = hn::Mul(f2, hn::Set(d, -75.401612699015970f));
  s = hn::Mul(f2, hn::Add(hn::Set(d, 81.592542871205710f), s));
  s = hn::Mul(f2, hn::Add(hn::Set(d, -41.341662570547270f), s));
  s = hn::Mul(f, hn::Add(hn::Set(d, 6.2831852878129455f), s));
  Vector c = hn::Mul(f2, hn::Set(d, 59.424105800289940f));
  c = hn::Mul(f2, hn::Add(hn::Set(d, -85.448820084313820f), c));
  c = hn::Mul(f2, hn::Add(hn::Set(d, 64.939369051373060f), c));
  c = hn::Mul(f2, hn::Add(hn::Set(d, -19.739208789987394f), c));
  c = hn::Add(hn::Set(d, 1.0f), c);
  const auto swap = hn::MaskFromVec(hn::BitCast(d, hn::Neg(hn::BitCast(di, hn::And(quarter, hn::Set(du, 1u))))));
  const auto sign = hn::Set(du, 0x80000000u);
  const auto sign_x = hn::And(hn::ShiftLeft<30>(hn::Add(quarter, hn::Set(du, 1u))), sign);
  const auto sign_y = hn::And(hn::ShiftLeft<30>(quarter), sign);
  cosine = hn::Xor(hn::IfThenElse(swap, s, c), hn::BitCast(d, sign_x));
  sine = hn::Xor(hn::IfThenElse(swap, c, s), hn::BitCast(d, sign_y));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();
#endif
