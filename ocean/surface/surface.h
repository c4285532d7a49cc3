// Draws the sea's surface: one index buffer, one instanced draw for all patches and eyes.
#pragma once
#include "engine/frame.h"
#include "ocean/drawn/drawn_piece.h"
#include "ocean/mesh/surface_selection.h"

namespace seascape {

// What the surface's shaders are built for.
struct SurfaceLook {
  bool tile_shape = false;  // tone mapping in the fragment shader
  bool foam = false;
  bool debug = false;  // debug views are possible
  bool wireframe = false;
  bool probe = false;     // write vertex positions (tests)
  bool hidden = false;    // some pixels may be hidden: what draws them does so before, as near as can be
  bool solids = false;    // solid things are drawn among its points, where it is deferred
  bool below = false;     // things under water are seen through it
  bool deferred = false;  // its pixels are lit after it is drawn, once each, and the sky with them
  float anisotropy = 1.0f;
};

// What the surface's shaders are told each frame, and what lights it.
struct SurfaceLight {
  const Buffer* frame_ring;  // of gpu::FrameData
  VkImageView sky_map;
  VkSampler sky_sampler;
  const Buffer* sky_light;
  VkImageView sun_map = VK_NULL_HANDLE;  // how near the sun its light is stopped; null: nowhere
  VkSampler sun_map_sampler = VK_NULL_HANDLE;
};

class Surface {
 public:
  // `picture`: what the finished pixels go into. `pieces`: all that the sea is drawn from; they outlive it.
  Surface(Device& device, ShaderLibrary& shaders, const RenderTarget& picture,
          std::span<const std::unique_ptr<DrawnPiece>> pieces, const SurfaceLight& light, const SurfaceLook& look);

  // Other pictures of the same formats, after a change of size.
  void resize(const RenderTarget& picture);
  // The picture is drawn in its upper left part only.
  void set_area(std::uint32_t width, std::uint32_t height);

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
  // With look.below: what things under water are drawn into, for draw() or light(), which also use add_below().
  const RenderTarget& below() const { return below_; }
  void add_below(Uses& uses) const;

  // With look.deferred: how near what draw() drew is, a layer an eye; else null.
  const Image* depths() const { return look_.deferred ? points_.depth() : nullptr; }

  const Pipeline& pipeline() const { return pipeline_; }
  // What its pixels are lit by.
  const Pipeline& lighting() const { return look_.deferred ? light_pipeline_ : pipeline_; }
  // The specialisation constants of effects that are code in its shaders.
  const std::vector<SurfaceSlots::EffectValue>& effect_values() const { return effect_values_; }

  // With look.deferred: a pass that copies depths(), where it was drawn, into another image of its format.
  void copy_depth(Frame& frame, const Image& to) const;

  // With look.probe: two vec4 a vertex, patch after patch (see surface.vert).
  const Buffer& probed() const { return probe_; }
  static constexpr std::uint32_t probe_patches = 98304;  // ultra, masked, in a storm: 73,600

 private:
  std::vector<Bound> with_below(const std::vector<Bound>& entries) const;
  void bind();
  void bind_light();
  Device& device_;
  const DrawnPiece* copied_ = nullptr;  // whose images are there several times; null: nobody's
  std::size_t shown() const { return copied_ != nullptr ? copied_->shown() : 0; }
  SurfaceLook look_;
  std::vector<SurfaceSlots::EffectValue> effect_values_;
  Buffer indices_, probe_;
  std::uint32_t index_count_ = 0;
  std::vector<std::vector<Bound>> entries_;  // of each copy of the pieces' images
  RenderTarget points_, below_;
  Pipeline pipeline_, light_pipeline_;
  Owned<VkSampler> points_sampler_, below_sampler_;
  std::vector<Bindings> bindings_, light_bindings_;  // of each copy
};

}  // namespace seascape
