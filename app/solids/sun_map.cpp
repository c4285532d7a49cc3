#include "app/solids/sun_map.h"

namespace seascape {

SunMap::SunMap(Device& device, int texels) : texels_(texels) {
  const EffectScope scope(device, "models");
  TargetSpec spec;
  spec.width = spec.height = std::uint32_t(texels);
  spec.per_eye = true;  // the sun has one eye
  spec.colour = VK_FORMAT_UNDEFINED;
  spec.keep_depth = true;
  target_ = RenderTarget(device, "sun map", spec);
  // Not every device filters depths; its edges are then of whole texels.
  SamplerSpec look;
  look.linear = device.facts().depth_linear;
  look.repeat = false;
  look.compare = VK_COMPARE_OP_GREATER_OR_EQUAL;  // reversed: nearer is more
  sampler_ = make_sampler(device, "sun map", look);
}

}  // namespace seascape
