#include "app/shown_depth.h"

#include "shaders/shared/frame_data.h"

namespace seascape {

ShownDepth::ShownDepth(Device& device, ShaderLibrary& shaders, const Image& drawn, const TargetSpec& picture,
                       const LentImages* lent)
    : device_(device), sampler_(make_sampler(device, "shown depth", {false, false, 1.0f})) {
  resize(drawn, picture, lent);
  GraphicsSpec spec;
  spec.vertex = "sky.vert";
  spec.fragment = "shown_depth.frag";
  spec.values = {{gpu::value_multiview, !picture.per_eye}, {gpu::value_sky_ray, false}};
  spec.depth_compare = VK_COMPARE_OP_ALWAYS;
  pipeline_ = make_graphics_pipeline(device, shaders, target_, spec);
  bind();
}

void ShownDepth::resize(const Image& drawn, const TargetSpec& picture, const LentImages* lent) {
  drawn_ = &drawn;
  TargetSpec spec;
  spec.width = picture.width;
  spec.height = picture.height;
  spec.views = picture.views;
  spec.per_eye = picture.per_eye;
  spec.colour = VK_FORMAT_UNDEFINED;
  spec.show_depth = true;
  target_ = RenderTarget(device_, "shown depth", spec, lent);
  if (pipeline_) bind();
}

void ShownDepth::bind() {
  bindings_ =
      Bindings(device_, pipeline_,
               {{.binding = gpu::slot_point_depths, .view = drawn_->view(), .sampler = sampler_.get()}}, "shown depth");
}

void ShownDepth::draw(Frame& frame) const {
  frame.draw_pass("depth", target_, Uses{use(*drawn_, Access::fragment_sample)}, [&](Commands& c) {
    c.bind(pipeline_, bindings_, {});
    c.push(gpu::DrawPush{c.eye()});
    c.draw(3);
  });
}

}  // namespace seascape
