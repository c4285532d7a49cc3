#include "ocean/sea/query_simd.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/sea/query_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// No multiplication is fused with an addition anywhere here: not every instruction set can, and all have to give the
// same bits.

// Points in work at once: enough that the reads of many overlap, few enough that all they need stays in the first-level
// cache.
constexpr int group = 32;
constexpr int most_layers = 2 * WaveField::most_places;

// A group of points; what lies past the last repeats it. A rest position is the place asked plus `way`, which is a
// displacement turned about: a float holds it as well as the tiles do, so that only where the place is in a tile needs
// double.
struct Group {
  alignas(64) double x[group], z[group];
  alignas(64) float way_x[group], way_z[group];
  alignas(64) float miss_x[group], miss_z[group],
      residual[group];  // from the point that stands there to the place asked
  alignas(64) std::int32_t iterations[group];
  alignas(64) std::int32_t whole_x[most_layers][group], whole_z[most_layers][group];  // texel of the place, and
  alignas(64) float part_x[most_layers][group], part_z[most_layers][group];           // how far into it
  // Of the four texels that a sample blends, in the order (x, z), (x + 1, z), (x, z + 1), (x + 1, z + 1): where the
  // first of each row is, in floats from the plane's first, its bits turned over where the second is the row's first;
  // and their weights.
  alignas(64) std::int32_t upper[most_layers][group], lower[most_layers][group];
  alignas(64) float weight[most_layers][4 * group];
  alignas(64) float shift[4 * group], slope[4 * group], velocity[4 * group];  // a texel a point
};

// In double, so that a sample a thousand kilometres out is as exact as one at the origin.
void place_in_tiles(const QueryPlan& plan, Group& g, int count) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> df;
  const hn::Rebind<std::int32_t, decltype(d)> di;
  const int lanes = int(hn::Lanes(d));
  for (int l = 0; l < plan.count; ++l) {
    const QueryLayer& layer = plan.layers[std::size_t(l)];
    const auto cosine = hn::Set(d, layer.cosine), sine = hn::Set(d, layer.sine),
               inverse_side = hn::Set(d, layer.inverse_side);
    const auto size = hn::Set(d, layer.size), first = hn::Set(d, layer.first);
    for (int i = 0; i < count; i += lanes) {
      const auto x = hn::Load(d, g.x + i), z = hn::Load(d, g.z + i);
      const auto u = hn::Mul(hn::Add(hn::Mul(cosine, x), hn::Mul(sine, z)), inverse_side);
      const auto v = hn::Mul(hn::Sub(hn::Mul(cosine, z), hn::Mul(sine, x)), inverse_side);
      const auto texel_x = hn::Add(hn::Mul(hn::Sub(u, hn::Floor(u)), size), first);
      const auto texel_z = hn::Add(hn::Mul(hn::Sub(v, hn::Floor(v)), size), first);
      const auto whole_x = hn::DemoteTo(di, texel_x), whole_z = hn::DemoteTo(di, texel_z);  // positive: the floor
      hn::Store(whole_x, di, g.whole_x[l] + i);
      hn::Store(whole_z, di, g.whole_z[l] + i);
      hn::Store(hn::DemoteTo(df, hn::Sub(texel_x, hn::PromoteTo(d, whole_x))), df, g.part_x[l] + i);
      hn::Store(hn::DemoteTo(df, hn::Sub(texel_z, hn::PromoteTo(d, whole_z))), df, g.part_z[l] + i);
    }
  }
}

// The texels around the rest positions of points i to i + lanes - 1.
template <class D>
HWY_INLINE void locate(D d, const QueryPlan& plan, Group& g, int i) {
  const hn::RebindToSigned<D> di;
  const auto way_x = hn::Load(d, g.way_x + i), way_z = hn::Load(d, g.way_z + i), one = hn::Set(d, 1.0f);
  const auto next = hn::Set(di, 1);
  for (int l = 0; l < plan.count; ++l) {
    const QueryLayer& layer = plan.layers[std::size_t(l)];
    const auto cosine = hn::Set(d, layer.cosine_a_texel), sine = hn::Set(d, layer.sine_a_texel),
               share = hn::Set(d, layer.share);
    const auto mask = hn::Set(di, layer.mask), stride = hn::Set(di, layer.stride);
    const auto x = hn::Add(hn::Add(hn::Mul(cosine, way_x), hn::Mul(sine, way_z)), hn::Load(d, g.part_x[l] + i));
    const auto z = hn::Add(hn::Sub(hn::Mul(cosine, way_z), hn::Mul(sine, way_x)), hn::Load(d, g.part_z[l] + i));
    const auto floor_x = hn::Floor(x), floor_z = hn::Floor(z);
    // The mask wraps, and keeps the reads of a place that is no number in the tile.
    const auto x0 = hn::And(hn::Add(hn::ConvertTo(di, floor_x), hn::Load(di, g.whole_x[l] + i)), mask);
    const auto z_whole = hn::Add(hn::ConvertTo(di, floor_z), hn::Load(di, g.whole_z[l] + i));
    const auto z0 = hn::And(z_whole, mask), z1 = hn::And(hn::Add(z_whole, next), mask);
    const auto last = hn::VecFromMask(di, hn::Eq(x0, mask));
    hn::Store(hn::Xor(hn::ShiftLeft<2>(hn::Add(hn::Mul(z0, stride), x0)), last), di, g.upper[l] + i);
    hn::Store(hn::Xor(hn::ShiftLeft<2>(hn::Add(hn::Mul(z1, stride), x0)), last), di, g.lower[l] + i);
    const auto right = hn::Sub(x, floor_x), below = hn::Sub(z, floor_z);
    const auto left = hn::Sub(one, right), under = hn::Mul(below, share), above = hn::Mul(hn::Sub(one, below), share);
    hn::StoreInterleaved4(hn::Mul(left, above), hn::Mul(right, above), hn::Mul(left, under), hn::Mul(right, under), d,
                          g.weight[l] + 4 * i);
  }
}

// Two texels of a row.
template <class D8>
HWY_INLINE hn::Vec<D8> pair(D8 d, const float* texels, std::ptrdiff_t at, std::int32_t mask) {
  if (HWY_LIKELY(at >= 0)) return hn::LoadU(d, texels + at);
  const hn::Half<D8> half;
  return hn::Combine(d, hn::LoadU(half, texels + ~at - 4 * std::ptrdiff_t(mask)), hn::LoadU(half, texels + ~at));
}

using Plane = const float* QueryLayer::*;

// The four floats of each plane at a point, summed over the layers for each of the four texels and then over these: two
// at a time where vectors are wide enough.
template <class... Planes>
HWY_INLINE void sample(const QueryPlan& plan, const Group& g, int point, float* const (&to)[sizeof...(Planes)],
                       Planes... planes) {
  constexpr std::size_t count = sizeof...(Planes);
  const Plane plane[count] = {planes...};
  const hn::FixedTag<float, 4> d4;
#if HWY_MAX_BYTES >= 32
  const hn::FixedTag<float, 8> d;
  alignas(32) static constexpr std::int32_t spread_upper[8] = {0, 0, 0, 0, 1, 1, 1, 1},
                                            spread_lower[8] = {2, 2, 2, 2, 3, 3, 3, 3};
  const auto of_upper = hn::SetTableIndices(d, spread_upper), of_lower = hn::SetTableIndices(d, spread_lower);
  hn::Vec<decltype(d)> upper[count], lower[count];
  for (std::size_t p = 0; p < count; ++p) upper[p] = lower[p] = hn::Zero(d);
  for (int l = 0; l < plan.count; ++l) {
    const QueryLayer& layer = plan.layers[std::size_t(l)];
    const auto weight = hn::LoadDup128(d, g.weight[l] + 4 * point);
    const auto weight_upper = hn::TableLookupLanes(weight, of_upper),
               weight_lower = hn::TableLookupLanes(weight, of_lower);
    const std::ptrdiff_t at_upper = g.upper[l][point], at_lower = g.lower[l][point];
    for (std::size_t p = 0; p < count; ++p) {
      auto above = pair(d, layer.*plane[p], at_upper, layer.mask),
           below = pair(d, layer.*plane[p], at_lower, layer.mask);
      if (HWY_UNLIKELY(!layer.plain && plane[p] != &QueryLayer::slope)) {
        const auto laid = hn::LoadDup128(d, layer.laid.data());
        above = hn::Mul(laid, above);
        below = hn::Mul(laid, below);
      }
      upper[p] = hn::Add(upper[p], hn::Mul(weight_upper, above));
      lower[p] = hn::Add(lower[p], hn::Mul(weight_lower, below));
    }
  }
  for (std::size_t p = 0; p < count; ++p)
    hn::Store(hn::Add(hn::Add(hn::LowerHalf(d4, upper[p]), hn::UpperHalf(d4, upper[p])),
                      hn::Add(hn::LowerHalf(d4, lower[p]), hn::UpperHalf(d4, lower[p]))),
              d4, to[p]);
#else
  for (std::size_t p = 0; p < count; ++p) {
    auto upper_left = hn::Zero(d4), upper_right = upper_left, lower_left = upper_left, lower_right = upper_left;
    for (int l = 0; l < plan.count; ++l) {
      const QueryLayer& layer = plan.layers[std::size_t(l)];
      const float* weight = g.weight[l] + 4 * point;
      const std::ptrdiff_t at_upper = g.upper[l][point], at_lower = g.lower[l][point];
      const std::ptrdiff_t right = at_upper >= 0 ? 4 : -4 * std::ptrdiff_t(layer.mask);
      const float* upper = layer.*plane[p] + (at_upper >= 0 ? at_upper : ~at_upper);
      const float* lower = layer.*plane[p] + (at_lower >= 0 ? at_lower : ~at_lower);
      const bool scaled = !layer.plain && plane[p] != &QueryLayer::slope;
      const auto laid = hn::LoadU(d4, layer.laid.data());
      const auto texel = [&](const float* at) HWY_ATTR {
        const auto value = hn::LoadU(d4, at);
        return scaled ? hn::Mul(laid, value) : value;
      };
      upper_left = hn::Add(upper_left, hn::Mul(hn::Set(d4, weight[0]), texel(upper)));
      upper_right = hn::Add(upper_right, hn::Mul(hn::Set(d4, weight[1]), texel(upper + right)));
      lower_left = hn::Add(lower_left, hn::Mul(hn::Set(d4, weight[2]), texel(lower)));
      lower_right = hn::Add(lower_right, hn::Mul(hn::Set(d4, weight[3]), texel(lower + right)));
    }
    hn::Store(hn::Add(hn::Add(upper_left, upper_right), hn::Add(lower_left, lower_right)), d4, to[p]);
  }
#endif
}

template <class D>
HWY_INLINE void search(D d, const QueryPlan& plan, Group& g, int count) {
  static_assert(group <= 64);
  const hn::RebindToSigned<D> di;
  const int lanes = int(hn::Lanes(d));
  const auto enough = hn::Set(d, plan.tolerance_m);
  const std::uint64_t some = (std::uint64_t{1} << lanes) - 1;
  std::uint64_t left = ~std::uint64_t{0} >> (64 - count);  // the points still searched for
  for (int iteration = 0; left != 0; ++iteration) {
    if (iteration > 0)
      for (int i = 0; i < count; i += lanes)
        if ((left >> i & some) != 0) locate(d, plan, g, i);
    for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) {
      const int point = std::countr_zero(rest);
      sample(plan, g, point, {g.shift + 4 * point}, &QueryLayer::shift);
    }
    const bool more = iteration < plan.most_iterations;
    for (int i = 0; i < count; i += lanes) {
      if ((left >> i & some) == 0) continue;
      hn::Vec<D> shift_x, height, shift_z, shear;
      hn::LoadInterleaved4(d, g.shift + 4 * i, shift_x, height, shift_z, shear);
      const auto way_x = hn::Load(d, g.way_x + i), way_z = hn::Load(d, g.way_z + i);
      const auto miss_x = hn::Neg(hn::Add(shift_x, way_x)), miss_z = hn::Neg(hn::Add(shift_z, way_z));
      const auto residual = hn::Sqrt(hn::Add(hn::Mul(miss_x, miss_x), hn::Mul(miss_z, miss_z)));
      hn::Store(miss_x, d, g.miss_x + i);
      hn::Store(miss_z, d, g.miss_z + i);
      hn::Store(residual, d, g.residual + i);
      // A point that was found before comes to the same again, and stays.
      const auto found = hn::Le(residual, enough);
      if (more) {
        hn::Store(hn::IfThenElse(found, way_x, hn::Neg(shift_x)), d, g.way_x + i);
        hn::Store(hn::IfThenElse(found, way_z, hn::Neg(shift_z)), d, g.way_z + i);
        const auto iterations = hn::Load(di, g.iterations + i);
        hn::Store(hn::IfThenElse(hn::RebindMask(di, found), iterations, hn::Add(iterations, hn::Set(di, 1))), di,
                  g.iterations + i);
      }
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, found, bytes);
      std::uint64_t bits;
      std::memcpy(&bits, bytes, sizeof bits);
      left &= ~((bits & some) << i);
    }
    if (!more) break;
  }
}

// What else is asked of the points found.
template <class D>
HWY_INLINE void describe(D d, const QueryPlan& plan, Group& g, int count, QueryAnswer* answers) {
  const hn::Rebind<double, hn::Half<D>> dd;
  const hn::Half<D> half_d;
  const int lanes = int(hn::Lanes(d));
  for (int i = 0; i < count; ++i) {
    if (plan.velocity)
      sample(plan, g, i, {g.slope + 4 * i, g.velocity + 4 * i}, &QueryLayer::slope, &QueryLayer::velocity);
    else
      sample(plan, g, i, {g.slope + 4 * i}, &QueryLayer::slope);
  }
  const auto one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
  alignas(64) float height_at[hn::MaxLanes(D())], eulerian[hn::MaxLanes(D())], contraction[hn::MaxLanes(D())],
      least[hn::MaxLanes(D())];
  alignas(64) double normal_x[hn::MaxLanes(D())], normal_y[hn::MaxLanes(D())], normal_z[hn::MaxLanes(D())];
  for (int i = 0; i < count; i += lanes) {
    hn::Vec<D> h_x, h_z, xx, zz, shift_x, height, shift_z, xz;
    hn::LoadInterleaved4(d, g.slope + 4 * i, h_x, h_z, xx, zz);
    hn::LoadInterleaved4(d, g.shift + 4 * i, shift_x, height, shift_z, xz);
    const auto one_xx = hn::Add(one, xx), one_zz = hn::Add(one, zz);
    const auto jacobian = hn::Sub(hn::Mul(one_xx, one_zz), hn::Mul(xz, xz));
    // As SeaSample::slope().
    const auto held = hn::CopySign(hn::Max(hn::Abs(jacobian), hn::Set(d, 1e-3f)), jacobian);
    const auto slope_x = hn::Div(hn::Sub(hn::Mul(one_zz, h_x), hn::Mul(xz, h_z)), held);
    const auto slope_z = hn::Div(hn::Sub(hn::Mul(one_xx, h_z), hn::Mul(xz, h_x)), held);
    // From the point found along the surface to the place asked, by no more than the way between them.
    const auto residual = hn::Load(d, g.residual + i);
    const auto rise = hn::Add(hn::Mul(slope_x, hn::Load(d, g.miss_x + i)), hn::Mul(slope_z, hn::Load(d, g.miss_z + i)));
    hn::Store(hn::Add(height, hn::Max(hn::Neg(residual), hn::Min(rise, residual))), d, height_at);
    // The eigenvalues of grad D, which is symmetric: mean -+ spread.
    const auto mean = hn::Mul(half, hn::Add(xx, zz)), difference = hn::Mul(half, hn::Sub(xx, zz));
    const auto spread = hn::Sqrt(hn::Add(hn::Mul(difference, difference), hn::Mul(xz, xz)));
    hn::Store(hn::Add(hn::Abs(mean), spread), d, contraction);
    hn::Store(hn::Add(one, hn::Sub(mean, spread)), d, least);
    if (plan.velocity) {
      hn::Vec<D> v_x, v_y, v_z, unused;
      hn::LoadInterleaved4(d, g.velocity + 4 * i, v_x, v_y, v_z, unused);
      hn::Store(hn::Sub(v_y, hn::Add(hn::Mul(slope_x, v_x), hn::Mul(slope_z, v_z))), d, eulerian);
    }
    const auto unit = [&](auto s_x, auto s_z, int at) HWY_ATTR {
      const auto x = hn::PromoteTo(dd, s_x), z = hn::PromoteTo(dd, s_z), y = hn::Set(dd, 1.0);
      const auto inverse = hn::Div(y, hn::Sqrt(hn::Add(y, hn::Add(hn::Mul(x, x), hn::Mul(z, z)))));
      hn::Store(hn::Neg(hn::Mul(x, inverse)), dd, normal_x + at);
      hn::Store(inverse, dd, normal_y + at);
      hn::Store(hn::Neg(hn::Mul(z, inverse)), dd, normal_z + at);
    };
    unit(hn::LowerHalf(half_d, slope_x), hn::LowerHalf(half_d, slope_z), 0);
    unit(hn::UpperHalf(half_d, slope_x), hn::UpperHalf(half_d, slope_z), lanes / 2);
    for (int lane = 0; lane < std::min(lanes, count - i); ++lane) {
      const int p = i + lane;
      const float* shift = g.shift + 4 * p;
      const float* velocity = g.velocity + 4 * p;
      QueryAnswer& answer = answers[p];
      answer.height_m = height_at[lane];
      answer.displacement = {shift[0], shift[1], shift[2]};
      answer.normal = {normal_x[lane], normal_y[lane], normal_z[lane]};
      answer.orbital_velocity_mps = plan.velocity ? glm::dvec3(velocity[0], velocity[1], velocity[2]) : glm::dvec3(0.0);
      answer.eulerian_velocity_mps = plan.velocity ? eulerian[lane] : 0.0;
      answer.residual_m = g.residual[p];
      answer.contraction = contraction[lane];
      answer.iterations = g.iterations[p];
      answer.converged = g.residual[p] <= plan.tolerance_m && least[lane] > 0.0f;
    }
  }
}

template <class D>
HWY_INLINE void begin(D d, const QueryPlan& plan, const glm::dvec2* places, const QueryAnswer* previous, Group& g,
                      int count) {
  const int lanes = int(hn::Lanes(d)), padded = (count + lanes - 1) / lanes * lanes;
  for (int i = 0; i < padded; ++i) {
    const int p = std::min(i, count - 1);
    g.x[i] = places[p].x;
    g.z[i] = places[p].y;
    float x = 0.0f, z = 0.0f;
    if (previous) {
      x = -float(previous[p].displacement.x);
      z = -float(previous[p].displacement.z);
      if (!(std::abs(x) + std::abs(z) < 1e6f)) x = z = 0.0f;
    }
    g.way_x[i] = x;
    g.way_z[i] = z;
    g.iterations[i] = 0;
  }
  // What is never sampled is computed with all the same, and denormals would be slow.
  for (float* texels : {g.shift, g.slope, g.velocity}) std::fill(texels + 4 * count, texels + 4 * padded, 0.0f);
  place_in_tiles(plan, g, padded);
  for (int i = 0; i < count; i += lanes) locate(d, plan, g, i);
}

template <class D>
HWY_INLINE void answer_group(D d, const QueryPlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                             QueryAnswer* answers, int count) {
  Group g;
  begin(d, plan, places, previous, g, count);
  search(d, plan, g, count);
  describe(d, plan, g, count, answers);
}

}  // namespace

void answer_all(const QueryPlan& plan, const glm::dvec2* places, const QueryAnswer* previous, QueryAnswer* answers,
                std::size_t count) {
  for (std::size_t i = 0; i < count; i += group) {
    const int some = int(std::min<std::size_t>(group, count - i));
    const QueryAnswer* before = previous ? previous + i : nullptr;
    if (some <= 4)
      answer_group(hn::FixedTag<float, 4>(), plan, places + i, before, answers + i, some);
    else
      answer_group(hn::CappedTag<float, 16>(), plan, places + i, before, answers + i, some);
  }
}

void displace_all(const QueryPlan& plan, const glm::dvec2* rest_m, glm::vec3* displacements, std::size_t count) {
  Group g;
  for (std::size_t i = 0; i < count; i += group) {
    const int some = int(std::min<std::size_t>(group, count - i));
    begin(hn::CappedTag<float, 16>(), plan, rest_m + i, nullptr, g, some);
    for (int point = 0; point < some; ++point) {
      float* const shift = g.shift + 4 * point;
      sample(plan, g, point, {shift}, &QueryLayer::shift);
      displacements[i + std::size_t(point)] = {shift[0], shift[1], shift[2]};
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(answer_all);

void answer_points(const QueryPlan& plan, const glm::dvec2* places, const QueryAnswer* previous, QueryAnswer* answers,
                   std::size_t count) {
  HWY_DYNAMIC_DISPATCH(answer_all)(plan, places, previous, answers, count);
}

HWY_EXPORT(displace_all);

void displace_points(const QueryPlan& plan, const glm::dvec2* rest_m, glm::vec3* displacements, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(displace_all)(plan, rest_m, displacements, count);
}

}  // namespace seascape
#endif
