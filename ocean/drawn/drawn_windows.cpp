#include "ocean/drawn/drawn_windows.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <string>
#include <vector>

#include "ocean/waves/half_floats.h"

namespace seascape {

namespace {
int channels_of(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_R16_SFLOAT:
      return 1;
    case VK_FORMAT_R16G16_SFLOAT:
      return 2;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return 4;
    default:
      assert(false);
      return 0;
  }
}
ImageSpec spec_of(const LodWindowSettings& windows, VkFormat format, int layers) {
  ImageSpec spec;
  spec.width = spec.height = std::uint32_t(windows.resolution);
  spec.layers = std::uint32_t(windows.slices * layers);
  spec.format = format;
  spec.usage =
      VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;  // read by tests
  return spec;
}
}  // namespace

DrawnWindows::DrawnWindows(Device& device, std::string_view name, const LodWindowSettings& windows, VkFormat format,
                           int layers)
    : layers_(layers),
      channels_(channels_of(format)),
      half_(bytes_per_texel(format) == 2u * std::uint32_t(channels_)),
      image_(device, std::string(name) + ", windows", spec_of(windows, format, layers)) {
  const ImageSpec& spec = image_.spec();
  const std::size_t bytes = std::size_t(spec.layers) * spec.width * spec.height * bytes_per_texel(format);
  for (Buffer& staging : staging_)
    staging =
        Buffer(device, std::string(name) + ", staging", bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
}

void DrawnWindows::copy(Frame& frame, const char* pass, const LodChanges& changes,
                        const std::function<int(int slice)>& layer_of, const Row& row) {
  const int side = int(image_.spec().width);
  const std::size_t texel_bytes = bytes_per_texel(image_.spec().format);
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  std::vector<VkBufferImageCopy> regions;
  for (int slice = 0; slice * layers_ < int(image_.spec().layers); ++slice) {
    const std::vector<LodRect> parts = rects(changes[std::size_t(slice)], side);
    for (int layer = 0; layer < layers_; ++layer) {
      // A texel lies in the staging buffer where it would if the whole slice were copied.
      const std::size_t first = std::size_t(slice * layers_ + layer) * std::size_t(side) * std::size_t(side);
      for (const auto& [x, z] : parts) {
        const std::size_t columns = std::size_t(x.to - x.from), floats = columns * std::size_t(channels_);
        const auto offset = [&](int j) {
          return (first + std::size_t(j) * std::size_t(side) + std::size_t(x.from)) * texel_bytes;
        };
        VkBufferImageCopy region{};
        region.bufferOffset = offset(z.from);
        region.bufferRowLength = std::uint32_t(side);
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, std::uint32_t(layer_of(slice) * layers_ + layer), 1};
        region.imageOffset = {x.from, z.from, 0};
        region.imageExtent = {std::uint32_t(columns), std::uint32_t(z.to - z.from), 1};
        regions.push_back(region);
        const int grain = std::max(1, 4096 / int(columns));  // rows that are worth a task
        tbb::parallel_for(tbb::blocked_range<int>(z.from, z.to, std::size_t(grain)), [&](const auto& rows) {
          std::array<float, 4 * 2048> texels;
          for (int j = rows.begin(); j < rows.end(); ++j) {
            row(slice, layer, j, x.from, std::span(texels.data(), floats));
            std::byte* to = staging.mapped<std::byte>() + offset(j);
            if (half_)
              halves_from_floats(texels.data(), reinterpret_cast<std::uint16_t*>(to), floats);
            else
              std::memcpy(to, texels.data(), floats * sizeof(float));
          }
        });
      }
    }
  }
  if (regions.empty()) return;
  frame.pass(pass, {use(staging, Access::transfer_read), use(image_, Access::transfer_write)},
             [&](Commands& c) { c.copy(staging, image_, regions); });
}

}  // namespace seascape
