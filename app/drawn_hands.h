// Hands, and where they aim, as they are drawn: limb by limb, for all eyes in one draw.
#pragma once
#include <array>

#include "app/aim_shape.h"
#include "app/hand_shape.h"
#include "engine/frame.h"
#include "ocean/surface/surface.h"

namespace seascape {

// A hand in the world, and how far it is closed.
struct ShownHand {
  Pose pose;
  bool right = false;
  double closed = 0.0;
};

class DrawnHands {
 public:
  // `depths`: of the surface, where it was drawn before in a pass of its own; null: the picture has a depth.
  DrawnHands(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light,
             bool tile_shape, const Image* depths);
  // Other depths, after a change of size.
  void resize(const Image* depths);

  // What this frame shows of them.
  void update(Frame& frame, std::span<const ShownHand> hands, const std::optional<ShownAim>& aim,
              const glm::dvec3& viewer_m);
  // Inside the pass that draws or lights the sea; records nothing without a hand or an aim.
  void draw(Commands& commands, std::uint32_t frame_uniform) const;

 private:
  void bind();
  Device& device_;
  const Image* depths_;
  std::vector<Bound> entries_;  // without the depths
  Pipeline pipeline_;
  Owned<VkSampler> sampler_;
  Bindings bindings_;
  std::vector<Limb> limbs_;
  VertexList list_{};
};

}  // namespace seascape
