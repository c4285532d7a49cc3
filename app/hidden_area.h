// The parts of the pictures that no eye can see, for both eyes in one draw: nothing is lit there.
#pragma once
#include "engine/frame.h"
#include "engine/view.h"
#include "platform/hidden_mesh.h"

namespace seascape {

class HiddenArea {
 public:
  // `target`: where the surface is drawn (Surface::target), of its points if it is `deferred`. `picture`: the finished
  // one.
  HiddenArea(Device& device, ShaderLibrary& shaders, const RenderTarget& target, const RenderTarget& picture,
             bool deferred);

  // What these eyes cannot see of this frame.
  void update(Frame& frame, const Viewpoint& viewpoint, const HiddenMesh& mesh);
  // First in the pass that draws the surface: black, with a depth of 1, the nearest, before which nothing is drawn that
  // tests depths. It is what a depth that is shown holds there.
  void hide(Commands& commands) const;
  // Black over what was drawn in the finished picture without such a test.
  void cover(Commands& commands) const;

 private:
  void draw(Commands& commands, const Pipeline& pipeline) const;
  Pipeline hiding_, covering_;
  VertexList list_{};
  std::uint32_t count_ = 0;
};

}  // namespace seascape
