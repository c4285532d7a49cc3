// Draws the sea's surface: one index buffer, one instanced draw for all patches and eyes.
#pragma once
#include "engine/frame.h"
#include "ocean/lod/quadtree.h"
#include "ocean/waves/drawn_source.h"
#include "ocean/waves/wave_images.h"

namespace seascape {

// What the surface's shaders are built for.
struct SurfaceLook {
  bool tile_shape = false;  // tone mapping in the fragment shader
  bool foam = false;
  bool debug = false;       // debug views are possible
  bool wireframe = false;
  bool probe = false;       // write vertex positions (tests)
  float anisotropy = 1.0f;
};

// What the surface is lit by.
struct SurfaceLight {
  VkImageView sky_map;
  VkSampler sky_sampler;
  const Buffer* sky_light;
};

class Surface {
 public:
  Surface(Device& device, ShaderLibrary& shaders, const RenderTarget& target, const WaveImages& waves,
          std::span<const std::unique_ptr<DrawnSource>> sources, const Buffer& frame_ring, const SurfaceLight& light, const SurfaceLook& look);

  // Inside a draw pass into the target it was made for. `frame_uniform`: ring offset of FrameData.
  void draw(Commands& commands, Frame& frame, const SurfaceSelection& selection, std::uint32_t frame_uniform) const;

  const Pipeline& pipeline() const { return pipeline_; }
  // Effects that are code in its shaders: what they are where the effect's constant is 0 lacks it.
  struct EffectCode {
    const char* effect;
    std::uint32_t constant;
  };
  static constexpr EffectCode effect_code[] = {{"foam", 3}, {"wave_particles", 8}};

  // With look.probe: two vec4 a vertex, patch after patch (see surface.vert).
  const Buffer& probed() const { return probe_; }
  static constexpr std::uint32_t probe_patches = 2048;

 private:
  Buffer indices_, probe_;
  std::uint32_t index_count_ = 0;
  Pipeline pipeline_;
  Bindings bindings_;
};

}  // namespace seascape
