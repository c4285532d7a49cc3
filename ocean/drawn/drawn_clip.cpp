#include "ocean/drawn/drawn_clip.h"

#include "ocean/waves/half_floats.h"

namespace seascape {

DrawnClip::DrawnClip(Device& device, std::shared_ptr<const ClipVolumes> volumes) : volumes_(std::move(volumes)) {
  const EffectScope scope(device, "clip");
  const auto buffer = [&](const char* name, const auto& list) {
    return make_filled_buffer(device, name, list.data(), list.size() * sizeof(list[0]),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  };
  nodes_ = buffer("clip, nodes", volumes_->nodes());
  buffer_ = buffer("clip, volumes", volumes_->volumes());
  if (!volumes_->hulls().empty()) fill_hulls(device);
}

void DrawnClip::fill_hulls(Device& device) {
  constexpr auto side = std::uint32_t(gpu::clip_hull_texels);
  const auto layers = std::uint32_t(volumes_->hulls().size());
  ImageSpec spec;
  spec.width = spec.height = side;
  spec.layers = layers;
  spec.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  hulls_ = Image(device, "clip, hulls", spec);
  const std::size_t texels = std::size_t(side) * side;
  const Buffer staging(device, "clip, staging", layers * texels * 8, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                       HostAccess::write);
  std::vector<glm::vec4> whole(texels);
  for (std::uint32_t layer = 0; layer < layers; ++layer) {
    const std::vector<glm::vec3>& map = volumes_->hulls()[layer].texels;
    for (std::size_t i = 0; i < texels; ++i) whole[i] = glm::vec4(map[i], 0.0f);
    halves_from_floats(&whole[0].x, staging.mapped<std::uint16_t>() + layer * texels * 4, texels * 4);
  }
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, layers};
  region.imageExtent = {side, side, 1};
  device.run_now([&](VkCommandBuffer commands) {
    BarrierBatch barriers;
    barriers.add(hulls_, Access::transfer_write, true);
    barriers.record(commands);
    vkCmdCopyBufferToImage(commands, staging.get(), hulls_.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  });
}

}  // namespace seascape
