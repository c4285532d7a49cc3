#include "ocean/places/clip_mask.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace seascape {

void ClipMask::follow(const PlaceField<glm::vec4>& field, std::uint32_t changed) {
  const LodField<glm::vec4>& texels = field.field();
  side_ = int(texels.side());
  slices_.resize(std::size_t(texels.slices()));
  viewer_m_ = texels.placement().viewer;
  reach_ = texels.windows().reach;
  outside_ = texels.outside().x > 0.5f;
  for (int i = 0; i < texels.slices(); ++i) {
    if ((changed >> i & 1u) == 0) continue;
    Slice& slice = slices_[std::size_t(i)];
    slice.first = texels.first(i);
    slice.texel_m = texels.texel_m(i);
    slice.levels.resize(std::size_t(std::bit_width(unsigned(side_))));
    slice.levels[0].clear();
    texels.each(i, [&](LodIndex w) { slice.levels[0].push_back(texels.texel(i, w).x); });
    for (std::size_t n = 1; n < slice.levels.size(); ++n) {
      const std::vector<float>& fine = slice.levels[n - 1];
      const std::size_t wide = std::size_t(side_) >> (n - 1), half = wide / 2;
      std::vector<float>& coarse = slice.levels[n];
      coarse.resize(half * half);
      for (std::size_t z = 0; z < half; ++z)
        for (std::size_t x = 0; x < half; ++x) {
          const float* at = &fine[2 * z * wide + 2 * x];
          coarse[z * half + x] = std::min(std::min(at[0], at[1]), std::min(at[wide], at[wide + 1]));
        }
    }
  }
}

// Of texels from..to, both within the window.
float ClipMask::least(int slice, LodIndex from, LodIndex to) const {
  const Slice& s = slices_[std::size_t(slice)];
  const LodIndex low = from - s.first, high = to - s.first;
  const auto widest = std::uint64_t(std::max(high.x - low.x, high.y - low.y)) + 1;
  // Blocks as wide as the rectangle: two of them along each axis, three where it is a little wider. The last levels of
  // a window that is no power of two wide have no rest.
  int n = std::bit_width(widest) - 1;
  while (n > 0 && (side_ & ((1 << n) - 1)) != 0) --n;
  const std::int64_t wide = side_ >> n;
  float result = 1.0f;
  for (std::int64_t z = low.y >> n; z <= high.y >> n; ++z)
    for (std::int64_t x = low.x >> n; x <= high.x >> n; ++x)
      result = std::min(result, s.levels[std::size_t(n)][std::size_t(z * wide + x)]);
  return result;
}

bool ClipMask::clipped(glm::dvec2 least_m, glm::dvec2 most_m) const {
  if (slices_.empty() || !(most_m.x > least_m.x && most_m.y > least_m.y)) return false;
  // Places are read from slices by their distance from the viewer (a footprint of 0): those of the nearest to those of
  // the farthest.
  const glm::dvec2 far = glm::max(glm::abs(least_m - viewer_m_), glm::abs(most_m - viewer_m_));
  const glm::dvec2 near = glm::max(glm::max(least_m - viewer_m_, viewer_m_ - most_m), glm::dvec2(0.0));
  const int count = int(slices_.size());
  const gpu::LodRead first_read = gpu::lod_read(reach_, count, float(std::max(near.x, near.y) * 0.9999), 0.0f),
                     last_read = gpu::lod_read(reach_, count, float(std::max(far.x, far.y) * 1.0001), 0.0f);
  if (last_read.present < 1.0f && !outside_) return false;
  constexpr float surely = 0.999f;
  for (int i = first_read.fine; i <= std::min(last_read.fine + 1, count - 1) && first_read.present > 0.0f; ++i) {
    const Slice& s = slices_[std::size_t(i)];
    // Those that a place between texels is read from.
    const glm::dvec2 low = glm::floor(least_m / s.texel_m - 0.5), high = glm::floor(most_m / s.texel_m - 0.5) + 1.0;
    const glm::dvec2 first(s.first), last = first + double(side_ - 1);
    if (high.x < first.x || high.y < first.y || low.x > last.x || low.y > last.y) continue;
    if (least(i, LodIndex(glm::max(low, first)), LodIndex(glm::min(high, last))) < surely) return false;
  }
  return true;
}

}  // namespace seascape
