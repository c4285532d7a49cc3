// PatternWarp for vectors of places, for the instruction set that Highway compiles this for. Nothing fuses a
// multiplication with an addition: all instruction sets give the same bits.
#include <hwy/highway.h>

#include <cstdint>

#include "ocean/waves/pattern_warp.h"

#if defined(SEASCAPE_WARP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_WARP_INL_H
#undef SEASCAPE_WARP_INL_H
#else
#define SEASCAPE_WARP_INL_H
#endif

#include "ocean/waves/turns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// PatternWarp::Local: the shift, and what it grows by.
template <class V>
struct Warped {
  V x, z;
  V x_by_x, x_by_z, z_by_x, z_by_z;
};
template <class D>
HWY_INLINE Warped<hn::Vec<D>> unwarped(D d) {
  const auto zero = hn::Zero(d);
  return {zero, zero, zero, zero, zero, zero};
}

// A fraction of a turn around 0, times 2^32.
constexpr double whole_turn = 4294967296.0;

// A wave's phase at places far or near.
template <class D>
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, D>> warp_phase(D d, const PatternWarp::Wave& wave, hn::Vec<D> x,
                                                           hn::Vec<D> z) {
  const auto turns = hn::Add(hn::Add(hn::Mul(hn::Set(d, wave.along.x), x), hn::Mul(hn::Set(d, wave.along.y), z)),
                             hn::Set(d, wave.phase));
  const auto part = hn::Mul(hn::Sub(turns, hn::Round(turns)), hn::Set(d, whole_turn));
  const auto most = hn::Set(d, 2147483647.0);
  return hn::DemoteTo(hn::Rebind<std::int32_t, D>(), hn::Max(hn::Neg(most), hn::Min(part, most)));
}

// A wave's share of the warp at these ways from where it has this phase.
template <class D>
HWY_INLINE void add_wave(D d, const PatternWarp::Wave& wave, hn::Vec<hn::RebindToSigned<D>> phase, hn::Vec<D> way_x,
                         hn::Vec<D> way_z, Warped<hn::Vec<D>>& to) {
  const hn::RebindToSigned<D> di;
  const auto along_x = hn::Set(d, float(wave.along.x)), along_z = hn::Set(d, float(wave.along.y));
  const auto turns = hn::Add(hn::Mul(along_x, way_x), hn::Mul(along_z, way_z));
  const auto part = hn::Mul(hn::Sub(turns, hn::Round(turns)), hn::Set(d, 4294967040.0f));  // next to a whole turn
  hn::Vec<D> cosine, sine;
  cos_sin_turns(d, hn::Add(phase, hn::ConvertTo(di, part)), cosine, sine);
  const auto shift_x = hn::Set(d, float(wave.way.x)), shift_z = hn::Set(d, float(wave.way.y));
  to.x = hn::Add(to.x, hn::Mul(shift_x, sine));
  to.z = hn::Add(to.z, hn::Mul(shift_z, sine));
  const auto grow = [&](double way, double along, hn::Vec<D>& sum) HWY_ATTR {
    sum = hn::Add(sum, hn::Mul(hn::Set(d, float(gpu::warp_growth(way, along, 1.0))), cosine));
  };
  grow(wave.way.x, wave.along.x, to.x_by_x);
  grow(wave.way.x, wave.along.y, to.x_by_z);
  grow(wave.way.y, wave.along.x, to.z_by_x);
  grow(wave.way.y, wave.along.y, to.z_by_z);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#endif
