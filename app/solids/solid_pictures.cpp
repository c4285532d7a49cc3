#include "app/solids/solid_pictures.h"

#include <algorithm>
#include <cstring>

#include "engine/barrier.h"

namespace seascape {

namespace {

struct Level {
  int width, height;
  std::span<const std::uint8_t> bytes;
};

Image filled(Device& device, std::string_view name, const std::vector<Level>& levels, VkFormat format,
             const VkComponentMapping& channels) {
  ImageSpec spec;
  spec.width = std::uint32_t(levels.front().width);
  spec.height = std::uint32_t(levels.front().height);
  spec.levels = std::uint32_t(levels.size());
  spec.format = format;
  spec.channels = channels;
  spec.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  spec.array = false;
  Image image(device, name, spec);
  VkDeviceSize bytes = 0;
  for (const Level& level : levels) bytes += level.bytes.size();
  const Buffer staging(device, "texture upload", bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
  std::vector<VkBufferImageCopy> regions;
  VkDeviceSize offset = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    std::memcpy(staging.mapped<std::uint8_t>() + offset, levels[i].bytes.data(), levels[i].bytes.size());
    VkBufferImageCopy& region = regions.emplace_back();
    region = {};
    region.bufferOffset = offset;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, std::uint32_t(i), 0, 1};
    region.imageExtent = {std::uint32_t(levels[i].width), std::uint32_t(levels[i].height), 1};
    offset += levels[i].bytes.size();
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

}  // namespace

Image make_texture(Device& device, std::string_view name, std::span<const Image8> levels, TexelKind kind) {
  std::vector<Level> all;
  for (const Image8& level : levels) all.push_back({level.width, level.height, level.pixels});
  return filled(device, name, all, kind == TexelKind::colour ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM, {});
}

Image make_block_texture(Device& device, std::string_view name, std::span<const BlockLevel> levels, BlockKind block,
                         TexelKind kind) {
  std::vector<Level> all;
  for (const BlockLevel& level : levels) all.push_back({level.width, level.height, level.blocks});
  VkComponentMapping channels{};
  if (kind == TexelKind::linear)  // its green and blue
    channels = {VK_COMPONENT_SWIZZLE_ONE, VK_COMPONENT_SWIZZLE_R, VK_COMPONENT_SWIZZLE_G, VK_COMPONENT_SWIZZLE_ONE};
  const VkFormat format = block == BlockKind::bc1   ? VK_FORMAT_BC1_RGB_SRGB_BLOCK
                          : block == BlockKind::bc3 ? VK_FORMAT_BC3_SRGB_BLOCK
                          : block == BlockKind::bc4 ? VK_FORMAT_BC4_UNORM_BLOCK
                                                    : VK_FORMAT_BC5_UNORM_BLOCK;
  return filled(device, name, all, format, channels);
}

}  // namespace seascape
