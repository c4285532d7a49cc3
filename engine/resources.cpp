#include "engine/resources.h"

#include <cassert>

#include <algorithm>
#include <cstring>

#include "engine/barrier.h"
#include "engine/error.h"

namespace seascape {

Buffer::Buffer(Device& device, std::string_view name, VkDeviceSize bytes, VkBufferUsageFlags usage, HostAccess host)
    : bytes_(bytes) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = bytes;
  info.usage = usage;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer), "vkCreateBuffer");
  buffer_ = Owned<VkBuffer>(device, buffer, name, bytes);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.handle(), buffer, &needs);
  const VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (host) {
    case HostAccess::none:
      allocation_ = device.memory().allocate(needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, false);
      break;
    case HostAccess::write:
      allocation_ = device.memory().allocate(needs, visible, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, false);
      break;
    case HostAccess::read:
      allocation_ = device.memory().allocate(needs, visible, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, false);
      break;
  }
  check(vkBindBufferMemory(device.handle(), buffer, allocation_.memory(), allocation_.offset()), "vkBindBufferMemory");
}

Buffer make_filled_buffer(Device& device, std::string_view name, const void* data, VkDeviceSize bytes,
                          VkBufferUsageFlags usage) {
  Buffer staging(device, "staging", bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, HostAccess::write);
  std::memcpy(staging.mapped<void>(), data, bytes);
  Buffer buffer(device, name, bytes, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  device.run_now([&](VkCommandBuffer commands) {
    const VkBufferCopy region{0, 0, bytes};
    vkCmdCopyBuffer(commands, staging.get(), buffer.get(), 1, &region);
  });
  return buffer;
}

Image::Image(Device& device, std::string_view name, const ImageSpec& spec)
    : device_(&device), name_(name), spec_(spec) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = spec.format;
  info.extent = {spec.width, spec.height, 1};
  info.mipLevels = spec.levels;
  info.arrayLayers = spec.layers;
  info.samples = spec.samples;
  info.tiling = spec.host ? VK_IMAGE_TILING_LINEAR : VK_IMAGE_TILING_OPTIMAL;
  // What the host has written before the first use is kept.
  if (spec.host) info.initialLayout = state_.layout = VK_IMAGE_LAYOUT_PREINITIALIZED;
  info.usage = spec.usage | (spec.transient ? VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT : 0);
  if (spec.mutable_as != VK_FORMAT_UNDEFINED) info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(device.handle(), &info, nullptr, &image), "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device.handle(), image, &needs);
  image_ = Owned<VkImage>(device, image, name, needs.size, {std::make_shared<const ImageSpec>(spec), {}});
  allocation_ = device.memory().allocate(
      needs, spec.host ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0,
      spec.host        ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
      : spec.transient ? VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
                       : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
      true);
  check(vkBindImageMemory(device.handle(), image, allocation_.memory(), allocation_.offset()), "vkBindImageMemory");
  const VkImageUsageFlags viewable = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  if (spec.usage & viewable) view_ = make_view(0, spec.levels, 0, spec.layers, spec.array, aspect());
}

bool host_may_write(const Device& device, const ImageSpec& spec) {
  VkFormatProperties features;
  vkGetPhysicalDeviceFormatProperties(device.physical(), spec.format, &features);
  if (!(features.linearTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT)) return false;
  VkImageFormatProperties most;
  if (vkGetPhysicalDeviceImageFormatProperties(device.physical(), spec.format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_LINEAR,
                                               spec.usage, 0, &most) != VK_SUCCESS)
    return false;
  return most.maxExtent.width >= spec.width && most.maxExtent.height >= spec.height &&
         most.maxMipLevels >= spec.levels && most.maxArrayLayers >= spec.layers;
}

Image::HostTexels Image::host_texels(std::uint32_t level, std::uint32_t layer) const {
  assert(spec_.host);
  const VkImageSubresource part{aspect(), level, layer};
  VkSubresourceLayout place;
  vkGetImageSubresourceLayout(device_->handle(), get(), &part, &place);
  return {static_cast<std::byte*>(allocation_.mapped()) + place.offset, std::size_t(place.rowPitch)};
}

Image::Image(Device& device, std::string_view name, VkImage borrowed, const ImageSpec& spec)
    : device_(&device), name_(name), spec_(spec), borrowed_(borrowed) {
  view_ = make_view(0, spec.levels, 0, spec.layers, spec.array, aspect());
}

static bool has_stencil(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT_S8_UINT || format == VK_FORMAT_D24_UNORM_S8_UINT;
}

VkImageAspectFlags Image::aspect() const {
  return spec_.format == VK_FORMAT_D32_SFLOAT || spec_.format == VK_FORMAT_D16_UNORM || has_stencil(spec_.format)
             ? VK_IMAGE_ASPECT_DEPTH_BIT
             : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkImageAspectFlags Image::all_aspects() const {
  return aspect() | (has_stencil(spec_.format) ? VkImageAspectFlags(VK_IMAGE_ASPECT_STENCIL_BIT) : 0u);
}

Owned<VkImageView> Image::make_view(std::uint32_t level, std::uint32_t levels, std::uint32_t layer,
                                    std::uint32_t layers, bool array, VkImageAspectFlags aspect) {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = get();
  info.viewType = array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  info.format = spec_.format;
  info.components = spec_.channels;
  info.subresourceRange = {aspect, level, levels, layer, layers};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device_->handle(), &info, nullptr, &view), "vkCreateImageView");
  return Owned<VkImageView>(*device_, view, name_, 0, {std::make_shared<const ImageSpec>(spec_), {}});
}

VkImageView Image::subview(std::uint32_t level, std::uint32_t levels, std::uint32_t layer, std::uint32_t layers,
                           bool array) {
  subviews_.push_back(make_view(level, levels, layer, layers, array, aspect()));
  return subviews_.back().get();
}

VkImageView Image::stencil_view() {
  assert(has_stencil(spec_.format));
  subviews_.push_back(make_view(0, 1, 0, spec_.layers, true, VK_IMAGE_ASPECT_STENCIL_BIT));
  return subviews_.back().get();
}

Owned<VkSampler> make_sampler(Device& device, std::string_view name, const SamplerSpec& spec) {
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = spec.linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  info.mipmapMode = spec.linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = info.addressModeV = info.addressModeW =
      spec.repeat ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeU = spec.across.value_or(info.addressModeU);
  info.addressModeV = spec.up.value_or(info.addressModeV);
  info.maxLod = VK_LOD_CLAMP_NONE;
  const float anisotropy = std::min(spec.anisotropy, device.facts().max_anisotropy);
  info.anisotropyEnable = anisotropy > 1.0f;
  info.maxAnisotropy = std::max(1.0f, anisotropy);
  info.compareEnable = spec.compare.has_value();
  info.compareOp = spec.compare.value_or(VK_COMPARE_OP_NEVER);
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
  return Owned<VkSampler>(device, sampler, name);
}

std::uint32_t bytes_per_texel(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R32G32B32A32_SFLOAT:
    case VK_FORMAT_R32G32B32A32_UINT:
      return 16;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R32G32_UINT:
      return 8;
    case VK_FORMAT_R16_SFLOAT:
      return 2;
    case VK_FORMAT_R8_UNORM:
      return 1;
    default:
      return 4;  // all others that are used here
  }
}

std::vector<std::uint8_t> read_image(Device& device, const Image& image, std::uint32_t layer, std::uint32_t level,
                                     VkExtent2D part) {
  device.wait_idle();
  const std::uint32_t width = part.width ? part.width : std::max(1u, image.spec().width >> level),
                      height = part.width ? part.height : std::max(1u, image.spec().height >> level);
  const VkDeviceSize bytes = VkDeviceSize(width) * height * bytes_per_texel(image.spec().format);
  Buffer staging(device, "readback", bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostAccess::read);
  device.run_now([&](VkCommandBuffer commands) {
    BarrierBatch barriers;
    barriers.add(image, Access::transfer_read, false);
    barriers.record(commands);
    VkBufferImageCopy region{};
    region.imageSubresource = {image.aspect(), level, layer, 1};
    region.imageExtent = {width, height, 1};
    vkCmdCopyImageToBuffer(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.get(), 1, &region);
    BarrierBatch after;
    staging.state() = {
        VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, 0, 0, 0};
    after.add(staging, Access::host_read);
    after.record(commands);
  });
  const auto* first = staging.mapped<std::uint8_t>();
  return {first, first + bytes};
}

std::vector<std::uint8_t> read_buffer(Device& device, const Buffer& buffer) {
  device.wait_idle();
  Buffer staging(device, "readback", buffer.bytes(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, HostAccess::read);
  device.run_now([&](VkCommandBuffer commands) {
    BarrierBatch before;
    before.add(buffer, Access::transfer_read);
    before.record(commands);
    const VkBufferCopy region{0, 0, buffer.bytes()};
    vkCmdCopyBuffer(commands, buffer.get(), staging.get(), 1, &region);
    BarrierBatch after;
    staging.state() = {
        VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, 0, 0, 0};
    after.add(staging, Access::host_read);
    after.record(commands);
  });
  const auto* first = staging.mapped<std::uint8_t>();
  return {first, first + buffer.bytes()};
}

}  // namespace seascape
