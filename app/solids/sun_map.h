// The map of the sun: how near it something stands in the way of its light. One for all eyes.
#pragma once
#include "engine/render_target.h"

namespace seascape {

class SunMap {
 public:
  SunMap(Device& device, int texels);
  const RenderTarget& target() const { return target_; }
  VkSampler sampler() const { return sampler_.get(); }  // compares: 1 where light comes

 private:
  RenderTarget target_;
  Owned<VkSampler> sampler_;
};

}  // namespace seascape
