#include "ocean/sea/place_query_simd.h"

#include <algorithm>
#include <cmath>

#include "ocean/sea/place_sea.h"

#define SEASCAPE_QUERY_GROUP 16
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/sea/place_query_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/sea/place_layers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

// Of sums of layers the displacement (`velocity`: the velocity) of the water: curved ones turned, and what the ground
// leaves of it.
template <class D>
HWY_INLINE void compose(D d, const PlacePlan& plan, const Known& at, const Sums& sums, bool velocity, int i,
                        float* to) {
  hn::Vec<D> x, y, z, level = hn::Set(d, 0.0f), bed = level, unused;
  hn::LoadInterleaved4(d, sums.waves + 4 * i, x, y, z, unused);
  if (plan.pages != nullptr) hn::LoadInterleaved4(d, at.value[PlaceTexel::water] + 4 * i, level, bed, unused, unused);
  if (plan.shore) {
    hn::Vec<D> c_x, c_y, c_z;
    hn::LoadInterleaved4(d, sums.curved + 4 * i, c_x, c_y, c_z, unused);
    const auto forward_x = hn::Load(d, at.forward_x + i), forward_z = hn::Load(d, at.forward_z + i);
    x = hn::Add(x, hn::Sub(hn::Mul(c_x, forward_x), hn::Mul(c_z, forward_z)));
    z = hn::Add(z, hn::Add(hn::Mul(c_x, forward_z), hn::Mul(c_z, forward_x)));
    y = hn::Add(y, c_y);
  }
  if (!velocity) y = hn::Add(y, level);
  if (plan.bed) {
    const auto share = hn::Mul(hn::Sub(hn::Sub(level, bed), hn::Set(d, gpu::dry_depth_m)),
                               hn::Set(d, 1.0f / (gpu::wet_depth_m - gpu::dry_depth_m)));
    const auto t = hn::Min(hn::Max(share, hn::Zero(d)), hn::Set(d, 1.0f));
    const auto wet = hn::Mul(hn::Mul(t, t), hn::Sub(hn::Set(d, 3.0f), hn::Add(t, t)));
    x = hn::Mul(x, wet);
    z = hn::Mul(z, wet);
    if (!velocity) y = hn::Max(y, bed);
  }
  hn::StoreInterleaved4(x, y, z, hn::Zero(d), d, to + 4 * i);
}

// Where the water is taken away over a bed, the ground is the surface.
HWY_INLINE void dry(const PlacePlan& plan, const Group& g, const Known& at, float* shift, int point) {
  float* const s = shift + 4 * point;
  const glm::dvec2 rest(g.x[point] + double(g.way_x[point]), g.z[point] + double(g.way_z[point]));
  if (!plan.places->dry(rest, {s[0], s[1], s[2]}, plan.time_s, plan.clip)) return;
  s[0] = s[2] = 0.0f;
  s[1] = at.value[PlaceTexel::water][4 * point + 1];
}

// The displacements of the points whose bits are set in `left` into g.shift.
template <class D>
HWY_INLINE void displace(D d, const PlacePlan& plan, Group& g, Places& at, std::uint64_t left, int count, Sums& sums) {
  const int lanes = int(hn::Lanes(d));
  const std::uint64_t some = (std::uint64_t{1} << lanes) - 1;
  if (plan.pages != nullptr) {
    for (std::uint64_t rest = plan.seen != nullptr ? left : 0; rest != 0; rest &= rest - 1) {
      const int point = std::countr_zero(rest);
      const glm::dvec2 place(g.x[point] + double(g.way_x[point]), g.z[point] + double(g.way_z[point]));
      const float distance_m = gpu::lod_distance(glm::vec2(place - plan.seen->viewer));
      choose_texels({gpu::lod_read(plan.reach, plan.slices, distance_m, plan.footprint_m), plan.reading.texel_m}, at,
                    point);
    }
    for (int i = 0; i < count; i += lanes)
      if ((left >> i & some) != 0) find_texels(d, plan, g, at, i);
    for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) read(plan, at, std::countr_zero(rest), false);
  }
  for (int i = 0; i < count; i += lanes) {
    if ((left >> i & some) == 0) continue;
    if (plan.shore) bend(d, plan, at.now, i);
    spread(d, plan, at, at.now, hn::Load(d, g.way_x + i), hn::Load(d, g.way_z + i), plan.phase, i, at.now.patterns);
    locate<true>(d, plan.waves, g, &at.now.patterns, i);
  }
  for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) {
    const int point = std::countr_zero(rest);
    sample<true>(plan.waves, g, &at.now.patterns, 0, plan.curved, point, &QueryLayer::shift,
                 {{g.weight, sums.waves + 4 * point}});
    if (plan.shore)
      sample<true>(plan.waves, g, &at.now.patterns, plan.curved, plan.waves.count, point, &QueryLayer::shift,
                   {{g.weight, sums.curved + 4 * point}});
  }
  // Points that were found before have the same sums as then.
  for (int i = 0; i < count; i += lanes)
    if ((left >> i & some) != 0) compose(d, plan, at.now, sums, false, i, g.shift);
  if (!plan.dries) return;
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
  for (std::uint64_t rest = all; rest != 0; rest &= rest - 1) dry(plan, g, at.now, g.shift, std::countr_zero(rest));
}

// What a point's sum of layers `first` to `end` - 1 is and what it grows by: in a metre along x and along z, in a
// second by what a current does to the patterns. By the chain rule of each layer's texels, place and share.
HWY_INLINE void grow(const PlacePlan& plan, const Group& g, const Places& at, int first, int end, int point, float* sum,
                     float* along_x, float* along_z, float* with_time) {
  const hn::FixedTag<float, 4> d;
  auto all = hn::Zero(d), all_x = all, all_z = all, all_time = all;
  const Patterns &now = at.now.patterns, &to_x = at.to_x.patterns, &to_z = at.to_z.patterns, &later = at.later;
  for (int l = first; l < end; ++l) {
    if (now.scale[l][4 * point + 1] == 0.0f) continue;
    const QueryLayer& layer = plan.waves.layers[std::size_t(l)];
    const std::ptrdiff_t at_upper = g.upper[l][point], at_lower = g.lower[l][point];
    const std::ptrdiff_t next = at_upper >= 0 ? 4 : -4 * std::ptrdiff_t(layer.mask);
    const float* const upper = layer.shift + (at_upper >= 0 ? at_upper : ~at_upper);
    const float* const lower = layer.shift + (at_lower >= 0 ? at_lower : ~at_lower);
    const auto a = hn::LoadU(d, upper), c = hn::LoadU(d, lower);
    const auto right = hn::Set(d, g.right[l][point]), below = hn::Set(d, g.below[l][point]);
    const auto above = hn::Sub(hn::LoadU(d, upper + next), a), under = hn::Sub(hn::LoadU(d, lower + next), c);
    const auto low = hn::Add(a, hn::Mul(above, right)), row = hn::Sub(hn::Add(c, hn::Mul(under, right)), low);
    const auto column = hn::Add(above, hn::Mul(hn::Sub(under, above), below));
    const auto share = hn::Set(d, layer.share);
    const auto value = hn::Mul(share, hn::Add(low, hn::Mul(row, below)));
    const auto cosine = hn::Set(d, layer.cosine_a_texel * layer.share),
               sine = hn::Set(d, layer.sine_a_texel * layer.share);
    const auto scale = hn::Load(d, now.scale[l] + 4 * point);
    const auto by_x = hn::Mul(scale, hn::Sub(hn::Mul(cosine, column), hn::Mul(sine, row))),
               by_z = hn::Mul(scale, hn::Add(hn::Mul(sine, column), hn::Mul(cosine, row)));
    all = hn::Add(all, hn::Mul(scale, value));
    const auto add = [&](auto& to, const Patterns& other, float per, float own_x, float own_z) HWY_ATTR {
      const float place_x = own_x + per * (other.off_x[l][point] - now.off_x[l][point]),
                  place_z = own_z + per * (other.off_z[l][point] - now.off_z[l][point]);
      const auto more = hn::Mul(hn::Sub(hn::Load(d, other.scale[l] + 4 * point), scale), hn::Set(d, per));
      to = hn::Add(to, hn::Add(hn::Mul(more, value),
                               hn::Add(hn::Mul(by_x, hn::Set(d, place_x)), hn::Mul(by_z, hn::Set(d, place_z)))));
    };
    const float own = layer.alone ? 0.0f : 1.0f;
    add(all_x, to_x, 1.0f / apart_m, own, 0.0f);
    add(all_z, to_z, 1.0f / apart_m, 0.0f, own);
    if (plan.flow) add(all_time, later, float(1.0 / apart_s), 0.0f, 0.0f);
  }
  hn::Store(all, d, sum + 4 * point);
  hn::Store(all_x, d, along_x + 4 * point);
  hn::Store(all_z, d, along_z + 4 * point);
  hn::Store(all_time, d, with_time + 4 * point);
}

// The displacement's derivatives at the points that the search has found into g.along_x and g.along_z, and how fast a
// current makes the surface move at a fixed rest position into `with_time`.
template <class D>
HWY_INLINE void differentiate(D d, const PlacePlan& plan, Group& g, Places& at, int count, float* with_time) {
  const int lanes = int(hn::Lanes(d));
  const auto apart = hn::Set(d, apart_m);
  for (int point = 0; plan.pages != nullptr && point < count; ++point) read(plan, at, point, true);
  const FlowPhase phase_later = flow_phase(plan.time_s + apart_s, plan.period_s);
  for (int i = 0; i < count; i += lanes) {
    for (int v = 0; v < plan.vectors; ++v)
      for (int n = 4 * i; n < 4 * (i + lanes); n += lanes) {
        const auto value = hn::Load(d, at.now.value[v] + n);
        hn::Store(hn::Add(value, hn::Mul(apart, hn::Load(d, at.grows_x[v] + n))), d, at.to_x.value[v] + n);
        hn::Store(hn::Add(value, hn::Mul(apart, hn::Load(d, at.grows_z[v] + n))), d, at.to_z.value[v] + n);
      }
    if (plan.shore) bend(d, plan, at.to_x, i), bend(d, plan, at.to_z, i);
    const auto way_x = hn::Load(d, g.way_x + i), way_z = hn::Load(d, g.way_z + i);
    spread(d, plan, at, at.to_x, hn::Add(way_x, apart), way_z, plan.phase, i, at.to_x.patterns);
    spread(d, plan, at, at.to_z, way_x, hn::Add(way_z, apart), plan.phase, i, at.to_z.patterns);
    if (plan.flow) spread(d, plan, at, at.now, way_x, way_z, phase_later, i, at.later);
  }
  Sums now = {}, along_x = {}, along_z = {}, later = {};
  for (int point = 0; point < count; ++point) {
    grow(plan, g, at, 0, plan.curved, point, now.waves, along_x.waves, along_z.waves, later.waves);
    if (plan.shore)
      grow(plan, g, at, plan.curved, plan.waves.count, point, now.curved, along_x.curved, along_z.curved, later.curved);
  }
  alignas(64) float here[4 * group], there[4 * group];
  const auto move = [&](Sums& by, const Known& to, float* along, int i) HWY_ATTR {
    for (int n = 4 * i; n < 4 * (i + lanes); ++n) {
      by.waves[n] = now.waves[n] + apart_m * by.waves[n];
      by.curved[n] = now.curved[n] + apart_m * by.curved[n];
    }
    compose(d, plan, to, by, false, i, there);
    for (int n = 4 * i; n < 4 * (i + lanes); ++n) along[n] = (there[n] - here[n]) * (1.0f / apart_m);
  };
  for (int i = 0; i < count; i += lanes) {
    compose(d, plan, at.now, now, false, i, here);
    move(along_x, at.to_x, g.along_x, i);
    move(along_z, at.to_z, g.along_z, i);
    compose(d, plan, at.now, later, true, i, with_time);
  }
  // The ground, where the water is taken away.
  for (int point = 0; plan.dries && point < count; ++point) {
    if (g.shift[4 * point + 1] != at.now.value[PlaceTexel::water][4 * point + 1]) continue;
    for (float* along : {g.along_x, g.along_z}) along[4 * point] = along[4 * point + 2] = 0.0f;
    g.along_x[4 * point + 1] = at.grows_x[PlaceTexel::water][4 * point + 1];
    g.along_z[4 * point + 1] = at.grows_z[PlaceTexel::water][4 * point + 1];
  }
}

// The water's velocity at the points that the search has found.
template <class D>
HWY_INLINE void move_water(D d, const PlacePlan& plan, const Group& g, const Places& at, int count, float* water) {
  Sums sums = {};
  for (int point = 0; point < count; ++point) {
    sample<true>(plan.waves, g, &at.now.patterns, 0, plan.curved, point, &QueryLayer::velocity,
                 {{g.weight, sums.waves + 4 * point}});
    if (plan.shore)
      sample<true>(plan.waves, g, &at.now.patterns, plan.curved, plan.waves.count, point, &QueryLayer::velocity,
                   {{g.weight, sums.curved + 4 * point}});
  }
  for (int i = 0; i < count; i += int(hn::Lanes(d))) compose(d, plan, at.now, sums, true, i, water);
}

// What of a point's places its answer tells, and its velocity: water goes along with a current, and up and down with
// the surface.
HWY_INLINE void tell(const PlacePlan& plan, const Places& at, const float* water, int point, QueryAnswer& answer) {
  if (plan.pages == nullptr || !std::isfinite(at.now.value[PlaceTexel::water][4 * point])) return;
  const float* const values = at.now.value[PlaceTexel::water] + 4 * point;
  answer.still_m = double(values[0]);
  if (plan.bed) answer.depth_m = answer.still_m - double(values[1]);
  if (plan.flow) answer.flow_mps = {values[2], values[3]};
  if (!plan.waves.velocity || !plan.flow) return;
  if (plan.bed && float(answer.displacement.y) <= values[1]) return;  // land
  const glm::dvec3& n = answer.normal;
  const glm::dvec2 along = glm::dvec2(water[4 * point], water[4 * point + 2]) + answer.flow_mps;
  answer.orbital_velocity_mps = {along.x, answer.eulerian_velocity_mps.y - (along.x * n.x + along.y * n.z) / n.y,
                                 along.y};
}

template <class D>
HWY_INLINE void answer_group(D d, const PlacePlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                             QueryAnswer* answers, int count) {
  Group g;
  Places at;
  Sums sums;
  const int lanes = int(hn::Lanes(d)), padded = (count + lanes - 1) / lanes * lanes;
  begin(d, plan.waves, places, previous, g, count);
  for (int i = 0; i < padded; ++i) {
    at.from_viewer_x[i] = float(g.x[i] - plan.viewer.x);
    at.from_viewer_z[i] = float(g.z[i] - plan.viewer.y);
    at.slot[0][i] = at.slot[1][i] = 0;
    choose_texels(plan.reading, at, i);
  }
  for (Known* known : {&at.now, &at.to_x, &at.to_z})
    for (float* values : {known->bent_x, known->bent_z, known->stretch, known->forward_x, known->forward_z})
      std::fill(values, values + padded, 0.0f);
  // What is never read is computed with all the same.
  for (int v = 0; v < plan.vectors; ++v)
    for (float* values : {at.now.value[v], at.grows_x[v], at.grows_z[v]})
      std::fill(values + 4 * count, values + 4 * padded, 0.0f);
  for (float* values : {sums.waves, sums.curved}) std::fill(values + 4 * count, values + 4 * padded, 0.0f);
  search(d, plan.waves, g, count,
         [&](std::uint64_t left, int) HWY_ATTR { displace(d, plan, g, at, left, count, sums); });
  alignas(64) float water[4 * group] = {}, with_time[4 * group] = {};
  if (plan.waves.velocity) move_water(d, plan, g, at, count, water);
  if (plan.waves.slopes) differentiate(d, plan, g, at, count, with_time);
  for (int i = 0; i < 4 * count; ++i) g.velocity[i] = water[i] + with_time[i];
  for (int i = 0; plan.bed && i < count; ++i)  // land stands still
    if (g.shift[4 * i + 1] <= at.now.value[PlaceTexel::water][4 * i + 1])
      g.velocity[4 * i] = g.velocity[4 * i + 1] = g.velocity[4 * i + 2] = 0.0f;
  finish(d, plan.waves, g, count, answers);
  for (int i = 0; i < count; ++i) tell(plan, at, water, i, answers[i]);
}

}  // namespace

void answer_all_placed(const PlacePlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                       QueryAnswer* answers, std::size_t count) {
  for (std::size_t i = 0; i < count; i += group) {
    const int some = int(std::min<std::size_t>(group, count - i));
    const QueryAnswer* before = previous ? previous + i : nullptr;
    if (some <= 4)
      answer_group(hn::FixedTag<float, 4>(), plan, places + i, before, answers + i, some);
    else
      answer_group(hn::CappedTag<float, 16>(), plan, places + i, before, answers + i, some);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(answer_all_placed);

void answer_placed_points(const PlacePlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                          QueryAnswer* answers, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(answer_all_placed)(plan, places, previous, answers, count);
}

}  // namespace seascape
#endif
