// Which texels of a tile a place lies between and what they come to, of one place or of as many as a vector holds, for
// the instruction set that Highway compiles this for. All that samples tiles on the processor does it by these lines.
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#if defined(SEASCAPE_TILE_TEXELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_TILE_TEXELS_INL_H
#undef SEASCAPE_TILE_TEXELS_INL_H
#else
#define SEASCAPE_TILE_TEXELS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// No multiplication is fused with an addition anywhere here: not every instruction set can, and all have to give the
// same bits.

// Places in a tile, in sides, from 0 to 1. In double, so that a place a thousand kilometres out is as exact as one at
// the origin.
template <class D>
struct InTile {
  hn::Vec<D> u, v;
};
template <class D>
HWY_INLINE InTile<D> in_tile(D, hn::Vec<D> cosine, hn::Vec<D> sine, hn::Vec<D> inverse_side, hn::Vec<D> x,
                             hn::Vec<D> z) {
  const auto u = hn::Mul(hn::Add(hn::Mul(cosine, x), hn::Mul(sine, z)), inverse_side);
  const auto v = hn::Mul(hn::Sub(hn::Mul(cosine, z), hn::Mul(sine, x)), inverse_side);
  return {hn::Sub(u, hn::Floor(u)), hn::Sub(v, hn::Floor(v))};
}

// The texels of a level before places in a tile (first_texel), and how far beyond them the places lie.
template <class D>
struct TexelBefore {
  hn::Vec<hn::Rebind<std::int32_t, D>> x, z;
  hn::Vec<hn::Rebind<float, D>> part_x, part_z;
};
template <class D>
HWY_INLINE TexelBefore<D> texel_before(D d, const InTile<D>& at, hn::Vec<D> size, hn::Vec<D> first) {
  const hn::Rebind<float, D> df;
  const hn::Rebind<std::int32_t, D> di;
  const auto texel_x = hn::Add(hn::Mul(at.u, size), first), texel_z = hn::Add(hn::Mul(at.v, size), first);
  const auto x = hn::DemoteTo(di, texel_x), z = hn::DemoteTo(di, texel_z);  // positive: the floor
  return {x, z, hn::DemoteTo(df, hn::Sub(texel_x, hn::PromoteTo(d, x))),
          hn::DemoteTo(df, hn::Sub(texel_z, hn::PromoteTo(d, z)))};
}

// The column and row of the first of the four texels that a sample blends, and how far into the four it lies.
template <class D>
struct Spot {
  hn::Vec<hn::RebindToSigned<D>> column, row;
  hn::Vec<D> right, below;
};

// Of the four texels, in the order (x, z), (x + 1, z), (x, z + 1), (x + 1, z + 1): where the first of each row is, in
// floats from the plane's first, its bits turned over where the second is the row's first; and their weights, which add
// up to `share`. `mask`: texels a side, less 1; `stride`: texels from one row to the next.
template <class D>
struct FourTexels {
  hn::Vec<hn::RebindToSigned<D>> upper, lower;
  hn::Vec<D> left_above, right_above, left_below, right_below;
};
template <class D>
HWY_INLINE FourTexels<D> four_texels(D d, hn::Vec<hn::RebindToSigned<D>> mask, hn::Vec<hn::RebindToSigned<D>> stride,
                                     const Spot<D>& at, hn::Vec<D> share) {
  const hn::RebindToSigned<D> di;
  const auto one = hn::Set(d, 1.0f);
  // The mask wraps, and keeps the reads of a place that is no number in the tile.
  const auto x0 = hn::And(at.column, mask);
  const auto z0 = hn::And(at.row, mask), z1 = hn::And(hn::Add(at.row, hn::Set(di, 1)), mask);
  const auto last = hn::VecFromMask(di, hn::Eq(x0, mask));
  const auto left = hn::Sub(one, at.right), under = hn::Mul(at.below, share),
             above = hn::Mul(hn::Sub(one, at.below), share);
  return {hn::Xor(hn::ShiftLeft<2>(hn::Add(hn::Mul(z0, stride), x0)), last),
          hn::Xor(hn::ShiftLeft<2>(hn::Add(hn::Mul(z1, stride), x0)), last),
          hn::Mul(left, above),
          hn::Mul(at.right, above),
          hn::Mul(left, under),
          hn::Mul(at.right, under)};
}

// Texels of a sample that a vector holds, and vectors that hold its four.
constexpr int texels_at_once = HWY_MAX_BYTES >= 64 ? 4 : HWY_MAX_BYTES >= 32 ? 2 : 1, parts = 4 / texels_at_once;
using Texels = hn::FixedTag<float, 4 * texels_at_once>;

// Reads them; `upper` and `lower` as above.
HWY_INLINE void read_texels(const float* plane, std::ptrdiff_t upper, std::ptrdiff_t lower, std::int32_t mask,
                            hn::Vec<Texels> (&to)[parts]) {
  [[maybe_unused]] const Texels d;
#if HWY_MAX_BYTES >= 32
  const hn::FixedTag<float, 8> d8;
  const auto pair = [&](std::ptrdiff_t at) HWY_ATTR {
    if (HWY_LIKELY(at >= 0)) return hn::LoadU(d8, plane + at);
    const hn::Half<decltype(d8)> half;
    return hn::Combine(d8, hn::LoadU(half, plane + ~at - 4 * std::ptrdiff_t(mask)), hn::LoadU(half, plane + ~at));
  };
#if HWY_MAX_BYTES >= 64
  to[0] = hn::Combine(d, pair(lower), pair(upper));
#else
  to[0] = pair(upper);
  to[1] = pair(lower);
#endif
#else
  const std::ptrdiff_t right = upper >= 0 ? 4 : -4 * std::ptrdiff_t(mask);
  const float* const above = plane + (upper >= 0 ? upper : ~upper);
  const float* const below = plane + (lower >= 0 ? lower : ~lower);
  to[0] = hn::LoadU(d, above);
  to[1] = hn::LoadU(d, above + right);
  to[2] = hn::LoadU(d, below);
  to[3] = hn::LoadU(d, below + right);
#endif
}

// Four weights for the texels of part `part`.
HWY_INLINE hn::Vec<Texels> weights_of(const float* weight, int part) {
  const Texels d;
  alignas(64) static constexpr std::int32_t spread[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
  return hn::TableLookupLanes(hn::LoadDup128(d, weight), hn::SetTableIndices(d, spread + 4 * texels_at_once * part));
}

// Adds up the four texels' numbers.
HWY_INLINE hn::Vec<hn::FixedTag<float, 4>> add_texels(const hn::Vec<Texels> (&sums)[parts]) {
#if HWY_MAX_BYTES >= 32
  const hn::FixedTag<float, 4> d4;
#if HWY_MAX_BYTES >= 64
  const hn::Half<Texels> half;
  const auto upper = hn::LowerHalf(half, sums[0]), lower = hn::UpperHalf(half, sums[0]);
#else
  const auto upper = sums[0], lower = sums[1];
#endif
  return hn::Add(hn::Add(hn::LowerHalf(d4, upper), hn::UpperHalf(d4, upper)),
                 hn::Add(hn::LowerHalf(d4, lower), hn::UpperHalf(d4, lower)));
#else
  return hn::Add(hn::Add(sums[0], sums[1]), hn::Add(sums[2], sums[3]));
#endif
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#endif
