#include "ocean/sea/query_simd.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/sea/query_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/sea/query_group-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {
namespace {

template <class D>
HWY_INLINE void answer_group(D d, const QueryPlan& plan, const glm::dvec2* places, const QueryAnswer* previous,
                             QueryAnswer* answers, int count) {
  Group g;
  begin(d, plan, places, previous, g, count);
  const int lanes = int(hn::Lanes(d));
  search(d, plan, g, count, [&](std::uint64_t left, int) HWY_ATTR {
    const std::uint64_t some = (std::uint64_t{1} << lanes) - 1;
    for (int i = 0; i < count; i += lanes)
      if ((left >> i & some) != 0) locate(d, plan, g, i);
    for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) {
      const int point = std::countr_zero(rest);
      sample(plan, g, point, &QueryLayer::shift, {{g.weight, g.shift + 4 * point}});
    }
  });
  for (int i = 0; plan.slopes && i < count; i += lanes) locate_slopes(d, plan, g, i);
  for (int point = 0; plan.slopes && point < count; ++point) {
    sample(plan, g, point, &QueryLayer::shift,
           {{g.weight_x, g.along_x + 4 * point}, {g.weight_z, g.along_z + 4 * point}});
    if (plan.velocity) sample(plan, g, point, &QueryLayer::velocity, {{g.weight, g.velocity + 4 * point}});
  }
  finish(d, plan, g, count, answers);
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
    const hn::CappedTag<float, 16> d;
    begin(d, plan, rest_m + i, nullptr, g, some);
    for (int at = 0; at < some; at += int(hn::Lanes(d))) locate(d, plan, g, at);
    for (int point = 0; point < some; ++point) {
      float* const shift = g.shift + 4 * point;
      sample(plan, g, point, &QueryLayer::shift, {{g.weight, shift}});
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
