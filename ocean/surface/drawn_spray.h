// Spray as it is drawn: a quad a puff, towards the viewer, for all eyes in one draw.
#pragma once
#include <array>

#include "engine/frame.h"
#include "ocean/foam/spray.h"
#include "ocean/surface/surface.h"

namespace seascape {

// What its shaders are built for.
struct SprayLook {
  bool tile_shape = false;        // tone mapping in the shader
  const Image* depths = nullptr;  // of the surface, where it was drawn before in a pass of its own
                                  // (SurfaceLook::deferred); null: the picture has a depth
};

// It is drawn over sea and sky in the pass that lights them, hidden by what is nearer. Puffs are white all alike, so
// that their order does not count: laying one colour over another of itself gives the same whichever is first, and only
// the haze between them tells near from far. They are drawn in the order in which they were thrown up.
class DrawnSpray {
 public:
  DrawnSpray(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light, int most,
             const SprayLook& look);
  // Other depths, after a change of size.
  void resize(const Image* depths);

  // Has the spray of a time, as a viewer (m) sees it, ready for this frame; writes nothing where there is none.
  // `share`: of it (Spray::drawn).
  void update(Frame& frame, Spray& spray, double time_s, const glm::dvec3& viewer_m, double share = 1.0);
  // Inside a draw pass into the picture, which also uses the light and the depths; records nothing where there is none
  // to be seen.
  void draw(Commands& commands, std::uint32_t frame_uniform) const;
  std::size_t count() const { return count_; }
  const Pipeline& pipeline() const { return pipeline_; }

 private:
  void bind();
  Device& device_;
  SprayLook look_;
  std::array<Buffer, Frame::slots> puffs_;
  std::vector<Bound> entries_;  // without the depths
  Pipeline pipeline_;
  Owned<VkSampler> sampler_;
  Bindings bindings_;
  std::size_t most_, count_ = 0;
  int slot_ = 0;
};

}  // namespace seascape
