#include "ocean/surface/drawn_bubbles.h"

#include "shaders/shared/frame_data.h"

namespace seascape {

DrawnBubbles::DrawnBubbles(Device& device, ShaderLibrary& shaders, const RenderTarget& picture,
                           const SurfaceLight& light, const BubbleLook& look)
    : device_(device), look_(look) {
  const EffectScope scope(device, "underwater");
  for (Buffer& instances : instances_)
    instances = Buffer(device, "bubbles", Breath::most * sizeof(gpu::BubbleInstance), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                       HostAccess::write);
  GraphicsSpec spec;
  spec.vertex = "bubble.vert";
  spec.fragment = "bubble.frag";
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye},
                 {gpu::value_tile_shape, look.tile_shape},
                 {gpu::value_underwater, 1},
                 {gpu::value_lamp, 1},
                 {gpu::value_depth_sampled, look.depths != nullptr}};
  spec.buffers = {{0, sizeof(gpu::BubbleInstance), VK_VERTEX_INPUT_RATE_INSTANCE}};
  spec.attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::BubbleInstance, place)},
                     {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::BubbleInstance, shape)}};
  spec.depth_write = false;
  spec.blend = true;
  if (look.depths == nullptr) spec.stencil = Stencil::in_water;
  pipeline_ = make_graphics_pipeline(device, shaders, picture, spec);
  entries_ = {{.binding = gpu::slot_frame, .buffer = light.frame_ring, .range = sizeof(gpu::FrameData)},
              {.binding = gpu::slot_sky_map, .view = light.sky_map, .sampler = light.sky_sampler},
              {.binding = gpu::slot_sky_light, .buffer = light.sky_light}};
  if (look.depths != nullptr) sampler_ = make_sampler(device, "bubbles", {false, false, 1.0f});
  bind();
}

void DrawnBubbles::bind() {
  std::vector<Bound> entries = entries_;
  if (look_.depths != nullptr) {
    entries.push_back({.binding = gpu::slot_sea_depths, .view = look_.depths->view(), .sampler = sampler_.get()});
    entries.push_back({.binding = gpu::slot_point_sides, .view = look_.sides, .sampler = sampler_.get()});
  }
  bindings_ = Bindings(device_, pipeline_, entries, "bubbles");
}

void DrawnBubbles::resize(const Image* depths, VkImageView sides) {
  if (look_.depths == nullptr) return;
  const EffectScope scope(device_, "underwater");
  look_.depths = depths;
  look_.sides = sides;
  bind();
}

void DrawnBubbles::update(Frame& frame, const Breath& breath, const glm::dvec3& viewer_m, EyesIn eyes) {
  slot_ = frame.slot();
  count_ = eyes == EyesIn::air || breath.bubbles().empty()
               ? 0
               : breath.drawn(viewer_m,
                              std::span(instances_[std::size_t(slot_)].mapped<gpu::BubbleInstance>(), Breath::most));
}

void DrawnBubbles::draw(Commands& commands, std::uint32_t frame_uniform) const {
  if (count_ == 0) return;
  commands.bind(pipeline_, bindings_, {frame_uniform, 0u});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.bind_vertices({&instances_[std::size_t(slot_)], 0});
  commands.draw(6, std::uint32_t(count_));
}

}  // namespace seascape
