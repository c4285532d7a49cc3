// Sampling the dynamic waves at a rest position, with the lines that sample all tiles.
#include <array>

#include "ocean/places/dynamic_surface.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/places/dynamic_sampler_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

#include "ocean/waves/tile_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace seascape {
namespace HWY_NAMESPACE {

void sample_levels(const DynamicSurface& surface, glm::dvec2 rest, std::span<const double> weights, double share,
                   DynamicSample& to) {
  const hn::FixedTag<double, 1> d;
  const hn::FixedTag<float, 1> df;
  const hn::FixedTag<std::int32_t, 1> di;
  const hn::FixedTag<float, 4> d4;
  const int size = surface.samples();
  for (int i = 0; i < surface.levels(); ++i) {
    const double weight = weights[std::size_t(i)], texel_m = surface.texel_m(i);
    if (surface.still(i) || !(weight > 0.0)) continue;
    const auto at = in_tile(d, hn::Set(d, 1.0), hn::Set(d, 0.0), hn::Set(d, 1.0 / (texel_m * size)), hn::Set(d, rest.x),
                            hn::Set(d, rest.y));
    const auto before = texel_before(d, at, hn::Set(d, double(size)), hn::Set(d, size - 0.5));
    const auto four = four_texels(df, hn::Set(di, size - 1), hn::Set(di, size),
                                  Spot<hn::FixedTag<float, 1>>{before.x, before.z, before.part_x, before.part_z},
                                  hn::Set(df, float(weight)));
    alignas(16) const float four_weights[] = {hn::GetLane(four.left_above), hn::GetLane(four.right_above),
                                              hn::GetLane(four.left_below), hn::GetLane(four.right_below)};
    const auto read = [&](std::span<const glm::vec4> plane) HWY_ATTR {
      hn::Vec<Texels> texels[parts];
      read_texels(&plane.data()->x, hn::GetLane(four.upper), hn::GetLane(four.lower), size - 1, texels);
      for (int part = 0; part < parts; ++part) texels[part] = hn::Mul(weights_of(four_weights, part), texels[part]);
      alignas(16) float sum[4];
      hn::Store(add_texels(texels), d4, sum);
      return glm::dvec4(sum[0], sum[1], sum[2], sum[3]);
    };
    const glm::dvec4 shift = read(surface.shift(i)), slope = read(surface.slope(i));
    to.displacement += glm::dvec3(share * shift.x, shift.y, share * shift.z);
    to.height_gradient += glm::dvec2(slope.x, slope.y);
    to.shift_gradient += share * glm::dvec3(slope.z, slope.w, shift.w);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace seascape
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace seascape {

HWY_EXPORT(sample_levels);

void DynamicSurface::add(glm::dvec2 rest, std::span<const double> weights, double share, DynamicSample& to) const {
  HWY_DYNAMIC_DISPATCH(sample_levels)(*this, rest, weights, share, to);
}

DynamicSample DynamicSurface::sea(glm::dvec2 rest, double footprint) const {
  const gpu::LodWindows around = windows(viewer());
  const float distance = gpu::lod_distance(glm::vec2(rest - viewer()));
  std::array<double, gpu::max_lod_slices> weights;
  for (int i = 0; i < levels(); ++i) {
    double& weight = weights[std::size_t(i)];
    weight = gpu::lod_present(around.reach, i, distance) * kept(footprint, texel_m(i));
    if (i == 0) weight *= 1.0 - double(around.reach.z);
  }
  DynamicSample sum;
  add(rest, weights, share(), sum);
  return sum;
}

}  // namespace seascape
#endif
