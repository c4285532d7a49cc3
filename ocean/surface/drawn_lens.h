// Water on the eyes' lenses as it is drawn: the edge of the sea that stands against them, and drops.
#pragma once
#include <array>
#include <span>

#include "engine/frame.h"
#include "ocean/mesh/surface_selection.h"
#include "ocean/surface/surface.h"
#include "shaders/shared/lens_drop.h"

namespace seascape {

// Drawn last, over all that lies behind the lenses, in the pass that lights it, and only into what sees it through air:
// the sides of pixels stay as the surface's stencil has them.
class DrawnLens {
 public:
  // `surface`: that of the picture, with SurfaceLook::underwater; it outlives this.
  DrawnLens(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const Surface& surface,
            bool tile_shape);
  // After the surface's resize().
  void resize() { bind(); }

  // Before the frame's passes: what there is in it. `near`: the patches along whose line a meniscus stands.
  void update(Frame& frame, const NearPatches& near, std::span<const gpu::LensDrop> drops);
  // Inside a draw pass into the picture; with look.deferred of the surface one that also uses add_points(). Records
  // nothing where there is nothing.
  void draw(Commands& commands, std::uint32_t frame_uniform) const;
  // Patches and drops that are drawn.
  std::size_t patches() const { return patches_.count; }
  std::size_t drops() const { return drops_.count; }

 private:
  struct Drawing {
    Pipeline pipeline;
    std::vector<Bindings> bindings;  // of each copy of the pieces' images
    VertexList list{};
    std::size_t count = 0;
  };
  void bind();
  void draw(Commands& commands, std::uint32_t frame_uniform, const Drawing& drawing, std::uint32_t vertices) const;
  Device& device_;
  const Surface& surface_;
  Drawing patches_, drops_;
};

}  // namespace seascape
