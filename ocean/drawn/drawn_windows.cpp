#include "ocean/drawn/drawn_windows.h"

#include <tbb/parallel_for.h>

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
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
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

void DrawnWindows::copy(Frame& frame, const char* pass, std::uint32_t slices,
                        const std::function<int(int slice)>& layer_of, const Row& row) {
  const std::uint32_t side = image_.spec().width;
  const std::size_t row_floats = std::size_t(side) * std::size_t(channels_),
                    row_bytes = side * bytes_per_texel(image_.spec().format);
  const Buffer& staging = staging_[std::size_t(frame.slot())];
  std::vector<VkBufferImageCopy> regions;
  for (int slice = 0; slice * layers_ < int(image_.spec().layers); ++slice) {
    if ((slices >> slice & 1u) == 0) continue;
    for (int layer = 0; layer < layers_; ++layer) {
      VkBufferImageCopy region{};
      region.bufferOffset = std::size_t(slice * layers_ + layer) * side * row_bytes;
      region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, std::uint32_t(layer_of(slice) * layers_ + layer), 1};
      region.imageExtent = {side, side, 1};
      regions.push_back(region);
      tbb::parallel_for(0u, side, [&](std::uint32_t z) {
        std::array<float, 4 * 2048> texels;
        row(slice, layer, int(z), std::span(texels.data(), row_floats));
        std::byte* to = staging.mapped<std::byte>() + region.bufferOffset + z * row_bytes;
        if (half_)
          halves_from_floats(texels.data(), reinterpret_cast<std::uint16_t*>(to), row_floats);
        else
          std::memcpy(to, texels.data(), row_bytes);
      });
    }
  }
  frame.pass(pass, {use(staging, Access::transfer_read), use(image_, Access::transfer_write)},
             [&](Commands& c) { c.copy(staging, image_, regions); });
}

}  // namespace seascape
