// How much of each layer of waves there is at the places of a group of points, and what the layers come to, with
// derivatives where they are wanted, for the instruction set that Highway compiles this for.
#include <hwy/highway.h>

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

// flow_height() of two patterns that a current of this square carries, of which the first has the share that `phase`
// says.
template <class V, int count>
HWY_INLINE Dual<V, count> carried_height(const Dual<V, count>& square, float factor, const FlowPhase& phase,
                                         float share_per_s) {
  const hn::DFromV<V> d;
  const float first = float(phase.first), second = 1.0f - first;
  const auto half_square = times(square, factor);
  const auto alike = exp_minus(d, half_square.value), height = height_of_alike(d, alike, first);
  auto result = constant<count>(height);
  if constexpr (count > by_time) {
    const auto cube = hn::Mul(height, hn::Mul(height, height));
    const auto of_way = hn::Mul(cube, hn::Mul(alike, hn::Set(d, first * second)));
    for (const std::size_t by : {by_x, by_z}) result.by[by] = hn::Mul(of_way, half_square.by[by]);
    result.by[by_time] =
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

// How much of each layer there is at the rest positions of points i to i + lanes - 1, and where its pattern is taken:
// put(l, place_x, place_z, there, sideways) gets, of layer l, the way from the places asked (m), what it is to be
// multiplied with, and what of that its Dx and Dz have.
template <int count, class D, class Put>
HWY_INLINE void spread(D d, const PlacePlan& plan, const Group& g, Places& at, int i, const Put& put) {
  using N = Dual<hn::Vec<D>, count>;
  const N zero = constant<count>(hn::Zero(d)), one = constant<count>(hn::Set(d, 1.0f));
  const auto of = [&](int which, float absent) HWY_ATTR { return number<count>(d, plan, at, which, absent, i); };
  N way_x = constant<count>(hn::Load(d, g.way_x + i)), way_z = constant<count>(hn::Load(d, g.way_z + i));
  N first = constant<count>(hn::Set(d, float(plan.phase.first))), second = one - first;
  N first_s = constant<count>(hn::Set(d, float(plan.phase.first_s))),
    second_s = constant<count>(hn::Set(d, float(plan.phase.second_s)));
  const float share_per_s = float((plan.phase.first_s < 0.0 ? 2.0 : -2.0) / plan.period_s);
  if constexpr (count > 0) way_x.by[by_x] = way_z.by[by_z] = one.value;
  if constexpr (count > by_time) {
    first.by[by_time] = hn::Set(d, share_per_s);
    second.by[by_time] = hn::Set(d, -share_per_s);
    first_s.by[by_time] = second_s.by[by_time] = one.value;
  }
  N flow_x = zero, flow_z = zero, run_up = zero;
  if (plan.flow) flow_x = of(PlaceNumbers::flow_x, 0.0f), flow_z = of(PlaceNumbers::flow_z, 0.0f);
  if (plan.bed) run_up = of(PlaceNumbers::run_up, 0.0f);
  const N square = flow_x * flow_x + flow_z * flow_z;
  AlongCurve<N> curve;
  N curve_x = zero, curve_z = zero, curve_square = zero;  // the current in the axes of the curve's pattern
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
      curve_square = curve_x * curve_x + curve_z * curve_z;
    }
  }
  N sum_height = one;  // one over the height of two patterns' sum, which follow each other
  for (int l = 0; l < plan.waves.count; ++l) {
    const PlacedLayer& layer = plan.placed[std::size_t(l)];
    const bool curved = layer.kind == PlacedLayer::curved;
    N off_x = zero, off_z = zero, there = one, sideways = one;
    if (layer.kind == PlacedLayer::dynamic) {
      const N from_x = constant<count>(hn::Load(d, at.from_viewer_x + i)),
              from_z = constant<count>(hn::Load(d, at.from_viewer_z + i));
      there = dynamic_share(layer, from_x + way_x, from_z + way_z);
      sideways.value = hn::Set(d, layer.sharpened);
    } else if (curved) {
      off_x = curve.x;
      off_z = curve.z;
      there = curve.share;
    } else if (plan.bed) {
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
    if (layer.pattern >= 0) {
      const bool is_first = layer.pattern == 0;
      if (is_first)
        sum_height = carried_height(curved ? curve_square : square, layer.flow_height, plan.phase, share_per_s);
      const N& way_s = is_first ? first_s : second_s;
      there = there * ((is_first ? first : second) * sum_height);
      off_x = off_x - (curved ? curve_x : flow_x) * way_s;
      off_z = off_z - (curved ? curve_z : flow_z) * way_s;
    }
    if (layer.kind != PlacedLayer::curved) off_x = way_x + off_x, off_z = way_z + off_z;
    put(l, off_x, off_z, there, sideways);
  }
}

// The texels of all layers, at the rest positions of points i to i + lanes - 1.
template <class D>
HWY_INLINE void locate_placed(D d, const PlacePlan& plan, Group& g, Places& at, int i) {
  using N = Dual<hn::Vec<D>, 0>;
  spread<0>(d, plan, g, at, i, [&](int l, const N& x, const N& z, const N& there, const N& sideways) HWY_ATTR {
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    hn::Store(there.value, d, at.there[l] + i);
    if (!plan.placed[std::size_t(l)].even) hn::Store(sideways.value, d, at.sideways[l] + i);
    const auto share = hn::Mul(hn::Set(d, plan.placed[std::size_t(l)].laid), there.value);
    locate_layer(d, layer, l, g, spot(d, layer, l, g, x.value, z.value, i), share, i);
  });
}

// What locate_placed() finds changes by.
template <int count, class D>
HWY_INLINE void locate_growth(D d, const PlacePlan& plan, Group& g, Places& at, int i) {
  using N = Dual<hn::Vec<D>, count>;
  const auto one = hn::Set(d, 1.0f);
  spread<count>(d, plan, g, at, i, [&](int l, const N& x, const N& z, const N& there, const N& sideways) HWY_ATTR {
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    const PlacedLayer& placed = plan.placed[std::size_t(l)];
    const N share = times(there, placed.laid);
    const Spot<D> spot_at = spot(d, layer, l, g, x.value, z.value, i);
    const auto right = spot_at.right, below = spot_at.below, left = hn::Sub(one, right), above = hn::Sub(one, below);
    const auto cosine = hn::Set(d, layer.cosine_a_texel), sine = hn::Set(d, layer.sine_a_texel);
    for (std::size_t by = 0; by < std::size_t(count); ++by) {
      // By columns and by rows, and by the share.
      const auto u = hn::Mul(share.value, hn::Add(hn::Mul(cosine, x.by[by]), hn::Mul(sine, z.by[by]))),
                 v = hn::Mul(share.value, hn::Sub(hn::Mul(cosine, z.by[by]), hn::Mul(sine, x.by[by])));
      const auto u_above = hn::Mul(u, above), u_below = hn::Mul(u, below), v_left = hn::Mul(v, left),
                 v_right = hn::Mul(v, right);
      const auto more_above = hn::Mul(share.by[by], above), more_below = hn::Mul(share.by[by], below);
      hn::StoreInterleaved4(hn::Sub(hn::Mul(more_above, left), hn::Add(u_above, v_left)),
                            hn::Add(hn::Mul(more_above, right), hn::Sub(u_above, v_right)),
                            hn::Add(hn::Mul(more_below, left), hn::Sub(v_left, u_below)),
                            hn::Add(hn::Mul(more_below, right), hn::Add(u_below, v_right)), d,
                            at.growth[by].weight[l] + 4 * i);
      if (!placed.even) hn::Store(sideways.by[by], d, at.growth[by].sideways[l] + i);
    }
  });
}

// These numbers in a texel's Dx and Dz, and `other` in the rest.
HWY_INLINE hn::Vec<Texels> in_sideways(float value, float other) {
  const Texels d;
  const auto odd = hn::Ne(hn::And(hn::Iota(hn::RebindToSigned<Texels>(), 0), hn::Set(hn::RebindToSigned<Texels>(), 1)),
                          hn::Zero(hn::RebindToSigned<Texels>()));
  return hn::IfThenElse(hn::RebindMask(d, odd), hn::Set(d, other), hn::Set(d, value));
}

// A point's sum of a plane of layers `first` to `end` - 1.
HWY_INLINE void sample_placed(const PlacePlan& plan, const Group& g, const Places& at, int first, int end, int point,
                              Plane plane, float* to) {
  const Texels d;
  hn::Vec<Texels> sum[parts];
  for (auto& part : sum) part = hn::Zero(d);
  for (int l = first; l < end; ++l) {
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    const float* const from = layer.*plane;
    if (at.there[l][point] == 0.0f || from == nullptr) continue;
    hn::Vec<Texels> texels[parts];
    read_texels(from, g.upper[l][point], g.lower[l][point], layer.mask, texels);
    if (!plan.placed[std::size_t(l)].even)
      for (auto& part : texels) part = hn::Mul(in_sideways(at.sideways[l][point], 1.0f), part);
    for (int i = 0; i < parts; ++i)
      sum[i] = hn::Add(sum[i], hn::Mul(weights_of(g.weight[l] + 4 * point, i), texels[i]));
  }
  hn::Store(add_texels(sum), hn::FixedTag<float, 4>(), to + 4 * point);
}

// The `count` derivatives of a point's sum of displacements.
template <int count>
HWY_INLINE void sample_growth(const PlacePlan& plan, const Group& g, const Places& at, int first, int end, int point,
                              float (*to)[4 * group]) {
  const Texels d;
  hn::Vec<Texels> sums[count][parts];
  for (auto& sum : sums)
    for (auto& part : sum) part = hn::Zero(d);
  for (int l = first; l < end; ++l) {
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    if (at.there[l][point] == 0.0f) continue;
    hn::Vec<Texels> texels[parts];
    read_texels(layer.shift, g.upper[l][point], g.lower[l][point], layer.mask, texels);
    const bool even = plan.placed[std::size_t(l)].even;
    for (int i = 0; i < parts; ++i) {
      auto scaled = texels[i];
      if (!even) scaled = hn::Mul(in_sideways(at.sideways[l][point], 1.0f), scaled);
      for (int by = 0; by < count; ++by)
        sums[by][i] = hn::Add(sums[by][i], hn::Mul(weights_of(at.growth[by].weight[l] + 4 * point, i), scaled));
      if (even) continue;
      const auto value = hn::Mul(weights_of(g.weight[l] + 4 * point, i), texels[i]);
      for (int by = 0; by < count; ++by)
        sums[by][i] = hn::Add(sums[by][i], hn::Mul(in_sideways(at.growth[by].sideways[l][point], 0.0f), value));
    }
  }
  for (int by = 0; by < count; ++by) hn::Store(add_texels(sums[by]), hn::FixedTag<float, 4>(), to[by] + 4 * point);
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
    for (std::size_t n = 0; n < std::size_t(count); ++n) result.by[n] = hn::Load(d, from[n + 1] + i);
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
