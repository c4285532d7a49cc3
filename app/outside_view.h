// A second look at the sea that is drawn, from another place: its own patches, pipelines and picture, and the waves,
// foam and windows that the experience has already made.
#pragma once
#include "app/experience.h"
#include "ocean/mesh/quadtree.h"

namespace seascape {

class OutsideView {
 public:
  // Reads nothing of the experience that its frames write, so that it may be made on another thread meanwhile; but the
  // experience must not be built anew until then, nor afterwards while this is there (Experience::before_build), and it
  // has options().seen_elsewhere. `frame`: what draw() will be given. Throws Error.
  OutsideView(Device& device, ShaderLibrary& shaders, Experience& experience, const Frame& frame, VkExtent2D size);

  // Draws the sea as it was in the experience's last frame, which has been submitted, in the quality `low` but for the
  // waves, which are those of that frame. Without spray, and without what of things is under water. Foam, windows and
  // shadows of things lie around the experience's own viewer.
  void draw(Frame& frame, Experience& experience, const Viewpoint& viewpoint);
  // What it drew has left the GPU: the sea may have back what was held for it.
  void release() { held_ = {}; }
  const RenderTarget& picture() const { return picture_; }

 private:
  LodSettings lod_;
  Quadtree mesher_;
  RenderTarget picture_;
  bool deferred_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<DrawnSolids> solids_;  // where the experience draws any
  Pipeline sky_pipeline_;                // where the sky is not lit with the sea
  Bindings sky_bindings_;
  SeaView held_;
};

}  // namespace seascape
