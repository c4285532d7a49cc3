#include "ocean/surface/drawn_spray.h"

#include "shaders/shared/frame_data.h"

namespace seascape {

DrawnSpray::DrawnSpray(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const SurfaceLight& light,
                       int most, const SprayLook& look)
    : device_(device), look_(look), most_(std::size_t(most)) {
  const EffectScope scope(device, "spray");
  for (Buffer& puffs : puffs_)
    puffs = Buffer(device, "spray, puffs", most_ * sizeof(gpu::SprayPuff), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                   HostAccess::write);
  GraphicsSpec spec;
  spec.vertex = "spray.vert";
  spec.fragment = "spray.frag";
  spec.values = {{gpu::value_multiview, !picture.spec().per_eye},
                 {gpu::value_tile_shape, look.tile_shape},
                 {gpu::value_depth_sampled, look.depths != nullptr}};
  spec.buffers = {{0, sizeof(gpu::SprayPuff), VK_VERTEX_INPUT_RATE_INSTANCE}};
  spec.attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::SprayPuff, place)},
                     {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::SprayPuff, streak)},
                     {2, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(gpu::SprayPuff, look)}};
  spec.depth_write = false;
  spec.blend = true;
  pipeline_ = make_graphics_pipeline(device, shaders, picture, spec);
  entries_ = {{.binding = gpu::slot_frame, .buffer = light.frame_ring, .range = sizeof(gpu::FrameData)},
              {.binding = gpu::slot_sky_map, .view = light.sky_map, .sampler = light.sky_sampler},
              {.binding = gpu::slot_sky_light, .buffer = light.sky_light}};
  if (look.depths != nullptr) sampler_ = make_sampler(device, "spray", {false, false, 1.0f});
  bind();
}

void DrawnSpray::bind() {
  std::vector<Bound> entries = entries_;
  if (look_.depths != nullptr)
    entries.push_back({.binding = gpu::slot_sea_depths, .view = look_.depths->view(), .sampler = sampler_.get()});
  bindings_ = Bindings(device_, pipeline_, entries, "spray");
}

void DrawnSpray::resize(const Image* depths) {
  if (look_.depths == nullptr) return;
  const EffectScope scope(device_, "spray");
  look_.depths = depths;
  bind();
}

void DrawnSpray::update(Frame& frame, Spray& spray, double time_s, const glm::dvec3& viewer, double share) {
  slot_ = frame.slot();
  count_ =
      spray.puffs().empty()
          ? 0
          : spray.drawn(time_s, viewer, std::span(puffs_[std::size_t(slot_)].mapped<gpu::SprayPuff>(), most_), share);
}

void DrawnSpray::draw(Commands& commands, std::uint32_t frame_uniform) const {
  if (count_ == 0) return;
  commands.bind(pipeline_, bindings_, {frame_uniform, 0u});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.bind_vertices({&puffs_[std::size_t(slot_)], 0});
  commands.draw(6, std::uint32_t(count_));
}

}  // namespace seascape
