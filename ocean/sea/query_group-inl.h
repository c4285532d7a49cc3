// The search of queries for a group of points at once: where they lie in tiles, what they read there and the steps from
// one to the next, for the instruction set that Highway compiles this for.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "ocean/sea/query_simd.h"

#if defined(SEASCAPE_QUERY_GROUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SEASCAPE_QUERY_GROUP_INL_H
#undef SEASCAPE_QUERY_GROUP_INL_H
#else
#define SEASCAPE_QUERY_GROUP_INL_H
#endif

#include "ocean/sea/formulas-inl.h"
#include "ocean/sea/warp-inl.h"
#include "ocean/waves/tile_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

// Points in work at once: enough that the reads of many overlap, few enough that all they need stays in the first-level
// cache.
constexpr int group = 32;
// One more than there are: of arrays whose sizes are powers of two the same layers would share a few lines of the
// cache.
constexpr int most_layers = most_query_layers + 1;

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
  alignas(64) std::int32_t warp_turns[gpu::warp_waves][group];  // phases of the warp at the places, times 2^32
  // Of the four texels that a sample blends, in the order (x, z), (x + 1, z), (x, z + 1), (x + 1, z + 1): where the
  // first of each row is, in floats from the plane's first, its bits turned over where the second is the row's first;
  // and their weights.
  alignas(64) std::int32_t upper[most_layers][group], lower[most_layers][group];
  alignas(64) float weight[most_layers][4 * group];
  // Derivatives of the weights along the world's x and z, 1 / m (locate_slopes).
  alignas(64) float weight_x[most_layers][4 * group], weight_z[most_layers][4 * group];
  // Four floats a point: Dx, h, Dz of the point, their derivatives over the rest position's x and z, and the velocity.
  alignas(64) float shift[4 * group], along_x[4 * group], along_z[4 * group], velocity[4 * group];
};

// The phases of the warp at the places asked.
void place_in_warp(const PatternWarp& warp, Group& g, int count) {
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<std::int32_t, decltype(d)> di;
  for (std::size_t n = 0; n < warp.waves().size(); ++n)
    for (int i = 0; i < count; i += int(hn::Lanes(d)))
      hn::Store(warp_phase(d, warp.waves()[n], hn::Load(d, g.x + i), hn::Load(d, g.z + i)), di, g.warp_turns[n] + i);
}

// The warp at points i to i + lanes - 1, at these ways from the places asked.
template <class D>
HWY_INLINE Warped<hn::Vec<D>> warped(D d, const QueryPlan& plan, const Group& g, hn::Vec<D> way_x, hn::Vec<D> way_z,
                                     int i) {
  const hn::RebindToSigned<D> di;
  Warped<hn::Vec<D>> sum = unwarped(d);
  for (std::size_t n = 0; n < plan.warp->waves().size(); ++n)
    add_wave(d, plan.warp->waves()[n], hn::Load(di, g.warp_turns[n] + i), way_x, way_z, sum);
  return sum;
}

void place_in_tiles(const QueryPlan& plan, Group& g, int count) {
  if (plan.warp != nullptr) place_in_warp(*plan.warp, g, count);
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> df;
  const hn::Rebind<std::int32_t, decltype(d)> di;
  for (int l = 0; l < plan.count; ++l) {
    const QueryLayer& layer = plan.layers[std::size_t(l)];
    const auto cosine = hn::Set(d, layer.cosine), sine = hn::Set(d, layer.sine),
               inverse_side = hn::Set(d, layer.inverse_side);
    const auto size = hn::Set(d, layer.size), first = hn::Set(d, layer.first);
    for (int i = 0; i < count; i += int(hn::Lanes(d))) {
      const auto place = in_tile(d, cosine, sine, inverse_side, hn::Load(d, g.x + i), hn::Load(d, g.z + i));
      const auto texel = texel_before(d, place, size, first);
      hn::Store(texel.x, di, g.whole_x[l] + i);
      hn::Store(texel.z, di, g.whole_z[l] + i);
      hn::Store(texel.part_x, df, g.part_x[l] + i);
      hn::Store(texel.part_z, df, g.part_z[l] + i);
    }
  }
}

// Where points i to i + lanes - 1 sample a layer, at these ways from the places asked.
template <class D>
HWY_INLINE Spot<D> spot(D d, const QueryLayer& layer, int l, const Group& g, hn::Vec<D> way_x, hn::Vec<D> way_z,
                        int i) {
  const hn::RebindToSigned<D> di;
  const auto cosine = hn::Set(d, layer.cosine_a_texel), sine = hn::Set(d, layer.sine_a_texel);
  const auto x = hn::Add(hn::Add(hn::Mul(cosine, way_x), hn::Mul(sine, way_z)), hn::Load(d, g.part_x[l] + i));
  const auto z = hn::Add(hn::Sub(hn::Mul(cosine, way_z), hn::Mul(sine, way_x)), hn::Load(d, g.part_z[l] + i));
  const auto floor_x = hn::Floor(x), floor_z = hn::Floor(z);
  return {hn::Add(hn::ConvertTo(di, floor_x), hn::Load(di, g.whole_x[l] + i)),
          hn::Add(hn::ConvertTo(di, floor_z), hn::Load(di, g.whole_z[l] + i)), hn::Sub(x, floor_x),
          hn::Sub(z, floor_z)};
}

// The texels around these spots of a layer, and their weights, which add up to `share`.
template <class D>
HWY_INLINE void locate_layer(D d, const QueryLayer& layer, int l, Group& g, const Spot<D>& at, hn::Vec<D> share,
                             int i) {
  const hn::RebindToSigned<D> di;
  const FourTexels<D> four = four_texels(d, hn::Set(di, layer.mask), hn::Set(di, layer.stride), at, share);
  hn::Store(four.upper, di, g.upper[l] + i);
  hn::Store(four.lower, di, g.lower[l] + i);
  hn::StoreInterleaved4(four.left_above, four.right_above, four.left_below, four.right_below, d, g.weight[l] + 4 * i);
}

// The texels around the rest positions of points i to i + lanes - 1.
template <class D>
HWY_INLINE void locate(D d, const QueryPlan& plan, Group& g, int i) {
  const auto way_x = hn::Load(d, g.way_x + i), way_z = hn::Load(d, g.way_z + i);
  auto warped_x = way_x, warped_z = way_z;
  if (plan.warp != nullptr) {
    const auto warp = warped(d, plan, g, way_x, way_z, i);
    warped_x = hn::Add(warped_x, warp.x), warped_z = hn::Add(warped_z, warp.z);
  }
  for (int l = 0; l < plan.count; ++l) {
    const QueryLayer& layer = plan.layers[std::size_t(l)];
    const Spot<D> at = spot(d, layer, l, g, layer.warped ? warped_x : way_x, layer.warped ? warped_z : way_z, i);
    locate_layer(d, layer, l, g, at, hn::Set(d, layer.share), i);
  }
}

// How these texels' weights change along x and z: derivatives of what is read, to the bit those of the surface that the
// weights make.
template <class D>
HWY_INLINE void locate_slopes(D d, const QueryPlan& plan, Group& g, int i) {
  const auto one = hn::Set(d, 1.0f);
  const auto way_x = hn::Load(d, g.way_x + i), way_z = hn::Load(d, g.way_z + i);
  auto warp = unwarped(d);
  if (plan.warp != nullptr) warp = warped(d, plan, g, way_x, way_z, i);
  for (int l = 0; l < plan.count; ++l) {
    const QueryLayer& layer = plan.layers[std::size_t(l)];
    const Spot<D> at = layer.warped ? spot(d, layer, l, g, hn::Add(way_x, warp.x), hn::Add(way_z, warp.z), i)
                                    : spot(d, layer, l, g, way_x, way_z, i);
    const auto left = hn::Sub(one, at.right), above = hn::Sub(one, at.below);
    const auto store = [&](hn::Vec<D> u, hn::Vec<D> v, float* to) HWY_ATTR {
      const auto u_above = hn::Mul(u, above), u_below = hn::Mul(u, at.below);
      const auto v_left = hn::Mul(v, left), v_right = hn::Mul(v, at.right);
      hn::StoreInterleaved4(hn::Neg(hn::Add(u_above, v_left)), hn::Sub(u_above, v_right), hn::Sub(v_left, u_below),
                            hn::Add(u_below, v_right), d, to);
    };
    const float cosine = layer.cosine_a_texel * layer.share, sine = layer.sine_a_texel * layer.share;
    if (HWY_UNLIKELY(layer.warped)) {
      // Of a way along (x, z) of the pattern that a metre makes.
      const auto columns = [&](hn::Vec<D> x, hn::Vec<D> z) HWY_ATTR {
        return hn::Add(hn::Mul(hn::Set(d, cosine), x), hn::Mul(hn::Set(d, sine), z));
      };
      const auto rows = [&](hn::Vec<D> x, hn::Vec<D> z)
                            HWY_ATTR { return hn::Sub(hn::Mul(hn::Set(d, cosine), z), hn::Mul(hn::Set(d, sine), x)); };
      const auto xx = hn::Add(one, warp.x_by_x), zz = hn::Add(one, warp.z_by_z);
      store(columns(xx, warp.z_by_x), rows(xx, warp.z_by_x), g.weight_x[l] + 4 * i);
      store(columns(warp.x_by_z, zz), rows(warp.x_by_z, zz), g.weight_z[l] + 4 * i);
      continue;
    }
    store(hn::Set(d, cosine), hn::Set(d, -sine), g.weight_x[l] + 4 * i);
    store(hn::Set(d, sine), hn::Set(d, cosine), g.weight_z[l] + 4 * i);
  }
}

using Plane = const float* QueryLayer::*;

// By which weights to sum texels up, and where to: four floats a point.
struct Take {
  const float (*weight)[4 * group];
  float* to;
};

// The four floats of a plane at a point, summed over all layers for each of the four texels and then over these.
template <std::size_t count>
HWY_INLINE void sample(const QueryPlan& plan, const Group& g, int point, Plane plane, const Take (&take)[count]) {
  const Texels d;
  hn::Vec<Texels> sums[count][parts];
  for (auto& sum : sums)
    for (auto& part : sum) part = hn::Zero(d);
  for (int l = 0; l < plan.count; ++l) {
    const QueryLayer& layer = plan.layers[std::size_t(l)];
    hn::Vec<Texels> texels[parts];
    read_texels(layer.*plane, g.upper[l][point], g.lower[l][point], layer.mask, texels);
    if (HWY_UNLIKELY(!layer.plain)) {
      const auto laid = hn::LoadDup128(d, layer.laid.data());
      for (auto& part : texels) part = hn::Mul(laid, part);
    }
    for (std::size_t n = 0; n < count; ++n)
      for (int i = 0; i < parts; ++i)
        sums[n][i] = hn::Add(sums[n][i], hn::Mul(weights_of(take[n].weight[l] + 4 * point, i), texels[i]));
  }
  for (std::size_t n = 0; n < count; ++n) hn::Store(add_texels(sums[n]), hn::FixedTag<float, 4>(), take[n].to);
}

// Steps from the rest positions in g.way, until each point's residual is within the tolerance; leaves the last points'
// displacements in g.shift. `displace(left, iteration)` puts there those of the points whose bits are set.
template <class D, class Displace>
HWY_INLINE void search(D d, const QueryPlan& plan, Group& g, int count, const Displace& displace) {
  static_assert(group <= 64);
  const hn::RebindToSigned<D> di;
  const int lanes = int(hn::Lanes(d));
  const auto enough = hn::Set(d, plan.tolerance_m);
  const std::uint64_t some = (std::uint64_t{1} << lanes) - 1;
  std::uint64_t left = ~std::uint64_t{0} >> (64 - count);  // the points still searched for
  for (int iteration = 0; left != 0; ++iteration) {
    displace(left, iteration);
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

// Where a group begins: at the places asked, or where it was a moment ago.
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
  for (float* texels : {g.shift, g.along_x, g.along_z, g.velocity})
    std::fill(texels + 4 * count, texels + 4 * padded, 0.0f);
  for (float* along : {g.along_x, g.along_z})
    if (!plan.slopes) std::fill(along, along + 4 * count, 0.0f);
  place_in_tiles(plan, g, padded);
}

// What a group's answers say, of points whose displacement, derivatives and velocity are known.
template <class D>
HWY_INLINE void finish(D d, const QueryPlan& plan, const Group& g, int count, QueryAnswer* answers) {
  const hn::Rebind<double, hn::Half<D>> dd;
  const hn::Half<D> half_d;
  const int lanes = int(hn::Lanes(d));
  const auto half = hn::Set(d, 0.5f);
  alignas(64) float height_at[hn::MaxLanes(D())], eulerian[3][hn::MaxLanes(D())], contraction[hn::MaxLanes(D())];
  alignas(64) float folded[hn::MaxLanes(D())];
  alignas(64) double normal_x[hn::MaxLanes(D())], normal_y[hn::MaxLanes(D())], normal_z[hn::MaxLanes(D())];
  for (int i = 0; i < count; i += lanes) {
    hn::Vec<D> xx, h_x, zx, xz, h_z, zz, shift_x, height, shift_z, unused;  // xz: dDx/dz
    hn::LoadInterleaved4(d, g.along_x + 4 * i, xx, h_x, zx, unused);
    hn::LoadInterleaved4(d, g.along_z + 4 * i, xz, h_z, zz, unused);
    hn::LoadInterleaved4(d, g.shift + 4 * i, shift_x, height, shift_z, unused);
    const Folded<hn::Vec<D>> f = fold(d, xx, zz, xz, zx);
    const auto rise_x = slope_x(f, h_x, h_z), rise_z = slope_z(f, h_x, h_z);
    // From the point found along the surface to the place asked, by no more than the way between them.
    const auto residual = hn::Load(d, g.residual + i);
    const auto rise = hn::Add(hn::Mul(rise_x, hn::Load(d, g.miss_x + i)), hn::Mul(rise_z, hn::Load(d, g.miss_z + i)));
    hn::Store(hn::Add(height, hn::Max(hn::Neg(residual), hn::Min(rise, residual))), d, height_at);
    // Singular values of grad D: half the sum and half the difference of its two rotations' sizes.
    const auto size = [&](auto a, auto b) HWY_ATTR { return hn::Sqrt(hn::Add(hn::Mul(a, a), hn::Mul(b, b))); };
    hn::Store(hn::Mul(half, hn::Add(size(hn::Add(xx, zz), hn::Sub(zx, xz)), size(hn::Sub(xx, zz), hn::Add(xz, zx)))), d,
              contraction);
    hn::Store(hn::Min(f.jacobian, hn::Add(f.one_xx, f.one_zz)), d, folded);
    if (plan.velocity) {
      hn::Vec<D> v_x, v_y, v_z;
      hn::LoadInterleaved4(d, g.velocity + 4 * i, v_x, v_y, v_z, unused);
      hn::Store(hn::Div(hn::Sub(hn::Mul(f.one_zz, v_x), hn::Mul(xz, v_z)), f.held), d, eulerian[0]);
      hn::Store(hn::Sub(v_y, hn::Add(hn::Mul(rise_x, v_x), hn::Mul(rise_z, v_z))), d, eulerian[1]);
      hn::Store(hn::Div(hn::Sub(hn::Mul(f.one_xx, v_z), hn::Mul(zx, v_x)), f.held), d, eulerian[2]);
    }
    const auto unit = [&](auto s_x, auto s_z, int at) HWY_ATTR {
      const auto x = hn::PromoteTo(dd, s_x), z = hn::PromoteTo(dd, s_z), y = hn::Set(dd, 1.0);
      const auto inverse = hn::Div(y, hn::Sqrt(hn::Add(y, hn::Add(hn::Mul(x, x), hn::Mul(z, z)))));
      hn::Store(hn::Neg(hn::Mul(x, inverse)), dd, normal_x + at);
      hn::Store(inverse, dd, normal_y + at);
      hn::Store(hn::Neg(hn::Mul(z, inverse)), dd, normal_z + at);
    };
    unit(hn::LowerHalf(half_d, rise_x), hn::LowerHalf(half_d, rise_z), 0);
    unit(hn::UpperHalf(half_d, rise_x), hn::UpperHalf(half_d, rise_z), lanes / 2);
    for (int lane = 0; lane < std::min(lanes, count - i); ++lane) {
      const int p = i + lane;
      const float* shift = g.shift + 4 * p;
      const float* velocity = g.velocity + 4 * p;
      QueryAnswer& answer = answers[p];
      if (HWY_UNLIKELY(!std::isfinite(height_at[lane]))) {  // of a place that is no number
        answer = {};
        answer.depth_m = plan.depth_m;
        answer.left_out_m = plan.left_out_m;
        continue;
      }
      answer.height_m = height_at[lane];
      answer.displacement = {shift[0], shift[1], shift[2]};
      answer.normal = {normal_x[lane], normal_y[lane], normal_z[lane]};
      answer.orbital_velocity_mps = plan.velocity ? glm::dvec3(velocity[0], velocity[1], velocity[2]) : glm::dvec3(0.0);
      answer.eulerian_velocity_mps =
          plan.velocity ? glm::dvec3(eulerian[0][lane], eulerian[1][lane], eulerian[2][lane]) : glm::dvec3(0.0);
      answer.flow_mps = glm::dvec2(0.0);
      answer.still_m = 0.0;
      answer.depth_m = plan.depth_m;
      answer.clipped = false;
      answer.left_out_m = plan.left_out_m;
      answer.residual_m = g.residual[p];
      answer.contraction = contraction[lane];
      answer.iterations = g.iterations[p];
      answer.converged = g.residual[p] <= plan.tolerance_m && folded[lane] > 0.0f;
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#endif
