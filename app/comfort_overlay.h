// What comfort draws over the finished picture, for all eyes in one draw: a vignette and a line at the horizon.
#pragma once
#include "app/comfort.h"
#include "engine/frame.h"

namespace seascape {

class ComfortOverlay {
 public:
  // `frame_ring` holds each frame's FrameData and what update() uploads.
  ComfortOverlay(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const Buffer& frame_ring);

  // What these eyes are shown in this frame. A vignette that begins outside all of their pictures is none.
  void update(Frame& frame, const Viewpoint& viewpoint, const ComfortShown& shown);
  // Last in the pass that finishes the picture; records nothing where there is nothing to show,
  // and returns false.
  bool draw(Commands& commands, std::uint32_t frame_uniform) const;

 private:
  Pipeline pipeline_;
  Bindings bindings_;
  bool shows_ = false;
  std::uint32_t uniform_ = 0;  // of ComfortData, in the ring
};

}  // namespace seascape
