// A diver's bubbles as they are drawn: a quad a bubble, towards the viewer, for all eyes in one draw.
#pragma once
#include <array>

#include "engine/frame.h"
#include "ocean/surface/breath.h"
#include "ocean/surface/surface.h"

namespace seascape {

// What its shaders are built for.
struct BubbleLook {
  bool tile_shape = false;        // tone mapping in the shader
  const Image* depths = nullptr;  // of the surface, where it was drawn before in a pass of its own; null: the picture
                                  // has a depth and a stencil
  VkImageView sides = VK_NULL_HANDLE;  // its stencil (Surface::sides()), with depths
};

// They are drawn over sea, sky and things in the pass that lights them, in the pixels whose eye is in the water, hidden
// by what is nearer: the surface hides those that have left the water.
class DrawnBubbles {
 public:
  DrawnBubbles(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light,
               const BubbleLook& look);
  // Other depths, after a change of size.
  void resize(const Image* depths, VkImageView sides);

  // Has the bubbles as a viewer (m) sees them ready for this frame; writes nothing where there are none, or no eye is
  // in the water.
  void update(Frame& frame, const Breath& breath, const glm::dvec3& viewer_m, EyesIn eyes);
  // Inside a draw pass into the picture, which also uses the light and the depths; records nothing where there are
  // none to be seen.
  void draw(Commands& commands, std::uint32_t frame_uniform) const;
  std::size_t count() const { return count_; }

 private:
  void bind();
  Device& device_;
  BubbleLook look_;
  std::array<Buffer, Frame::slots> instances_;
  std::vector<Bound> entries_;  // without the depths
  Pipeline pipeline_;
  Owned<VkSampler> sampler_;
  Bindings bindings_;
  std::size_t count_ = 0;
  int slot_ = 0;
};

}  // namespace seascape
