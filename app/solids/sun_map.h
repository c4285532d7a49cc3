// The map of the sun: how near it something stands in the way of its light. One for all eyes.
#pragma once
#include <algorithm>
#include <cmath>

#include "engine/render_target.h"

namespace seascape {

class SunMap {
 public:
  SunMap(Device& device, int texels);
  const RenderTarget& target() const { return target_; }
  // The next passes draw into so much of its side (above 0, at most 1), and readers ask there alone.
  void draw_share(double share) {
    const auto side = std::uint32_t(std::clamp(std::lround(share * texels_), 1L, long(texels_)));
    target_.set_area(side, side);
  }
  double share() const { return double(target_.spec().width) / texels_; }
  VkSampler sampler() const { return sampler_.get(); }  // compares: 1 where light comes

 private:
  int texels_;
  RenderTarget target_;
  Owned<VkSampler> sampler_;
};

}  // namespace seascape
