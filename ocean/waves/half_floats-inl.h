// Floats to 16-bit floats, for the instruction set that Highway compiles this for.
#include <hwy/highway.h>

#if defined(SEASCAPE_HALF_FLOATS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_HALF_FLOATS_INL_H
#undef SEASCAPE_HALF_FLOATS_INL_H
#else
#define SEASCAPE_HALF_FLOATS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// halves_from_floats (half_floats.h), a vector of them.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<std::uint16_t, D>> rounded(D d, hn::Vec<D> value) {
  const hn::Rebind<std::uint16_t, D> dh;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  // These sets have F16C, whose conversion rounds so. Highway's own code for the others cuts.
  return hn::BitCast(dh, hn::DemoteTo(hn::Rebind<hwy::float16_t, D>(), value));
#else
  const hn::RebindToUnsigned<D> du;
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, value);
  const auto magnitude = hn::And(bits, hn::Set(di, 0x7fffffff));
  // Normal halves: the exponent's bias goes from 127 to 15, and 13 bits of the mantissa are rounded off. A carry out of
  // the mantissa is the next exponent's first number, as it should be.
  const auto even = hn::And(hn::ShiftRight<13>(magnitude), hn::Set(di, 1));
  auto half = hn::ShiftRight<13>(hn::Add(hn::Add(magnitude, hn::Set(di, 0xfff - ((127 - 15) << 23))), even));
  // Below 2^-14 a half is a multiple of 2^-24, the last place of floats from 0.5 to 1: the sum with 0.5 rounds there.
  const auto shifted = hn::Add(hn::BitCast(d, magnitude), hn::Set(d, 0.5f));
  const auto small = hn::Sub(hn::BitCast(di, shifted), hn::Set(di, 0x3f000000));
  half = hn::IfThenElse(hn::Lt(magnitude, hn::Set(di, (127 - 14) << 23)), small, half);
  // 65520 and all above round to infinity; what is above infinity is not a number.
  half = hn::IfThenElse(hn::Lt(magnitude, hn::Set(di, 0x477ff000)), half, hn::Set(di, 0x7c00));
  half = hn::IfThenElse(hn::Gt(magnitude, hn::Set(di, 0x7f800000)), hn::Set(di, 0x7e00), half);
  const auto sign = hn::BitCast(di, hn::ShiftLeft<15>(hn::ShiftRight<31>(hn::BitCast(du, value))));
  return hn::DemoteTo(dh, hn::Or(half, sign));
#endif
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();
#endif
