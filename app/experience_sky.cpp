// The sky of an experience, and what eyes in the water see in its stead.
#include "app/experience.h"

namespace seascape {

// Where the sea is lit later the sky is lit with it.
void Experience::make_sky(const RenderTarget& drawn, const SurfaceLook& look) {
  sky_pipeline_ = {};
  sky_over_water_ = {};
  sky_underwater_ = {};
  sky_over_water_bindings_ = {};
  sky_underwater_bindings_ = {};
  if (look.deferred) return;
  GraphicsSpec spec;
  spec.vertex = "sky.vert";
  spec.fragment = "sky.frag";
  spec.values = {{gpu::value_multiview, !options_.per_eye},
                 {gpu::value_tile_shape, look.tile_shape},
                 {gpu::value_debug, look.debug}};
  spec.depth_write = false;
  spec.depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  const auto make = [&](std::string_view effect, Pipeline& pipeline, Bindings& bindings) {
    const EffectScope scope(device_, effect);
    pipeline = make_graphics_pipeline(device_, shaders_, drawn, spec);
    bindings = Bindings(device_, pipeline,
                        {{.binding = gpu::slot_frame, .buffer = &frame_->ring(), .range = sizeof(gpu::FrameData)},
                         {.binding = gpu::slot_sky_map, .view = sky_->map().view(), .sampler = sky_->sampler()},
                         {.binding = gpu::slot_sky_light, .buffer = &sky_->light()}},
                        effect);
  };
  make("sky", sky_pipeline_, sky_bindings_);
  if (!look.underwater) return;
  spec.stencil = Stencil::in_air;
  make("underwater", sky_over_water_, sky_over_water_bindings_);
  spec.stencil = Stencil::in_water;
  spec.values.push_back({gpu::value_underwater, 1});
  spec.values.push_back({gpu::value_lamp, 1});
  look.shapes.add_to(spec.values);
  make("underwater", sky_underwater_, sky_underwater_bindings_);
}

void Experience::draw_sky(Commands& commands, std::uint32_t frame_uniform, EyesIn eyes) const {
  const auto whole = [&](const Pipeline& pipeline, const Bindings& bindings) {
    commands.bind(pipeline, bindings, {frame_uniform, 0u});
    commands.push(gpu::DrawPush{commands.eye()});
    commands.draw(3);
  };
  if (eyes == EyesIn::air || !sky_underwater_) return whole(sky_pipeline_, sky_bindings_);
  if (eyes == EyesIn::either) whole(sky_over_water_, sky_over_water_bindings_);
  whole(sky_underwater_, sky_underwater_bindings_);
}

}  // namespace seascape
