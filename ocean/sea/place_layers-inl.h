// How much of each layer of waves there is at the places of a group of points, and what the layers come to, with
// derivatives where they are wanted, for the instruction set that Highway compiles this for.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "ocean/sea/place_query_simd.h"

#if defined(SEASCAPE_PLACE_LAYERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_PLACE_LAYERS_INL_H
#undef SEASCAPE_PLACE_LAYERS_INL_H
#else
#define SEASCAPE_PLACE_LAYERS_INL_H
#endif

#include "ocean/sea/place_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

// Two patterns that a current carries: how far each has come, and the current.
template <class N>
struct Carried {
  std::array<N, 2> x, z;
  N flow_x, flow_z;
};
template <class N>
HWY_INLINE Carried<N> carried(const N& flow_x, const N& flow_z, const FlowPhase& phase) {
  const float first = float(phase.first_s), second = float(phase.second_s);
  return {{times(flow_x, first), times(flow_x, second)}, {times(flow_z, first), times(flow_z, second)}, flow_x, flow_z};
}

// flow_height() of these patterns, and what it grows by in a second.
template <class V, int count>
struct CarriedHeight {
  Dual<V, count> height;
  V in_second;
};
template <class V, int count>
HWY_INLINE CarriedHeight<V, count> carried_height(const Carried<Dual<V, count>>& by, const glm::vec3& decay,
                                                  const FlowPhase& phase, float share_per_s) {
  const hn::DFromV<V> d;
  const float first = float(phase.first), second = 1.0f - first;
  const auto apart = (times(by.flow_x, decay.x) + times(by.flow_z, 2.0f * decay.z)) * by.flow_x +
                     times(by.flow_z, decay.y) * by.flow_z;
  const auto alike = exp_minus(d, apart.value), height = height_of_alike(d, alike, first);
  CarriedHeight<V, count> result{constant<count>(height), hn::Zero(d)};
  if constexpr (count > 0) {
    const auto cube = hn::Mul(height, hn::Mul(height, height));
    const auto of_way = hn::Mul(cube, hn::Mul(alike, hn::Set(d, first * second)));
    for (const std::size_t n : {by_x, by_z}) result.height.by[n] = hn::Mul(of_way, apart.by[n]);
    result.in_second =
        hn::Mul(hn::Mul(cube, hn::Sub(alike, hn::Set(d, 1.0f))), hn::Set(d, share_per_s * (first - second)));
  }
  return result;
}

// How much there is of dynamic waves at rest positions that lie so from the viewer.
template <class V, int count>
HWY_INLINE Dual<V, count> dynamic_share(const PlacedLayer& layer, const Dual<V, count>& x, const Dual<V, count>& z) {
  const hn::DFromV<V> d;
  const auto zero = constant<count>(hn::Zero(d));
  const auto size = [&](const Dual<V, count>& of)
                        HWY_ATTR { return select(hn::Lt(of.value, zero.value), zero - of, of); };
  const auto inside = constant<count>(hn::Set(d, layer.end_m)) - larger(size(x), size(z));
  return times(clamped(times(inside, layer.per_border)), layer.counts);
}

// How much there is of each window's waves of a level, half of whose windows' side this is, at the rest positions of
// points i to i + lanes - 1 (wake_present and wake_share in shaders/shared/wake_windows.h).
template <class V, int count>
struct WakeShares {
  float half_m = 0.0f;
  std::array<Dual<V, count>, gpu::max_wake_windows> of;
};
template <int count, class D, class V = hn::Vec<D>>
HWY_INLINE void weigh_wakes(D d, const PlacePlan& plan, const Places& at, const Dual<V, count>& way_x,
                            const Dual<V, count>& way_z, std::size_t level, float half_m, int i,
                            WakeShares<V, count>& shares) {
  shares.half_m = half_m;
  constexpr float per_fade = 1.0f / (gpu::wake_end - gpu::wake_whole);
  const auto zero = constant<count>(hn::Zero(d)), three = constant<count>(hn::Set(d, 3.0f)),
             end = constant<count>(hn::Set(d, gpu::wake_end * per_fade));
  const auto along = [&](const Dual<V, count>& from) HWY_ATTR {
    const auto size = select(hn::Lt(from.value, zero.value), zero - from, from);
    const auto t = clamped(end - times(size, per_fade / half_m));
    return t * t * (three - (t + t));
  };
  Dual<V, count> sum = zero, all = zero;
  for (std::size_t w = 0; w < std::size_t(plan.wakes.count); ++w) {
    const glm::vec2 middle = plan.wakes.from_middle_m[w][level];
    const auto from_x = constant<count>(hn::Sub(hn::Load(d, at.from_body_x[w] + i), hn::Set(d, middle.x))) + way_x,
               from_z = constant<count>(hn::Sub(hn::Load(d, at.from_body_z[w] + i), hn::Set(d, middle.y))) + way_z;
    shares.of[w] = times(along(from_x) * along(from_z), plan.wakes.presence[w]);
    sum = sum + shares.of[w];
    all = all + shares.of[w] - shares.of[w] * all;
  }
  const auto share = only(hn::Gt(sum.value, zero.value), all / sum);
  for (std::size_t w = 0; w < std::size_t(plan.wakes.count); ++w) shares.of[w] = shares.of[w] * share;
}

// How much there is of a window's level, around the viewer or around a body.
template <int count, class D, class V = hn::Vec<D>>
HWY_INLINE Dual<V, count> window_share(D d, const PlacePlan& plan, const Places& at, const PlacedLayer& layer,
                                       const Dual<V, count>& way_x, const Dual<V, count>& way_z, int i,
                                       WakeShares<V, count>& wakes) {
  if (layer.kind == PlacedLayer::dynamic)
    return dynamic_share(layer, constant<count>(hn::Load(d, at.from_viewer_x + i)) + way_x,
                         constant<count>(hn::Load(d, at.from_viewer_z + i)) + way_z);
  if (layer.end_m != wakes.half_m)
    weigh_wakes<count>(d, plan, at, way_x, way_z, std::size_t(layer.bent), layer.end_m, i, wakes);
  return times(wakes.of[std::size_t(layer.share)], layer.counts);
}

// A layer at the rest positions of a vector of points: where its pattern is taken (m), from the places asked; what it
// is to be multiplied with; and what of that its Dx and Dz have.
template <class V, int count>
struct Laid {
  Dual<V, count> x, z, there, sideways;
  V x_s, z_s, there_s;  // what these grow by in a second of a current, where there are derivatives
};

// The warp at the rest positions of points i to i + lanes - 1.
template <int count, class D>
HWY_INLINE void warp_at(D d, const PlacePlan& plan, const Group& g, int i, Dual<hn::Vec<D>, count>& x,
                        Dual<hn::Vec<D>, count>& z) {
  const auto by = warped(d, plan.waves, g, hn::Load(d, g.way_x + i), hn::Load(d, g.way_z + i), i);
  x.value = by.x, z.value = by.z;
  if constexpr (count > 0) {
    x.by[by_x] = by.x_by_x, x.by[by_z] = by.x_by_z;
    z.by[by_x] = by.z_by_x, z.by[by_z] = by.z_by_z;
  }
}

// All layers at the rest positions of points i to i + lanes - 1: put(l, laid) for each.
template <int count, class D, class Put>
HWY_INLINE void spread(D d, const PlacePlan& plan, const Group& g, Places& at, int i, const Put& put) {
  using V = hn::Vec<D>;
  using N = Dual<V, count>;
  const N zero = constant<count>(hn::Zero(d)), one = constant<count>(hn::Set(d, 1.0f));
  const auto of = [&](int which, float absent) HWY_ATTR { return number<count>(d, plan, at, which, absent, i); };
  N way_x = constant<count>(hn::Load(d, g.way_x + i)), way_z = constant<count>(hn::Load(d, g.way_z + i));
  if constexpr (count > 0) way_x.by[by_x] = way_z.by[by_z] = one.value;
  const float first = float(plan.phase.first);
  const float share_per_s = float((plan.phase.first_s < 0.0 ? 2.0 : -2.0) / plan.period_s);
  N flow_x = zero, flow_z = zero, run_up = zero;
  if (plan.flow) flow_x = of(PlaceNumbers::flow_x, 0.0f), flow_z = of(PlaceNumbers::flow_z, 0.0f);
  if (plan.bed) run_up = of(PlaceNumbers::run_up, 0.0f);
  AlongCurve<N> curve;
  N curve_x = zero, curve_z = zero;  // the current in the axes of the curve's pattern
  if (plan.shore) {
    curve = along_curve<count>(d, plan, at, i);
    const auto keep = [&](const N& value, float(*to)[group]) HWY_ATTR {
      hn::Store(value.value, d, to[0] + i);
      for (std::size_t n = 0; n < std::size_t(count); ++n) hn::Store(value.by[n], d, to[n + 1] + i);
    };
    keep(curve.forward_x, at.forward_x);
    keep(curve.forward_z, at.forward_z);
    if (plan.flow) {
      curve_x = curve.stretch * (flow_x * curve.forward_x + flow_z * curve.forward_z);
      curve_z = flow_z * curve.forward_x - flow_x * curve.forward_z;
    }
  }
  // Of a layer that a current carries both patterns; in still water both are the same, which is laid once.
  const auto put_carried = [&](int l, const N& x, const N& z, const N& there, const N& sideways, const Carried<N>& by,
                               const N& way_of_x, const N& way_of_z, V x_s, V z_s) HWY_ATTR {
    const auto still = hn::And(hn::Eq(by.flow_x.value, zero.value), hn::Eq(by.flow_z.value, zero.value));
    const bool all_still = hn::AllTrue(d, still);
    CarriedHeight<V, count> sum{one, zero.value};
    if (!all_still) sum = carried_height(by, plan.placed[std::size_t(l)].decay, plan.phase, share_per_s);
    for (std::size_t pattern = 0; pattern < (all_still ? 1u : 2u); ++pattern) {
      // A pattern whose turn begins has no share yet, but the share grows: it has to count as there (locate_placed).
      const float share = std::max(pattern == 0 ? first : 1.0f - first, 1e-20f);
      const N counts = select(still, pattern == 0 ? one : zero, times(sum.height, share));
      Laid<V, count> laid{way_of_x + (x - by.x[pattern]),
                          way_of_z + (z - by.z[pattern]),
                          there * counts,
                          sideways,
                          x_s,
                          z_s,
                          zero.value};
      if constexpr (count > 0) {
        const auto more = hn::Mul(hn::Set(d, pattern == 0 ? share_per_s : -share_per_s), sum.height.value);
        laid.there_s =
            hn::IfThenZeroElse(still, hn::Mul(there.value, hn::Add(more, hn::Mul(hn::Set(d, share), sum.in_second))));
      }
      put(l + int(pattern), laid);
    }
  };
  N warp_x = zero, warp_z = zero;  // what the warped pattern is shifted by
  if (plan.waves.warp != nullptr) warp_at<count>(d, plan, g, i, warp_x, warp_z);
  Carried<N> by;
  if (plan.flow) by = carried(flow_x, flow_z, plan.phase);
  const auto not_x = hn::Neg(flow_x.value), not_z = hn::Neg(flow_z.value);
  WakeShares<V, count> wakes;
  for (int l = 0; l < plan.curved;) {
    const PlacedLayer& layer = plan.placed[std::size_t(l)];
    if (layer.kind != PlacedLayer::waves) {
      put(l++, Laid<V, count>{way_x, way_z, window_share<count>(d, plan, at, layer, way_x, way_z, i, wakes),
                              constant<count>(hn::Set(d, layer.sharpened)), zero.value, zero.value, zero.value});
      continue;
    }
    N off_x = zero, off_z = zero, there = one, sideways = one;
    if (plan.bed) {
      there = of(PlaceNumbers::share + layer.share, 1.0f);
      if (layer.runs_up) {
        const N flat = there;
        there = root(flat * flat + run_up * run_up);
        sideways = only(hn::Gt(there.value, zero.value), flat / there);
      }
      if (layer.bent >= 0) {
        const N bend = of(PlaceNumbers::bend + layer.bent, 0.0f);
        off_x = times(bend, plan.along[std::size_t(layer.bent)].x);
        off_z = times(bend, plan.along[std::size_t(layer.bent)].y);
      }
    }
    if (plan.waves.layers[std::size_t(l)].warped) off_x = off_x + warp_x, off_z = off_z + warp_z;
    if (plan.flow) {
      put_carried(l, off_x, off_z, there, sideways, by, way_x, way_z, not_x, not_z);
      l += 2;
    } else {
      put(l++, Laid<V, count>{way_x + off_x, way_z + off_z, there, sideways, zero.value, zero.value, zero.value});
    }
  }
  if (plan.curved == plan.waves.count) return;
  if (plan.flow) by = carried(curve_x, curve_z, plan.phase);
  for (int l = plan.curved; l < plan.waves.count;)
    if (plan.flow) {
      put_carried(l, curve.x, curve.z, curve.share, one, by, zero, zero, hn::Neg(curve_x.value),
                  hn::Neg(curve_z.value));
      l += 2;
    } else {
      put(l++, Laid<V, count>{curve.x, curve.z, curve.share, one, zero.value, zero.value, zero.value});
    }
}

// The texels of all layers, at the rest positions of points i to i + lanes - 1, and which layers there are at all.
template <class D>
HWY_INLINE void locate_placed(D d, const PlacePlan& plan, Group& g, Places& at, int i) {
  const hn::RebindToSigned<D> di;
  auto live = hn::Zero(di), live_beyond = live;
  spread<0>(d, plan, g, at, i, [&](int l, const Laid<hn::Vec<D>, 0>& laid) HWY_ATTR {
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    const PlacedLayer& placed = plan.placed[std::size_t(l)];
    const auto there = hn::Ne(laid.there.value, hn::Zero(d));
    const auto bit =
        hn::IfThenElseZero(hn::RebindMask(di, there), hn::Set(di, std::int32_t(std::uint32_t{1} << (l % 32))));
    (l < 32 ? live : live_beyond) = hn::Or(l < 32 ? live : live_beyond, bit);
    if (!placed.even) hn::Store(laid.sideways.value, d, at.sideways[l] + i);
    const auto share = hn::Mul(hn::Set(d, placed.laid), laid.there.value);
    locate_layer(d, layer, l, g, spot(d, layer, l, g, laid.x.value, laid.z.value, i), share, i);
  });
  hn::Store(live, di, at.live[0] + i);
  hn::Store(live_beyond, di, at.live[1] + i);
}

// What locate_placed() finds changes by.
template <int count, class D>
HWY_INLINE void locate_growth(D d, const PlacePlan& plan, Group& g, Places& at, int i) {
  const auto one = hn::Set(d, 1.0f);
  spread<by_time>(d, plan, g, at, i, [&](int l, const Laid<hn::Vec<D>, by_time>& laid) HWY_ATTR {
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    const PlacedLayer& placed = plan.placed[std::size_t(l)];
    const auto share = hn::Mul(laid.there.value, hn::Set(d, placed.laid));
    const Spot<D> spot_at = spot(d, layer, l, g, laid.x.value, laid.z.value, i);
    const auto right = spot_at.right, below = spot_at.below, left = hn::Sub(one, right), above = hn::Sub(one, below);
    const auto cosine = hn::Set(d, layer.cosine_a_texel), sine = hn::Set(d, layer.sine_a_texel);
    // By columns and by rows, and by the share.
    const auto store = [&](hn::Vec<D> x, hn::Vec<D> z, hn::Vec<D> there, float* to) HWY_ATTR {
      const auto u = hn::Mul(share, hn::Add(hn::Mul(cosine, x), hn::Mul(sine, z))),
                 v = hn::Mul(share, hn::Sub(hn::Mul(cosine, z), hn::Mul(sine, x)));
      const auto u_above = hn::Mul(u, above), u_below = hn::Mul(u, below), v_left = hn::Mul(v, left),
                 v_right = hn::Mul(v, right);
      const auto more = hn::Mul(there, hn::Set(d, placed.laid));
      const auto more_above = hn::Mul(more, above), more_below = hn::Mul(more, below);
      hn::StoreInterleaved4(hn::Sub(hn::Mul(more_above, left), hn::Add(u_above, v_left)),
                            hn::Add(hn::Mul(more_above, right), hn::Sub(u_above, v_right)),
                            hn::Add(hn::Mul(more_below, left), hn::Sub(v_left, u_below)),
                            hn::Add(hn::Mul(more_below, right), hn::Add(u_below, v_right)), d, to + 4 * i);
    };
    for (const std::size_t by : {by_x, by_z}) {
      store(laid.x.by[by], laid.z.by[by], laid.there.by[by], at.growth[by].weight[l]);
      if (!placed.even) hn::Store(laid.sideways.by[by], d, at.growth[by].sideways[l] + i);
    }
    if constexpr (count > by_time) store(laid.x_s, laid.z_s, laid.there_s, at.growth[by_time].weight[l]);
  });
}

// Which numbers of texels are Dx and Dz.
HWY_INLINE hn::Mask<Texels> are_sideways() {
  const hn::RebindToSigned<Texels> di;
  return hn::RebindMask(Texels(), hn::Eq(hn::And(hn::Iota(di, 0), hn::Set(di, 1)), hn::Zero(di)));
}

// Texels with their Dx and Dz multiplied by this.
HWY_INLINE hn::Vec<Texels> widened(hn::Vec<Texels> by, hn::Vec<Texels> texels) {
  return hn::IfThenElse(are_sideways(), hn::Mul(by, texels), texels);
}

// The layers of `of` that there are at a point.
HWY_INLINE std::uint64_t live(const Places& at, int point, std::uint64_t of) {
  return of & (std::uint64_t{std::uint32_t(at.live[0][point])} | std::uint64_t{std::uint32_t(at.live[1][point])} << 32);
}

// A point's sum of the displacements of these layers.
HWY_INLINE void sample_placed(const PlacePlan& plan, const Group& g, const Places& at, std::uint64_t layers, int point,
                              float* to) {
  const Texels d;
  hn::Vec<Texels> sum[parts];
  for (auto& part : sum) part = hn::Zero(d);
  for (std::uint64_t rest = live(at, point, layers); rest != 0; rest &= rest - 1) {
    const int l = std::countr_zero(rest);
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    hn::Vec<Texels> texels[parts];
    read_texels(layer.shift, g.upper[l][point], g.lower[l][point], layer.mask, texels);
    if (!plan.placed[std::size_t(l)].even)
      for (auto& part : texels) part = widened(hn::Set(d, at.sideways[l][point]), part);
    for (int i = 0; i < parts; ++i)
      sum[i] = hn::Add(sum[i], hn::Mul(weights_of(g.weight[l] + 4 * point, i), texels[i]));
  }
  hn::Store(add_texels(sum), hn::FixedTag<float, 4>(), to + 4 * point);
}

// The `count` derivatives of a point's sum of displacements, and with `moving` the sum of velocities.
template <int count, bool moving>
HWY_INLINE void sample_growth(const PlacePlan& plan, const Group& g, const Places& at, std::uint64_t layers, int point,
                              float (*to)[4 * group], float* velocity) {
  const Texels d;
  hn::Vec<Texels> sums[count][parts], moved[parts];
  for (auto& sum : sums)
    for (auto& part : sum) part = hn::Zero(d);
  for (auto& part : moved) part = hn::Zero(d);
  for (std::uint64_t rest = live(at, point, layers); rest != 0; rest &= rest - 1) {
    const int l = std::countr_zero(rest);
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    const bool even = plan.placed[std::size_t(l)].even;
    const auto sideways = even ? hn::Zero(d) : hn::Set(d, at.sideways[l][point]);
    hn::Vec<Texels> texels[parts];
    read_texels(layer.shift, g.upper[l][point], g.lower[l][point], layer.mask, texels);
    for (int i = 0; i < parts; ++i) {
      auto scaled = texels[i];
      if (!even) scaled = widened(sideways, scaled);
      for (int by = 0; by < count; ++by)
        sums[by][i] = hn::Add(sums[by][i], hn::Mul(weights_of(at.growth[by].weight[l] + 4 * point, i), scaled));
      if (even) continue;
      const auto value = hn::IfThenElseZero(are_sideways(), hn::Mul(weights_of(g.weight[l] + 4 * point, i), texels[i]));
      for (const int by : {by_x, by_z})
        sums[by][i] = hn::Add(sums[by][i], hn::Mul(hn::Set(d, at.growth[by].sideways[l][point]), value));
    }
    if constexpr (moving) {
      if (layer.velocity == nullptr) continue;
      read_texels(layer.velocity, g.upper[l][point], g.lower[l][point], layer.mask, texels);
      for (int i = 0; i < parts; ++i) {
        if (!even) texels[i] = widened(sideways, texels[i]);
        moved[i] = hn::Add(moved[i], hn::Mul(weights_of(g.weight[l] + 4 * point, i), texels[i]));
      }
    }
  }
  const hn::FixedTag<float, 4> d4;
  for (int by = 0; by < count; ++by) hn::Store(add_texels(sums[by]), d4, to[by] + 4 * point);
  if constexpr (moving) hn::Store(add_texels(moved), d4, velocity + 4 * point);
}

// What the layers' sums make of the water.
template <class N>
struct Water {
  N x, y, z;
};

// Of points i to i + lanes - 1 the sums, curved ones turned.
template <int count, class D>
HWY_INLINE Water<Dual<hn::Vec<D>, count>> add_up(D d, const PlacePlan& plan, const Places& at, const Sums& sums,
                                                 int i) {
  using N = Dual<hn::Vec<D>, count>;
  const auto load = [&](const float(*from)[4 * group]) HWY_ATTR {
    Water<N> water;
    hn::Vec<D> unused;
    hn::LoadInterleaved4(d, from[0] + 4 * i, water.x.value, water.y.value, water.z.value, unused);
    for (std::size_t n = 0; n < std::size_t(count); ++n)
      hn::LoadInterleaved4(d, from[n + 1] + 4 * i, water.x.by[n], water.y.by[n], water.z.by[n], unused);
    return water;
  };
  Water<N> water = load(sums.waves);
  if (!plan.shore) return water;
  const Water<N> curved = load(sums.curved);
  const auto forward = [&](const float(*from)[group]) HWY_ATTR {
    N result = constant<count>(hn::Load(d, from[0] + i));
    for (int n = 0; n < std::min(count, by_time); ++n) result.by[std::size_t(n)] = hn::Load(d, from[n + 1] + i);
    return result;
  };
  const N forward_x = forward(at.forward_x), forward_z = forward(at.forward_z);
  water.x = water.x + (curved.x * forward_x - curved.z * forward_z);
  water.z = water.z + (curved.x * forward_z + curved.z * forward_x);
  water.y = water.y + curved.y;
  return water;
}

// What the ground leaves of the water's ways to the sides, 0 on land.
template <class V, int count>
HWY_INLINE Dual<V, count> wet(const Dual<V, count>& depth) {
  const auto share = times(plus(depth, -gpu::dry_depth_m), 1.0f / (gpu::wet_depth_m - gpu::dry_depth_m));
  const auto t = clamped(share);
  return t * t * (constant<count>(hn::Set(hn::DFromV<V>(), 3.0f)) - (t + t));
}

// The displacement of the water, which stands on the level, and of the ground, where that is higher.
template <int count, class D>
HWY_INLINE Water<Dual<hn::Vec<D>, count>> compose(D d, const PlacePlan& plan, const Places& at, const Sums& sums,
                                                  int i) {
  auto water = add_up<count>(d, plan, at, sums, i);
  const auto level = number<count>(d, plan, at, PlaceNumbers::level, 0.0f, i);
  water.y = water.y + level;
  if (!plan.bed) return water;
  const auto bed = number<count>(d, plan, at, PlaceNumbers::bed, 0.0f, i), share = wet(level - bed);
  water.x = water.x * share;
  water.z = water.z * share;
  water.y = larger(water.y, bed);
  return water;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#endif
