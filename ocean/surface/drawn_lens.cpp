#include "ocean/surface/drawn_lens.h"

#include <algorithm>
#include <cstddef>

namespace seascape {

DrawnLens::DrawnLens(Device& device, ShaderLibrary& shaders, const RenderTarget& picture, const Surface& surface,
                     bool tile_shape)
    : device_(device), surface_(surface) {
  const EffectScope scope(device, "underwater");
  GraphicsSpec spec;
  spec.values = surface.values_in_water();
  spec.values.push_back({std::uint32_t(gpu::value_tile_shape), tile_shape});
  spec.values.push_back({std::uint32_t(gpu::value_depth_sampled), surface.depths() != nullptr});
  spec.depth_write = false;
  spec.blend = true;
  if (surface.depths() == nullptr) spec.stencil = Stencil::in_air;
  spec.vertex = "meniscus.vert";
  spec.fragment = "meniscus.frag";
  NearLines::lay_out(spec);
  meniscus_.pipeline = make_graphics_pipeline(device, shaders, picture, spec);
  spec.vertex = "lens_drop.vert";
  spec.fragment = "lens_drop.frag";
  spec.buffers = {{0, sizeof(gpu::LensDrop), VK_VERTEX_INPUT_RATE_INSTANCE}};
  spec.attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::LensDrop, place)},
                     {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::LensDrop, shape)}};
  drops_.pipeline = make_graphics_pipeline(device, shaders, picture, spec);
  bind();
}

void DrawnLens::bind() {
  const EffectScope scope(device_, "underwater");
  for (Drawing* drawing : {&meniscus_, &drops_}) {
    drawing->bindings.clear();
    for (const std::vector<Bound>& entries : surface_.bound_with_sides())
      drawing->bindings.emplace_back(device_, drawing->pipeline, entries, "lens");
  }
}

void DrawnLens::update(Frame& frame, bool meniscus, std::span<const gpu::LensDrop> drops) {
  meniscus_there_ = meniscus && surface_.near_lines().any();
  drop_count_ = drops.size();
  if (drop_count_ == 0) return;
  drop_list_ = frame.vertices(drops.size_bytes());
  std::copy(drops.begin(), drops.end(), static_cast<gpu::LensDrop*>(drop_list_.host));
}

void DrawnLens::draw(Commands& commands, std::uint32_t frame_uniform) const {
  if (meniscus_there_) {
    begin(commands, frame_uniform, meniscus_);
    surface_.near_lines().draw(commands);
  }
  if (drop_count_ > 0) {
    begin(commands, frame_uniform, drops_);
    commands.bind_vertices(drop_list_);
    commands.draw(6, std::uint32_t(drop_count_));
  }
}

void DrawnLens::begin(Commands& commands, std::uint32_t frame_uniform, const Drawing& drawing) const {
  commands.bind(drawing.pipeline, drawing.bindings[surface_.shown()], {frame_uniform, 0u});
  commands.push(gpu::DrawPush{commands.eye()});
}

}  // namespace seascape
