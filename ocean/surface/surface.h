// Draws the sea's surface: one index buffer, one instanced draw for all patches and eyes.
#pragma once
#include "engine/frame.h"
#include "ocean/drawn/drawn_dynamic_waves.h"
#include "ocean/drawn/drawn_foam.h"
#include "ocean/drawn/drawn_place.h"
#include "ocean/drawn/drawn_source.h"
#include "ocean/drawn/wave_images.h"
#include "ocean/mesh/quadtree.h"

namespace seascape {

// What the surface's shaders are built for.
struct SurfaceLook {
  bool tile_shape = false;  // tone mapping in the fragment shader
  bool foam = false;
  bool debug = false;  // debug views are possible
  bool wireframe = false;
  bool probe = false;     // write vertex positions (tests)
  bool deferred = false;  // its pixels are lit after it is drawn, once each, and the sky with them
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
  // `picture`: what the finished pixels go into. `dynamic_waves`, `place`, `foam`: null where there are none.
  Surface(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const WaveImages& waves,
          std::span<const std::unique_ptr<DrawnSource>> sources, const DrawnDynamicWaves* dynamic_waves,
          const DrawnPlace* place, const DrawnFoam* foam, const Buffer& frame_ring, const SurfaceLight& light,
          const SurfaceLook& look);

  // Other pictures of the same formats, after a change of size.
  void resize(const RenderTarget& picture);

  // Where draw() draws: the picture, or with look.deferred what light() will light.
  const RenderTarget& target(const RenderTarget& picture) const { return look_.deferred ? points_ : picture; }
  // Inside a draw pass into target(). `frame_uniform`: ring offset of FrameData.
  // `from_air`: all eyes are above the water (Ocean::eyes_in_air); what faces away from them is then hidden by what
  // faces them.
  void draw(Commands& commands, Frame& frame, const SurfaceSelection& selection, std::uint32_t frame_uniform,
            bool from_air) const;
  // With look.deferred: lights sea and sky inside a draw pass into the picture, which also uses add_points().
  void light(Commands& commands, std::uint32_t frame_uniform) const;
  void add_points(Uses& uses) const;

  // With look.deferred: how near what draw() drew is, a layer an eye; else null.
  const Image* depths() const { return look_.deferred ? points_.depth() : nullptr; }

  const Pipeline& pipeline() const { return pipeline_; }
  // What its pixels are lit by.
  const Pipeline& lighting() const { return look_.deferred ? light_pipeline_ : pipeline_; }
  // Effects that are code in its shaders: what they are where the effect's constant is 0 lacks it.
  struct EffectCode {
    const char* effect;
    std::uint32_t constant;
  };
  static constexpr EffectCode effect_code[] = {
      {"waves", 7},          {"foam", 3},           {"baked", 12}, {"gerstner", 11},  {"gerstner", 28},
      {"wave_particles", 8}, {"dynamic_waves", 13}, {"level", 14}, {"sea_depth", 15}, {"flow", 16},
      {"clip", 17},          {"albedo", 18},        {"shadow", 19}};

  // With look.probe: two vec4 a vertex, patch after patch (see surface.vert).
  const Buffer& probed() const { return probe_; }
  static constexpr std::uint32_t probe_patches = 98304;  // ultra, masked, in a storm: 73,600

 private:
  void bind_light();
  std::vector<Bound> entries(std::size_t copy) const;
  Device& device_;
  const WaveImages& waves_;
  SurfaceLook look_;
  Buffer indices_, probe_;
  std::uint32_t index_count_ = 0;
  std::vector<Bound> entries_;  // without the waves
  RenderTarget points_;
  Pipeline pipeline_, light_pipeline_;
  Owned<VkSampler> points_sampler_;
  std::vector<Bindings> bindings_, light_bindings_;  // one for each copy of the waves' images
};

}  // namespace seascape
