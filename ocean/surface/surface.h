// Draws the sea's surface: one index buffer, one instanced draw for all patches and eyes.
#pragma once
#include <optional>
#include <span>

#include "engine/frame.h"
#include "ocean/drawn/drawn_piece.h"
#include "ocean/mesh/surface_selection.h"
#include "ocean/surface/eyes_in.h"
#include "ocean/surface/near_lines.h"

namespace seascape {

// How many shapes shaders are built for.
struct ShapesInWater {
  int air = 0, portals = 0;
  bool any() const { return air + portals > 0; }
  void add_to(std::vector<SpecValue>& values) const;
};

// What the surface's shaders are built for.
struct SurfaceLook {
  bool tile_shape = false;  // tone mapping in the fragment shader
  bool foam = false;
  bool debug = false;  // debug views are possible
  bool wireframe = false;
  bool probe = false;       // write vertex positions (tests)
  bool hidden = false;      // some pixels may be hidden: what draws them does so before, as near as can be
  bool solids = false;      // solid things are drawn among its points, where it is deferred
  bool below = false;       // things are seen through it: those under water, with underwater also those above it
  bool underwater = false;  // eyes may be in the water: the picture has a stencil then (TargetSpec::stencil)
  ShapesInWater shapes;     // of the frame's (gpu::WaterShapes): only with underwater
  bool deferred = false;    // its pixels are lit after it is drawn, once each, and the sky with them
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
  // With look.underwater: where it passes near planes, which draw() draws where any were chosen, and others may.
  NearLines& near_lines() { return *near_lines_; }
  const NearLines& near_lines() const { return *near_lines_; }
  // Where there is a bed, before eyes that may be in the water: `selection` is of BedMesh. Inside the pass of draw(),
  // after all that hides it.
  void draw_bed(Commands& commands, Frame& frame, const SurfaceSelection& selection, std::uint32_t frame_uniform) const;
  // Before the passes of draw() and light(), whose `uses` it adds to: finds the lines, where any were chosen, in passes
  // of their own.
  void prepare(Frame& frame, std::uint32_t frame_uniform, Uses& uses);
  // Inside a draw pass into target(). `frame_uniform`: ring offset of FrameData. `eyes`: see Ocean::eyes_in; other than
  // air only with look.underwater. `facing_only`: from the air, what faces away from the eyes is not drawn, which what
  // faces them hides.
  void draw(Commands& commands, Frame& frame, const SurfaceSelection& selection, std::uint32_t frame_uniform,
            EyesIn eyes, bool facing_only) const;
  // With look.deferred: lights sea and sky inside a draw pass into the picture, which also uses add_points().
  void light(Commands& commands, std::uint32_t frame_uniform, EyesIn eyes) const;
  void add_points(Uses& uses) const;
  // With look.below: what things under water are drawn into, for draw() or light(), which use it by prepare().
  const RenderTarget& below() const { return below_; }
  // With look.underwater too: what things above it are drawn into (shaders/shared/solids_above.h), for eyes in the
  // water.
  const RenderTarget& above() const { return above_; }

  // For what else draws with the sea's shaders into the picture, with look.underwater: the constants of the surface for
  // eyes in the water; and its bindings, of each copy of the pieces' images, with the points' sides where it is
  // deferred. shown(): which copy the frame draws.
  const std::vector<SpecValue>& values_in_water() const { return values_in_water_; }
  std::vector<std::vector<Bound>> bound_with_sides() const;
  std::size_t shown() const { return copied_ != nullptr ? copied_->shown() : 0; }

  // With look.deferred: how near what draw() drew is, a layer an eye; else null.
  const Image* depths() const { return look_.deferred ? points_.depth() : nullptr; }
  // With look.deferred and look.underwater: whether a pixel's line of sight begins in the air (side_in_air).
  VkImageView sides() const { return look_.deferred && look_.underwater ? points_.stencil_view() : VK_NULL_HANDLE; }

  const Pipeline& pipeline() const { return in_air_.pipeline; }
  // What its pixels are lit by.
  const Pipeline& lighting() const { return look_.deferred ? in_air_.light : in_air_.pipeline; }
  // The specialisation constants of effects that are code in its shaders.
  const std::vector<SurfaceSlots::EffectValue>& effect_values() const { return effect_values_; }

  // With look.probe: two vec4 a vertex, patch after patch (see surface.vert).
  const Buffer& probed() const { return probe_; }
  static constexpr std::uint32_t probe_patches = 98304;  // ultra, masked, in a storm: 73,600

 private:
  void add_below(Uses& uses) const;
  // What draws it for eyes in the air, and with look.underwater for others. Bindings: one of each copy.
  struct Drawing {
    Pipeline pipeline, light;
    std::vector<Bindings> bindings, light_bindings;
  };
  std::vector<Bound> with_below(const std::vector<Bound>& entries) const;
  void make_underwater(ShaderLibrary& shaders, const RenderTarget& picture, GraphicsSpec spec);
  void make_light(ShaderLibrary& shaders, const RenderTarget& picture, Drawing& drawing, std::vector<SpecValue> values);
  // With the pipeline that is bound.
  void draw_patches(Commands& commands, Frame& frame, std::span<const gpu::PatchInstance> patches) const;
  void bind();
  void bind_light(Drawing& drawing);
  void add_sides(std::vector<Bound>& entries) const;
  const Drawing& drawing(EyesIn eyes) const { return eyes == EyesIn::air || !look_.underwater ? in_air_ : in_water_; }
  Device& device_;
  const DrawnPiece* copied_ = nullptr;  // whose images are there several times; null: nobody's
  SurfaceLook look_;
  std::vector<SurfaceSlots::EffectValue> effect_values_;
  std::vector<SpecValue> values_in_water_;
  Buffer indices_, probe_;
  std::uint32_t index_count_ = 0;
  std::vector<std::vector<Bound>> entries_;  // of each copy of the pieces' images
  RenderTarget points_, below_, above_;
  Drawing in_air_, in_water_;
  // With look.underwater; the bed where there is one.
  Pipeline side_pipeline_, near_side_pipeline_, bed_pipeline_;
  Bindings side_bindings_, near_side_bindings_;
  std::vector<Bindings> bed_bindings_;
  std::optional<NearLines> near_lines_;
  Owned<VkSampler> points_sampler_;
};

}  // namespace seascape
