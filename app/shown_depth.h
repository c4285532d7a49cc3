// The depth that is shown with a picture, where the pass that made it keeps its own to itself.
#pragma once
#include "engine/frame.h"

namespace seascape {

class ShownDepth {
 public:
  // `drawn`: the depth of a pass, a layer a view, one sample, of a picture like `picture`. `lent`: whose depths it is
  // copied into; null: an image of its own.
  ShownDepth(Device& device, ShaderLibrary& shaders, const Image& drawn, const TargetSpec& picture,
             const LentImages* lent);

  // Other images of the same formats; the pipeline stays.
  void resize(const Image& drawn, const TargetSpec& picture, const LentImages* lent);
  // See RenderTarget.
  void set_area(std::uint32_t width, std::uint32_t height) { target_.set_area(width, height); }
  void choose(std::size_t depth) { target_.choose(0, depth); }

  // A pass that copies what was drawn, once it is.
  void draw(Frame& frame) const;
  // Where it is then, in the layout of Access::depth_target.
  const Image* depth() const { return target_.shown_depth(); }

 private:
  void bind();
  Device& device_;
  const Image* drawn_ = nullptr;
  RenderTarget target_;
  Owned<VkSampler> sampler_;
  Pipeline pipeline_;
  Bindings bindings_;
};

}  // namespace seascape
