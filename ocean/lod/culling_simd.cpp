#include "ocean/lod/culling_simd.h"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/lod/culling_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// Which way from quarter 0 each lies, along x and z.
alignas(32) constexpr double east[4] = {0.0, 1.0, 0.0, 1.0}, north[4] = {0.0, 0.0, 1.0, 1.0};

// The quarters from `b` on, as many as a vector of at most four holds. No multiplication is fused with an addition, so that
// every instruction set gives the same answer.
HWY_INLINE unsigned ask_some(const FrustumPlane* planes, const QuarterBoxes& boxes, std::uint64_t asked, std::uint64_t* left, std::size_t b) {
  const hn::CappedTag<double, 4> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const hn::Repartition<std::uint8_t, decltype(d)> d8;
  const auto zero = hn::Zero(d), half = hn::Set(d, boxes.half), step = hn::Set(d, boxes.step);
  const auto x = hn::Add(hn::Set(d, boxes.x), hn::Mul(step, hn::Load(d, east + b)));
  const auto z = hn::Add(hn::Set(d, boxes.z), hn::Mul(step, hn::Load(d, north + b)));
  const auto away_x = hn::Abs(hn::Sub(x, hn::Set(d, boxes.viewer_x))), away_z = hn::Abs(hn::Sub(z, hn::Set(d, boxes.viewer_z)));
  const auto sum_of_squares = [](auto u, auto v) HWY_ATTR { return hn::Add(hn::Mul(u, u), hn::Mul(v, v)); };
  const auto near2 = sum_of_squares(hn::Max(hn::Sub(away_x, half), zero), hn::Max(hn::Sub(away_z, half), zero));
  const auto far2 = sum_of_squares(hn::Add(away_x, half), hn::Add(away_z, half));
  const auto rise = hn::Set(d, boxes.rise), curve = hn::Set(d, boxes.curve);
  const auto high = hn::Sub(rise, hn::Mul(curve, near2)), low = hn::Sub(hn::Neg(rise), hn::Mul(curve, far2));
  // A bit a plane that a box lies wholly beyond, or is not wholly on the seen side of.
  auto beyond = hn::Zero(du), crossed = hn::Zero(du);
  for (std::uint64_t open = asked; open != 0; open &= open - 1) {
    const FrustumPlane& plane = planes[std::countr_zero(open)];
    const auto up = hn::Set(d, plane.up), down = hn::Set(d, plane.down), reach = hn::Set(d, plane.level * boxes.half);
    const auto at = hn::Add(hn::Add(hn::Mul(hn::Set(d, plane.x), x), hn::Mul(hn::Set(d, plane.z), z)), hn::Set(d, plane.offset));
    const auto least = hn::Sub(hn::Add(hn::Mul(up, low), hn::Mul(down, high)), reach);
    const auto most = hn::Add(hn::Add(hn::Mul(up, high), hn::Mul(down, low)), reach);
    const auto bit = hn::Set(du, open & (~open + 1));
    beyond = hn::Or(beyond, hn::IfThenElseZero(hn::RebindMask(du, hn::Lt(hn::Add(at, most), zero)), bit));
    crossed = hn::Or(crossed, hn::IfThenElseZero(hn::RebindMask(du, hn::Lt(hn::Add(at, least), zero)), bit));
  }
  // By eyes, a byte each: an eye beyond one of whose planes a box lies asks no more; one that crosses none sees all of it.
  const auto none8 = hn::Zero(d8);
  const auto not_beyond = hn::Eq(hn::BitCast(d8, beyond), none8);
  const auto left8 = hn::IfThenElseZero(not_beyond, hn::BitCast(d8, crossed));
  const auto wholly8 = hn::And(hn::And(not_beyond, hn::Eq(hn::BitCast(d8, crossed), none8)),
                               hn::Ne(hn::BitCast(d8, hn::Set(du, asked)), none8));
  const auto wholly = hn::Ne(hn::BitCast(du, hn::VecFromMask(d8, wholly8)), hn::Zero(du));
  const auto all_left = hn::BitCast(du, left8);
  hn::StoreU(hn::IfThenZeroElse(wholly, all_left), du, left + b);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(du, hn::Or(wholly, hn::Ne(all_left, hn::Zero(du))), bits);
  return static_cast<unsigned>(bits[0]) << b;
}

unsigned ask_four(const FrustumPlane* planes, const QuarterBoxes& boxes, std::uint64_t asked, std::uint64_t* left) {
  unsigned seen = 0;
  for (std::size_t b = 0; b < 4; b += hn::Lanes(hn::CappedTag<double, 4>())) seen |= ask_some(planes, boxes, asked, left, b);
  return seen;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(ask_four);

unsigned ask_quarters(const FrustumPlane* planes, const QuarterBoxes& boxes, std::uint64_t asked, std::uint64_t* left) {
  return HWY_DYNAMIC_DISPATCH(ask_four)(planes, boxes, asked, left);
}

}  // namespace seascape
#endif
