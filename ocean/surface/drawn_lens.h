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

  // Before the frame's passes: what there is in it. `meniscus`: along the surface's near lines, where there are any.
  void update(Frame& frame, bool meniscus, std::span<const gpu::LensDrop> drops);
  // Inside a draw pass into the picture; with look.deferred of the surface one that also uses add_points(). Records
  // nothing where there is nothing.
  void draw(Commands& commands, std::uint32_t frame_uniform) const;
  // Patches that a line is looked for in, and drops that are drawn.
  std::size_t patches() const { return meniscus_there_ ? surface_.near_lines().patches() : 0; }
  std::size_t drops() const { return drop_count_; }

 private:
  struct Drawing {
    Pipeline pipeline;
    std::vector<Bindings> bindings;  // of each copy of the pieces' images
  };
  void bind();
  void begin(Commands& commands, std::uint32_t frame_uniform, const Drawing& drawing) const;
  Device& device_;
  const Surface& surface_;
  Drawing meniscus_, drops_;
  bool meniscus_there_ = false;
  VertexList drop_list_{};
  std::size_t drop_count_ = 0;
};

}  // namespace seascape
