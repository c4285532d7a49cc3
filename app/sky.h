// The sky over the sea: a map of its radiance, the light it gives, made anew only when sun or haze change.
#pragma once
#include <glm/glm.hpp>

#include "app/sky_settings.h"
#include "engine/frame.h"

namespace seascape {

// Unit vector towards the sun, world axes.
glm::dvec3 sun_direction(const SkySettings& settings);

class Sky {
 public:
  Sky(Device& device, ShaderLibrary& shaders);
  // Recomputes the map when the settings differ from the last call's; returns whether they do.
  bool update(Frame& frame, const SkySettings& settings);
  const Image& map() const { return map_; }
  VkSampler sampler() const { return sampler_.get(); }
  const Buffer& light() const { return light_; }

 private:
  Image map_;
  Owned<VkSampler> sampler_;
  Buffer multiple_, light_;
  Pipeline multiple_pipeline_, map_pipeline_, light_pipeline_;
  Bindings multiple_bindings_, map_bindings_, light_bindings_;
  bool made_ = false;
  SkySettings made_for_;
};

}  // namespace seascape
