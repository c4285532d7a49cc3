// What solid things mirror: sky and sea around them, by roughness, and how much of white surroundings a surface sends
// back. For all who draw things under one sky.
#pragma once
#include "engine/frame.h"
#include "engine/pipeline.h"
#include "ocean/surface/surface.h"

namespace seascape {

class SolidSurroundings {
 public:
  SolidSurroundings(Device& device, ShaderLibrary& shaders, const SurfaceLight& light);
  // Outside of passes: made anew where sky or water have changed.
  void update(Frame& frame, const Image& sky_map, const glm::vec4& water_reflectance, bool sky_is_new);
  void add_uses(Uses& uses) const;
  const Image& sky() const { return sky_; }
  const Image& albedo() const { return albedo_; }
  VkSampler sampler() const { return sampler_.get(); }

 private:
  const Buffer* light_;
  Image sky_, albedo_;
  Owned<VkSampler> sampler_;
  Pipeline sky_pipeline_, albedo_pipeline_;
  Bindings sky_bindings_, albedo_bindings_;
  bool lit_ = false;
  glm::vec4 lit_by_{0.0f};
};

}  // namespace seascape
