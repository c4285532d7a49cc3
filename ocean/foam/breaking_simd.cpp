#include "ocean/foam/breaking_simd.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/foam/breaking_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/sea/formulas-inl.h"
#include "ocean/waves/turns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

// No multiplication is fused with an addition anywhere here: all instruction sets give the same bits.

constexpr int group = breaking_group, most_terms = 2 * most_breaking_layers;  // two patterns a layer
using Lanes = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Lanes>;

// What a group of texels reads, term by term. Of the four texels around a place the first of the upper row and of the
// lower one, in floats from the level's first, its bits turned over where the second is the row's first; how far it
// lies below the upper row; what the term counts for, and that times how far it lies to the right.
struct Terms {
  int count = 0;
  const float *slope[most_terms], *shift[most_terms];
  std::int32_t mask[most_terms];
  alignas(64) std::int32_t upper[most_terms][group], lower[most_terms][group];
  alignas(64) float below[most_terms][group], share[most_terms][group], right[most_terms][group];
};

// A group's row of one layer: its first texel, and how far in.
struct Start {
  std::int32_t column, row;
  float part_x, part_z;
  Start(const BreakingLayer& layer, int first) {
    const double u = layer.u + first * layer.step_u, v = layer.v + first * layer.step_v, floor_u = std::floor(u),
                 floor_v = std::floor(v);
    column = std::int32_t(std::int64_t(floor_u) & layer.mask), row = std::int32_t(std::int64_t(floor_v) & layer.mask);
    part_x = float(u - floor_u), part_z = float(v - floor_v);
  }
};

// Texels i to i + lanes - 1 of a group, whose pattern lies `off` texels beside them.
HWY_INLINE void locate(const BreakingLayer& layer, const Start& start, Terms& terms, int term, int i, Vector off_x,
                       Vector off_z, Vector share) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  const auto along = hn::Iota(d, float(i));
  const auto x = hn::Add(hn::Add(hn::Set(d, start.part_x), hn::Mul(along, hn::Set(d, float(layer.step_u)))), off_x);
  const auto z = hn::Add(hn::Add(hn::Set(d, start.part_z), hn::Mul(along, hn::Set(d, float(layer.step_v)))), off_z);
  const auto floor_x = hn::Floor(x), floor_z = hn::Floor(z);
  const auto mask = hn::Set(di, layer.mask), stride = hn::Set(di, layer.stride);
  // The mask wraps, and keeps the reads of a place that is no number in the tile.
  const auto column = hn::And(hn::Add(hn::ConvertTo(di, floor_x), hn::Set(di, start.column)), mask);
  const auto row = hn::Add(hn::ConvertTo(di, floor_z), hn::Set(di, start.row));
  const auto upper = hn::And(row, mask), lower = hn::And(hn::Add(row, hn::Set(di, 1)), mask);
  const auto last = hn::VecFromMask(di, hn::Eq(column, mask));
  hn::Store(hn::Xor(hn::ShiftLeft<2>(hn::Add(hn::Mul(upper, stride), column)), last), di, terms.upper[term] + i);
  hn::Store(hn::Xor(hn::ShiftLeft<2>(hn::Add(hn::Mul(lower, stride), column)), last), di, terms.lower[term] + i);
  hn::Store(hn::Sub(z, floor_z), d, terms.below[term] + i);
  hn::Store(share, d, terms.share[term] + i);
  hn::Store(hn::Mul(share, hn::Sub(x, floor_x)), d, terms.right[term] + i);
}

// How far the pattern at texels i to i + lanes - 1 of a group is shifted, in the level's texels.
HWY_INLINE void shift_pattern(const BreakingLayer& layer, int first, int i, Vector& off_x, Vector& off_z) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  auto x = hn::Zero(d), z = hn::Zero(d);
  for (const WarpRow::Wave& wave : layer.warp->waves) {
    const auto whole = [](double turns) {  // times 2^32, of which 32 bits count
      return std::int32_t(std::uint32_t(std::int64_t((turns - std::floor(turns)) * 4294967296.0)));
    };
    const auto turns = hn::Add(hn::Set(di, whole(wave.turns + first * wave.step)),
                               hn::Mul(hn::Iota(di, i), hn::Set(di, whole(wave.step))));
    Vector cosine, sine;
    cos_sin_turns(d, turns, cosine, sine);
    x = hn::Add(x, hn::Mul(hn::Set(d, wave.way_x), sine));
    z = hn::Add(z, hn::Mul(hn::Set(d, wave.way_z), sine));
  }
  const auto cosine = hn::Set(d, layer.cosine), sine = hn::Set(d, layer.sine);
  off_x = hn::Add(hn::Mul(cosine, x), hn::Mul(sine, z));
  off_z = hn::Sub(hn::Mul(cosine, z), hn::Mul(sine, x));
}

// A layer as water that stands reads it, or with `flow_x` and `flow_z` (a group's, m/s) the two patterns of it that the
// flow carries along in turn.
HWY_INLINE void add_terms(const BreakingLayer& layer, const BreakingLaw& law, const FlowPhase& phase,
                          const float* flow_x, const float* flow_z, int first, Terms& terms) {
  const Lanes d;
  const Start start(layer, first);
  const int patterns = flow_x != nullptr ? 2 : 1, term = terms.count;
  terms.count += patterns;
  for (int n = term; n < terms.count; ++n) {
    terms.slope[n] = &layer.slope->x, terms.shift[n] = &layer.shift->x;
    terms.mask[n] = layer.mask;
  }
  const auto zero = hn::Zero(d), whole = hn::Set(d, layer.share);
  const auto way_s = hn::Set(d, float(std::abs(phase.second_s - phase.first_s)));
  for (int i = 0; i < group; i += int(hn::Lanes(d))) {
    auto warp_x = zero, warp_z = zero;
    if (layer.warp != nullptr) shift_pattern(layer, first, i, warp_x, warp_z);
    if (patterns == 1) {
      locate(layer, start, terms, term, i, warp_x, warp_z, whole);
      continue;
    }
    const auto x = hn::Load(d, flow_x + i), z = hn::Load(d, flow_z + i);
    const auto square = hn::Add(hn::Mul(x, x), hn::Mul(z, z));
    const auto stands = hn::Lt(square, hn::Set(d, law.least_flow_mps * law.least_flow_mps));
    const auto height = flow_height(d, layer.decay_per_m2, hn::Mul(way_s, x), hn::Mul(way_s, z), float(phase.first));
    const auto cosine = hn::Set(d, layer.cosine), sine = hn::Set(d, layer.sine);
    const auto u = hn::Add(hn::Mul(cosine, x), hn::Mul(sine, z)), v = hn::Sub(hn::Mul(cosine, z), hn::Mul(sine, x));
    const auto put = [&](int at, double way, double counts, Vector standing) HWY_ATTR {
      const auto back = hn::Set(d, float(-way));
      locate(layer, start, terms, at, i, hn::Add(warp_x, hn::IfThenElse(stands, zero, hn::Mul(back, u))),
             hn::Add(warp_z, hn::IfThenElse(stands, zero, hn::Mul(back, v))),
             hn::IfThenElse(stands, standing, hn::Mul(whole, hn::Mul(height, hn::Set(d, float(counts))))));
    };
    put(term, phase.first_s, phase.first, whole);
    put(term + 1, phase.second_s, 1.0 - phase.first, zero);
  }
}

// Two texels of a row.
template <class D8>
HWY_INLINE hn::Vec<D8> pair(D8 d, const float* texels, std::ptrdiff_t at, std::int32_t mask) {
  if (HWY_LIKELY(at >= 0)) return hn::LoadU(d, texels + at);
  const hn::Half<D8> half;
  return hn::Combine(d, hn::LoadU(half, texels + ~at - 4 * std::ptrdiff_t(mask)), hn::LoadU(half, texels + ~at));
}

// The sum of a texel's terms: something, dDx/dx, dDx/dz, dDz/dz. The left and the right column are summed alone.
HWY_INLINE void gradient(const Terms& terms, int i, float* to) {
  const hn::FixedTag<float, 4> d4;
#if HWY_MAX_BYTES >= 32
  const hn::FixedTag<float, 8> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  alignas(32) static constexpr std::uint32_t of_left[8] = {~0u, ~0u, ~0u, ~0u, 0, 0, 0, 0},
                                             turned[8] = {1u << 31, 1u << 31, 1u << 31, 1u << 31, 0, 0, 0, 0};
  const auto left = hn::BitCast(d, hn::Load(du, of_left)), minus = hn::BitCast(d, hn::Load(du, turned));
  auto sum = hn::Zero(d);
  for (int n = 0; n < terms.count; ++n) {
    const auto row = [&](std::ptrdiff_t at) HWY_ATTR {
      return hn::InterleaveUpper(d, pair(d, terms.shift[n], at, terms.mask[n]),
                                 pair(d, terms.slope[n], at, terms.mask[n]));
    };
    const auto upper = row(terms.upper[n][i]), lower = row(terms.lower[n][i]);
    const auto value = hn::Add(upper, hn::Mul(hn::Set(d, terms.below[n][i]), hn::Sub(lower, upper)));
    const auto weight =
        hn::Add(hn::And(left, hn::Set(d, terms.share[n][i])), hn::Xor(minus, hn::Set(d, terms.right[n][i])));
    sum = hn::Add(sum, hn::Mul(weight, value));
  }
  hn::Store(hn::Add(hn::LowerHalf(d4, sum), hn::UpperHalf(d4, sum)), d4, to);
#else
  auto left = hn::Zero(d4), right = hn::Zero(d4);
  for (int n = 0; n < terms.count; ++n) {
    const auto texel = [&](std::ptrdiff_t at) HWY_ATTR {
      return hn::InterleaveUpper(d4, hn::LoadU(d4, terms.shift[n] + at), hn::LoadU(d4, terms.slope[n] + at));
    };
    const auto column = [&](bool second) HWY_ATTR {
      const auto place = [&](std::ptrdiff_t at) {
        if (at >= 0) return second ? at + 4 : at;
        return second ? ~at - 4 * std::ptrdiff_t(terms.mask[n]) : ~at;
      };
      const auto upper = texel(place(terms.upper[n][i])), lower = texel(place(terms.lower[n][i]));
      return hn::Add(upper, hn::Mul(hn::Set(d4, terms.below[n][i]), hn::Sub(lower, upper)));
    };
    const auto share = hn::Set(d4, terms.share[n][i]), at_right = hn::Set(d4, terms.right[n][i]);
    left = hn::Add(left, hn::Mul(hn::Sub(share, at_right), column(false)));
    right = hn::Add(right, hn::Mul(at_right, column(true)));
  }
  hn::Store(hn::Add(left, right), d4, to);
#endif
}

// What a normal number exceeds z in: half of erfc(z / sqrt 2), whose fraction in error is less than 1.2e-7 (Press,
// Teukolsky, Vetterling and Flannery 1992, Numerical Recipes, 6.2: erfcc) besides what floats round; 0 beyond 4.
HWY_INLINE Vector exceeded(Vector z) {
  const Lanes d;
  const auto x = hn::Mul(hn::Abs(z), hn::Set(d, 0.70710678f));
  const auto t = hn::Div(hn::Set(d, 1.0f), hn::Add(hn::Set(d, 1.0f), hn::Mul(hn::Set(d, 0.5f), x)));
  auto sum = hn::Set(d, 0.17087277f);
  for (const float c : {-0.82215223f, 1.48851587f, -1.13520398f, 0.27886807f, -0.18628806f, 0.09678418f, 0.37409196f,
                        1.00002368f, -1.26551223f})
    sum = hn::Add(hn::Mul(sum, t), hn::Set(d, c));
  const auto tail = hn::Mul(hn::Mul(hn::Set(d, 0.5f), t), exp_minus(d, hn::Sub(hn::Mul(x, x), sum)));
  const auto both = hn::IfThenElse(hn::Lt(z, hn::Zero(d)), hn::Sub(hn::Set(d, 1.0f), tail), tail);
  return hn::IfThenElse(hn::Gt(z, hn::Set(d, 4.0f)), hn::Zero(d), both);
}

// Texels i to i + lanes - 1 of a row: `g` is what the terms come to, four floats a texel.
HWY_INLINE void add_share(const BreakingLaw& law, const BreakingWater& water, int i, const float* g, float per_s,
                          float* gains) {
  const Lanes d;
  const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  auto moved = hn::Eq(zero, zero);
  Vector other, xx, xz, zz, variance = hn::Set(d, law.variance);
  hn::LoadInterleaved4(d, g, other, xx, xz, zz);
  if (water.kept != nullptr) {
    const auto given = hn::LoadU(d, water.kept + i), kept = hn::IfThenElse(hn::Gt(given, zero), given, zero);
    xx = hn::Mul(kept, xx), zz = hn::Mul(kept, zz), xz = hn::Mul(kept, xz);
    variance = hn::Mul(hn::Mul(kept, kept), variance);
    moved = hn::Gt(given, zero);
  }
  if (water.xx != nullptr) {
    const auto more_xx = hn::LoadU(d, water.xx + i), more_zz = hn::LoadU(d, water.zz + i),
               more_xz = hn::LoadU(d, water.xz + i);
    xx = hn::Add(xx, more_xx), zz = hn::Add(zz, more_zz), xz = hn::Add(xz, more_xz);
    moved = hn::Or(moved, hn::Or(hn::Ne(more_xx, zero), hn::Or(hn::Ne(more_zz, zero), hn::Ne(more_xz, zero))));
  }
  const auto thinner = hn::Set(d, law.thinner), least = hn::Set(d, law.least_sigma);
  auto threshold = hn::Set(d, law.threshold);
  if (water.variance != nullptr) {
    variance = hn::Add(variance, hn::LoadU(d, water.variance + i));
    const auto more = hn::LoadU(d, water.sea_variance + i);
    const auto sigma =
        hn::Add(hn::Mul(thinner, hn::Sqrt(hn::Add(hn::Set(d, law.sea_variance), hn::Max(more, zero)))), least);
    const auto lower = hn::Add(one, hn::Mul(hn::Set(d, law.lowest), sigma));
    const auto held = hn::Min(hn::Max(lower, hn::Set(d, law.least_threshold)), hn::Set(d, law.most_threshold));
    threshold = hn::IfThenElse(hn::Gt(more, zero), held, threshold);
  }
  const auto jacobian = hn::Sub(hn::Mul(hn::Add(one, xx), hn::Add(one, zz)), hn::Mul(xz, xz));
  const auto sigma = hn::Add(hn::Mul(thinner, hn::Sqrt(variance)), least);
  const auto share = hn::IfThenElse(moved, exceeded(hn::Div(hn::Sub(jacobian, threshold), sigma)), zero);
  hn::StoreU(hn::Add(hn::LoadU(d, gains + i), hn::Mul(hn::Set(d, per_s), share)), d, gains + i);
}

}  // namespace

void add_row(std::span<const BreakingLayer> layers, const BreakingLaw& law, const BreakingWater& water,
             const FlowPhase& phase, float per_s, std::span<float> gains) {
  const Lanes d;
  Terms terms;
  alignas(64) float g[4 * group];
  alignas(64) float flow_x[group], flow_z[group];
  const float least = law.least_flow_mps * law.least_flow_mps;
  for (int first = 0; first < int(gains.size()); first += group) {
    bool any = true, flows = false;
    if (water.kept != nullptr)
      any = std::any_of(water.kept + first, water.kept + first + group, [](float kept) { return kept > 0.0f; });
    if (!any && water.xx == nullptr) continue;
    for (int i = 0; any && water.flow_x != nullptr && i < group; ++i) {
      flow_x[i] = water.flow_x[first + i], flow_z[i] = water.flow_z[first + i];
      flows = flows || flow_x[i] * flow_x[i] + flow_z[i] * flow_z[i] >= least;
    }
    terms.count = 0;
    for (std::size_t l = 0; any && l < layers.size(); ++l)
      add_terms(layers[l], law, phase, flows ? flow_x : nullptr, flow_z, first, terms);
    for (int i = 0; i < group; ++i) gradient(terms, i, g + 4 * i);
    for (int i = 0; i < group; i += int(hn::Lanes(d))) add_share(law, water, first + i, g + 4 * i, per_s, gains.data());
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(add_row);

void breaking_row(std::span<const BreakingLayer> layers, const BreakingLaw& law, const BreakingWater& water,
                  const FlowPhase& phase, float per_s, std::span<float> gains) {
  assert(gains.size() % breaking_group == 0 && layers.size() <= std::size_t(most_breaking_layers));
  HWY_DYNAMIC_DISPATCH(add_row)(layers, law, water, phase, per_s, gains);
}

}  // namespace seascape
#endif
