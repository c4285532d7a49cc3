#include "ocean/waves/half_floats.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/waves/half_floats.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/waves/half_floats-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Halves = hn::Rebind<std::uint16_t, Floats>;

void convert(const float* from, std::uint16_t* to, std::size_t count) {
  const Floats d;
  const Halves dh;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(rounded(d, hn::LoadU(d, from + i)), dh, to + i);
  if (i == count) return;
  alignas(64) float last[16] = {};
  alignas(64) std::uint16_t halves[16];
  std::copy(from + i, from + count, last);
  hn::StoreU(rounded(d, hn::LoadU(d, last)), dh, halves);
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
