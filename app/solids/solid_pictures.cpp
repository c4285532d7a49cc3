#include "app/solids/solid_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/barrier.h"

namespace seascape {

namespace {

double linear_of(std::uint8_t value) {
  const double x = value / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

const std::array<float, 256>& linear_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> made{};
    for (std::size_t i = 0; i < 256; ++i) made[i] = float(linear_of(std::uint8_t(i)));
    return made;
  }();
  return table;
}

std::uint8_t byte_of(float x) { return std::uint8_t(std::lround(255.0f * std::clamp(x, 0.0f, 1.0f))); }

std::uint8_t srgb_of(float x) {
  return byte_of(x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f);
}

Image8 halved(const Image8& from, TexelKind kind) {
  Image8 made{std::max(1, from.width / 2), std::max(1, from.height / 2), 4, {}};
  made.pixels.resize(std::size_t(made.width) * std::size_t(made.height) * 4);
  const auto& table = linear_table();
  for (int y = 0; y < made.height; ++y)
    for (int x = 0; x < made.width; ++x) {
      std::array<float, 4> sum{};
      float count = 0.0f;
      // A side that is odd gives its last texel to the one before.
      const int last_x = x + 1 == made.width ? from.width : 2 * x + 2,
                last_y = y + 1 == made.height ? from.height : 2 * y + 2;
      for (int v = 2 * y; v < last_y; ++v)
        for (int u = 2 * x; u < last_x; ++u, count += 1.0f) {
          const std::uint8_t* at = &from.pixels[4 * (std::size_t(v) * std::size_t(from.width) + std::size_t(u))];
          for (std::size_t c = 0; c < 4; ++c)
            sum[c] += kind == TexelKind::colour && c < 3 ? table[at[c]] : float(at[c]) / 255.0f;
        }
      for (float& one : sum) one /= count;
      if (kind == TexelKind::normal) {
        const glm::vec3 n = 2.0f * glm::vec3(sum[0], sum[1], sum[2]) - 1.0f;
        const float length = glm::length(n);
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] = length > 1e-3f ? 0.5f + 0.5f * n[int(c)] / length : c == 2 ? 1.0f : 0.5f;
      }
      std::uint8_t* to = &made.pixels[4 * (std::size_t(y) * std::size_t(made.width) + std::size_t(x))];
      for (std::size_t c = 0; c < 4; ++c)
        to[c] = kind == TexelKind::colour && c < 3 ? srgb_of(sum[c]) : byte_of(sum[c]);
    }
  return made;
}

}  // namespace

std::vector<Image8> picture_levels(const Image8& picture, TexelKind kind) {
  std::vector<Image8> levels{picture};
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back(), kind));
  return levels;
}

Image make_texture(Device& device, std::string_view name, const Image8& picture, TexelKind kind, int most_side) {
  std::vector<Image8> levels = picture_levels(picture, kind);
  while (levels.size() > 1 && std::max(levels.front().width, levels.front().height) > most_side)
    levels.erase(levels.begin());
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
