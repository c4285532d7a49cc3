#include "ocean/waves/half_floats.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/waves/half_floats.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Halves = hn::Rebind<std::uint16_t, Floats>;

HWY_INLINE hn::Vec<Halves> rounded(hn::Vec<Floats> value) {
  const Halves dh;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  // These sets have F16C, whose conversion rounds so. Highway's own code for the others cuts.
  return hn::BitCast(dh, hn::DemoteTo(hn::Rebind<hwy::float16_t, Floats>(), value));
#else
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const hn::RebindToSigned<Floats> di;
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

void convert(const float* from, std::uint16_t* to, std::size_t count) {
  const Floats d;
  const Halves dh;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(rounded(hn::LoadU(d, from + i)), dh, to + i);
  if (i == count) return;
  alignas(64) float last[16] = {};
  alignas(64) std::uint16_t halves[16];
  std::copy(from + i, from + count, last);
  hn::StoreU(rounded(hn::LoadU(d, last)), dh, halves);
  std::copy(halves, halves + (count - i), to + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(convert);

void halves_from_floats(const float* from, std::uint16_t* to, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(convert)(from, to, count);
}

}  // namespace seascape
#endif
