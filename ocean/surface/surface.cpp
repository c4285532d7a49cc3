#include "ocean/surface/surface.h"

#include <bit>

#include "ocean/lod/patch_mesh.h"
#include "shaders/shared/frame_data.h"

namespace seascape {

namespace {
// Where a tile source's layings are counted and its three images bound (shaders/lib/sea.glsl).
struct SourceSlot {
  std::string_view name;
  std::uint32_t constant, binding;
};
constexpr SourceSlot slots[] = {{"wave_particles", 8, 12}};
}  // namespace

Surface::Surface(Device& device, ShaderLibrary& shaders, const RenderTarget& target, const WaveImages& waves,
                 std::span<const std::unique_ptr<DrawnSource>> sources, const Buffer& frame_ring, const SurfaceLight& light, const SurfaceLook& look) {
  const EffectScope scope(device, "surface");
  const auto indices = patch_indices(gpu::patch_quads);
  index_count_ = std::uint32_t(indices.size());
  indices_ = make_filled_buffer(device, "patch indices", indices.data(), indices.size() * 2, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  GraphicsSpec spec;
  spec.vertex = "surface.vert";
  spec.fragment = "surface.frag";
  spec.values = {{0, !target.spec().per_eye}, {1, look.probe},  {2, look.tile_shape},
                 {3, look.foam},                          {4, look.debug}, {5, std::bit_cast<std::uint32_t>(look.anisotropy)},
                 {7, std::uint32_t(waves.cascades())}};
  for (const SourceSlot& slot : slots) spec.values.push_back({slot.constant, 0});
  for (const auto& source : sources)
    for (std::size_t i = 0; i < std::size(slots); ++i)
      if (slots[i].name == source->source().name())
        spec.values[spec.values.size() - std::size(slots) + i].value = std::uint32_t(source->source().layings().size());
  spec.buffers = {{0, sizeof(gpu::PatchInstance), VK_VERTEX_INPUT_RATE_INSTANCE}};
  spec.attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SINT, 0}};
  spec.wireframe = look.wireframe && device.facts().wireframe;
  pipeline_ = make_graphics_pipeline(device, shaders, target, spec);
  std::vector<Bound> entries = {
      {.binding = 0, .buffer = &frame_ring, .range = sizeof(gpu::FrameData)},
      {.binding = 4, .view = light.sky_map, .sampler = light.sky_sampler},
      {.binding = 5, .buffer = light.sky_light},
  };
  for (const WaveImages::Set& set : waves.sets()) {
    const std::uint32_t first = set.first == 0 ? 1 : 9;  // shaders/lib/sea.glsl
    entries.push_back({.binding = first, .view = set.displacement.view(), .sampler = waves.vertex_sampler()});
    entries.push_back({.binding = first + 1, .view = set.derivatives.view(), .sampler = waves.pixel_sampler()});
    entries.push_back({.binding = first + 2, .view = set.moments.view(), .sampler = waves.pixel_sampler()});
  }
  for (const auto& source : sources)
    for (const SourceSlot& slot : slots) {
      if (slot.name != source->source().name()) continue;
      entries.push_back({.binding = slot.binding, .view = source->displacement().view(), .sampler = waves.vertex_sampler()});
      entries.push_back({.binding = slot.binding + 1, .view = source->derivatives().view(), .sampler = waves.pixel_sampler()});
      entries.push_back({.binding = slot.binding + 2, .view = source->moments().view(), .sampler = waves.pixel_sampler()});
    }
  if (look.probe) {
    constexpr auto vertices = VkDeviceSize(gpu::patch_quads + 1) * VkDeviceSize(gpu::patch_quads + 1);
    probe_ = Buffer(device, "probe", probe_patches * vertices * 32, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    entries.push_back({.binding = 8, .buffer = &probe_});
  }
  bindings_ = Bindings(device, pipeline_, entries, "surface");
}

void Surface::draw(Commands& commands, Frame& frame, const SurfaceSelection& selection, std::uint32_t frame_uniform) const {
  if (selection.patches.empty()) return;
  const Upload instances =
      frame.upload(selection.patches.data(), std::uint32_t(selection.patches.size() * sizeof(gpu::PatchInstance)), 16);
  commands.bind(pipeline_, bindings_, {frame_uniform, 0u});
  commands.push(gpu::DrawPush{commands.eye()});
  commands.bind_vertices(instances);
  commands.bind_indices(indices_, VK_INDEX_TYPE_UINT16);
  commands.draw_indexed(index_count_, std::uint32_t(selection.patches.size()));
}

}  // namespace seascape
