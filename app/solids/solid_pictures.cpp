#include "app/solids/solid_pictures.h"

#include <algorithm>
#include <cstring>

#include "engine/barrier.h"

namespace seascape {

Image make_texture(Device& device, std::string_view name, std::span<const Image8> levels, TexelKind kind,
                   int most_side) {
  while (levels.size() > 1 && std::max(levels.front().width, levels.front().height) > most_side)
    levels = levels.subspan(1);
  ImageSpec spec;
  spec.width = std::uint32_t(levels.front().width);
  spec.height = std::uint32_t(levels.front().height);
  spec.levels = std::uint32_t(levels.size());
  spec.format = kind == TexelKind::colour ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
  spec.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  spec.array = false;
  Image image(device, name, spec);
  VkDeviceSize bytes = 0;
  for (const Image8& level : levels) bytes += level.pixels.size();
  const Buffer staging(device, "texture upload", bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
  std::vector<VkBufferImageCopy> regions;
  VkDeviceSize offset = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    std::memcpy(staging.mapped<std::uint8_t>() + offset, levels[i].pixels.data(), levels[i].pixels.size());
    VkBufferImageCopy& region = regions.emplace_back();
    region = {};
    region.bufferOffset = offset;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, std::uint32_t(i), 0, 1};
    region.imageExtent = {std::uint32_t(levels[i].width), std::uint32_t(levels[i].height), 1};
    offset += levels[i].pixels.size();
  }
  device.run_now([&](VkCommandBuffer commands) {
    BarrierBatch before;
    before.add(image, Access::transfer_write, true);
    before.record(commands);
    vkCmdCopyBufferToImage(commands, staging.get(), image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           std::uint32_t(regions.size()), regions.data());
    BarrierBatch after;
    after.add(image, Access::fragment_sample);
    after.record(commands);
  });
  return image;
}

}  // namespace seascape
