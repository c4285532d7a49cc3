#include "ocean/sea/place_query_simd.h"

#include <algorithm>
#include <cmath>

#include "ocean/sea/place_sea.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/sea/place_query_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/sea/place_layers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

// So many bits from the lowest on.
constexpr std::uint64_t first_bits(int count) {
  return count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
}

// Where the water is taken away over a bed, the ground is the surface.
HWY_INLINE void dry(const PlacePlan& plan, const Group& g, const float* bed, float* shift, int point) {
  float* const s = shift + 4 * point;
  const glm::dvec2 rest(g.x[point] + double(g.way_x[point]), g.z[point] + double(g.way_z[point]));
  if (!plan.places->dry(rest, {s[0], s[1], s[2]}, plan.time_s, plan.clip)) return;
  s[0] = s[2] = 0.0f;
  s[1] = bed[point];
}

// The displacements of the points whose bits are set in `left` into g.shift.
template <class D>
HWY_INLINE void displace(D d, const PlacePlan& plan, Group& g, Places& at, std::uint64_t left, int count, Sums& sums) {
  const int lanes = int(hn::Lanes(d));
  const std::uint64_t some = (std::uint64_t{1} << lanes) - 1, uncurved = first_bits(plan.curved);
  if (plan.pages != nullptr) {
    for (std::uint64_t rest = plan.seen != nullptr ? left : 0; rest != 0; rest &= rest - 1) {
      const int point = std::countr_zero(rest);
      const glm::dvec2 place(g.x[point] + double(g.way_x[point]), g.z[point] + double(g.way_z[point]));
      const float distance_m = gpu::lod_distance(glm::vec2(place - plan.seen->viewer));
      const PlaceReading reading{gpu::lod_read(plan.reach, plan.slices, distance_m, plan.footprint_m),
                                 plan.reading.texel_m};
      choose_texels(reading.read, reading.fine_texel_m(), at, point);
    }
    for (int i = 0; i < count; i += lanes)
      if ((left >> i & some) != 0) find_texels(d, plan, g, at, left, i);
    for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) read<false>(plan, at, std::countr_zero(rest));
  }
  for (int i = 0; i < count; i += lanes) {
    if ((left >> i & some) == 0) continue;
    arrange(d, plan, at, i, false);
    locate_placed(d, plan, g, at, i);
  }
  for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) {
    const int point = std::countr_zero(rest);
    sample_placed(plan, g, at, uncurved, point, sums.waves[0]);
    if (plan.shore) sample_placed(plan, g, at, ~uncurved, point, sums.curved[0]);
  }
  // Points that were found before have the same sums as then.
  for (int i = 0; i < count; i += lanes) {
    if ((left >> i & some) == 0) continue;
    const auto water = compose<0>(d, plan, at, sums, i);
    hn::StoreInterleaved4(water.x.value, water.y.value, water.z.value, hn::Zero(d), d, g.shift + 4 * i);
  }
  if (!plan.dries) return;
  const float* const bed = at.number[0][plan.numbers.at[PlaceNumbers::bed]];
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
  for (std::uint64_t rest = all; rest != 0; rest &= rest - 1) dry(plan, g, bed, g.shift, std::countr_zero(rest));
}

// The displacement's derivatives at the points that the search has found into g.along_x and g.along_z, and how fast a
// current makes the surface move at a fixed rest position into `with_time`; `derivatives`: 3 where there is one, or 2.
// With `moving` the sums of the water's velocity into `moved`.
template <int derivatives, bool moving, class D>
HWY_INLINE void differentiate(D d, const PlacePlan& plan, Group& g, Places& at, Sums& sums, Sums& moved, int count,
                              float* with_time) {
  const int lanes = int(hn::Lanes(d)), padded = (count + lanes - 1) / lanes * lanes;
  const std::uint64_t uncurved = first_bits(plan.curved);
  for (int point = 0; plan.pages != nullptr && point < count; ++point) read<true>(plan, at, point);
  for (int i = 0; i < count; i += lanes) {
    arrange(d, plan, at, i, true);
    locate_growth<derivatives>(d, plan, g, at, i);
  }
  for (int n = 1; n <= derivatives; ++n)
    for (float* sum : {sums.waves[n], sums.curved[n]}) std::fill(sum + 4 * count, sum + 4 * padded, 0.0f);
  for (float* sum : {moved.waves[0], moved.curved[0]})
    if (moving) std::fill(sum + 4 * count, sum + 4 * padded, 0.0f);
  for (int point = 0; point < count; ++point) {
    sample_growth<derivatives, moving>(plan, g, at, uncurved, point, sums.waves + 1, moved.waves[0]);
    if (plan.shore) sample_growth<derivatives, moving>(plan, g, at, ~uncurved, point, sums.curved + 1, moved.curved[0]);
  }
  for (int i = 0; i < count; i += lanes) {
    const auto water = compose<derivatives>(d, plan, at, sums, i);
    const auto put = [&](std::size_t by, float* to) HWY_ATTR {
      hn::StoreInterleaved4(water.x.by[by], water.y.by[by], water.z.by[by], hn::Zero(d), d, to + 4 * i);
    };
    put(by_x, g.along_x);
    put(by_z, g.along_z);
    if constexpr (derivatives > by_time) put(by_time, with_time);
  }
  // The ground, where the water is taken away.
  if (!plan.dries) return;
  const auto bed = std::size_t(plan.numbers.at[PlaceNumbers::bed]);
  for (int point = 0; point < count; ++point) {
    if (g.shift[4 * point + 1] != at.number[0][bed][point]) continue;
    for (float* along : {g.along_x, g.along_z}) along[4 * point] = along[4 * point + 2] = 0.0f;
    g.along_x[4 * point + 1] = at.number[1][bed][point];
    g.along_z[4 * point + 1] = at.number[2][bed][point];
  }
}

// The water's velocity, whose sums these are.
template <class D>
HWY_INLINE void move_water(D d, const PlacePlan& plan, const Places& at, const Sums& moved, int count,
                           float* velocity) {
  for (int i = 0; i < count; i += int(hn::Lanes(d))) {
    auto water = add_up<0>(d, plan, at, moved, i);
    if (plan.bed) {
      const auto share = wet(number<0>(d, plan, at, PlaceNumbers::level, 0.0f, i) -
                             number<0>(d, plan, at, PlaceNumbers::bed, 0.0f, i));
      water.x = water.x * share;
      water.z = water.z * share;
    }
    hn::StoreInterleaved4(water.x.value, water.y.value, water.z.value, hn::Zero(d), d, velocity + 4 * i);
  }
}

// What of a point's places its answer tells, and its velocity: water goes along with a current, and up and down with
// the surface.
HWY_INLINE void tell(const PlacePlan& plan, const Places& at, const float* water, int point, QueryAnswer& answer) {
  const auto number = [&](PlaceNumbers::Number which) {
    const int from = plan.numbers.at[which];
    return from < 0 ? 0.0f : at.number[0][from][point];
  };
  const float level = number(PlaceNumbers::level), bed = number(PlaceNumbers::bed);
  if (plan.pages == nullptr || !std::isfinite(level)) return;
  answer.still_m = double(level);
  if (plan.bed) answer.depth_m = answer.still_m - double(bed);
  if (plan.flow) answer.flow_mps = {number(PlaceNumbers::flow_x), number(PlaceNumbers::flow_z)};
  if (!plan.waves.velocity || !plan.flow) return;
  if (plan.bed && float(answer.displacement.y) <= bed) return;  // land
  const glm::dvec3& n = answer.normal;
  const glm::dvec2 along = glm::dvec2(water[4 * point], water[4 * point + 2]) + answer.flow_mps;
  answer.orbital_velocity_mps = {along.x, answer.eulerian_velocity_mps.y - (along.x * n.x + along.y * n.z) / n.y,
                                 along.y};
}

// Where a group begins, with nothing read yet.
template <class D>
HWY_INLINE void begin_placed(D d, const PlacePlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                             Group& g, Places& at, Sums& sums, int count) {
  const int lanes = int(hn::Lanes(d)), padded = (count + lanes - 1) / lanes * lanes;
  begin(d, plan.waves, places, previous, g, count);
  const double fine_m = plan.reading.fine_texel_m();
  for (int i = 0; i < padded; ++i) {
    at.from_viewer_x[i] = float(g.x[i] - plan.viewer.x);
    at.from_viewer_z[i] = float(g.z[i] - plan.viewer.y);
    at.texel_m[0][i] = 0.0;
    choose_texels(plan.reading.read, fine_m, at, i);
  }
  for (int w = 0; w < plan.wakes.count; ++w)
    for (int i = 0; i < padded; ++i) {
      at.from_body_x[w][i] = float(g.x[i] - plan.wakes.middle_m[std::size_t(w)].x);
      at.from_body_z[w][i] = float(g.z[i] - plan.wakes.middle_m[std::size_t(w)].y);
    }
  at.slot[0] = at.slot[1] = 0;
  // What is never read is computed with all the same.
  for (auto& texel : at.texel)
    for (int v = 0; v < plan.numbers.vectors; ++v) std::fill(texel[v] + 4 * count, texel[v] + 4 * padded, 0.0f);
  for (float* sum : {sums.waves[0], sums.curved[0]}) std::fill(sum + 4 * count, sum + 4 * padded, 0.0f);
}

template <class D>
HWY_INLINE void answer_group(D d, const PlacePlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                             QueryAnswer* answers, int count) {
  Group g;
  Places at;
  Sums sums;
  begin_placed(d, plan, places, previous, g, at, sums, count);
  search(d, plan.waves, g, count,
         [&](std::uint64_t left, int) HWY_ATTR { displace(d, plan, g, at, left, count, sums); });
  alignas(64) float water[4 * group], with_time[4 * group];
  if (plan.waves.velocity) {
    Sums moved;
    if (plan.flow)
      differentiate<3, true>(d, plan, g, at, sums, moved, count, with_time);
    else
      differentiate<2, true>(d, plan, g, at, sums, moved, count, with_time);
    move_water(d, plan, at, moved, count, water);
    if (plan.flow)
      for (int i = 0; i < 4 * count; ++i) g.velocity[i] = water[i] + with_time[i];
    else
      std::copy_n(water, 4 * count, g.velocity);
  } else if (plan.waves.slopes) {
    differentiate<2, false>(d, plan, g, at, sums, sums, count, with_time);
  }
  const int bed = plan.numbers.at[PlaceNumbers::bed];
  for (int i = 0; plan.bed && plan.waves.velocity && i < count; ++i)  // land stands still
    if (g.shift[4 * i + 1] <= at.number[0][bed][i])
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

void sample_one_placed(const PlacePlan& plan, const glm::dvec2& rest, SeaSample& to) {
  const hn::FixedTag<float, 4> d;
  Group g;
  Places at;
  Sums sums;
  alignas(64) float with_time[4 * group];
  begin_placed(d, plan, &rest, nullptr, g, at, sums, 1);
  displace(d, plan, g, at, 1, 1, sums);
  differentiate<2, false>(d, plan, g, at, sums, sums, 1, with_time);
  to.displacement = {g.shift[0], g.shift[1], g.shift[2]};
  to.height_gradient = {g.along_x[1], g.along_z[1]};
  to.shift_gradient = {g.along_x[0], g.along_z[2], 0.5 * (double(g.along_z[0]) + double(g.along_x[2]))};
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

HWY_EXPORT(sample_one_placed);

SeaSample placed_sample(const PlacePlan& plan, glm::dvec2 rest_m) {
  SeaSample sample;
  HWY_DYNAMIC_DISPATCH(sample_one_placed)(plan, rest_m, sample);
  return sample;
}

}  // namespace seascape
#endif
