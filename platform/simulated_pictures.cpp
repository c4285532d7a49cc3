// What the eyes of the simulated headset see: its layers over each other, on the processor.
#include <algorithm>
#include <cmath>

#include "platform/simulated_state.h"

namespace seascape::simulated {

namespace {

double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double encoded(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055; }

struct Memory {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
};

std::uint32_t memory_type(VkPhysicalDevice physical, std::uint32_t bits, VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((bits & (1u << i)) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  throw Error("simulated headset", "the device has no memory that the processor can read", "take another device");
}

Memory make_readback(const Vulkan& vulkan, VkDeviceSize bytes) {
  Memory made;
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  check(vkCreateBuffer(vulkan.device, &info, nullptr, &made.buffer), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(vulkan.device, made.buffer, &needs);
  VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = memory_type(vulkan.physical, needs.memoryTypeBits,
                                         VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkAllocateMemory(vulkan.device, &allocate, nullptr, &made.memory), "vkAllocateMemory");
  check(vkBindBufferMemory(vulkan.device, made.buffer, made.memory, 0), "vkBindBufferMemory");
  return made;
}

void record_copy(VkCommandBuffer commands, VkImage image, const VkBufferImageCopy& region, VkBuffer to) {
  VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  barrier.oldLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                       nullptr, 1, &barrier);
  vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to, 1, &region);
  std::swap(barrier.oldLayout, barrier.newLayout);
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  VkMemoryBarrier to_host{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, nullptr, 1,
                       &barrier);
}

// Lays a quad over what an eye sees, where the eye's rays meet its front.
void lay_quad(Image8& picture, const XrCompositionLayerProjectionView& eye, const XrCompositionLayerQuad& quad,
              const Image8& shown) {
  const Pose eye_at = pose_from(eye.pose), quad_at = pose_from(quad.pose);
  const Pose from = composed(inverse(quad_at), eye_at);  // both are of one space
  if (from.position_m.z <= 0.0) return;
  const double left = std::tan(double(eye.fov.angleLeft)), right = std::tan(double(eye.fov.angleRight)),
               up = std::tan(double(eye.fov.angleUp)), down = std::tan(double(eye.fov.angleDown));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const glm::dvec3 ray = from.orientation * glm::dvec3(left + (right - left) * (x + 0.5) / picture.width,
                                                           up + (down - up) * (y + 0.5) / picture.height, -1.0);
      if (ray.z >= 0.0) continue;
      const glm::dvec3 met = from.position_m + ray * (from.position_m.z / -ray.z);
      const double u = met.x / double(quad.size.width) + 0.5, v = 0.5 - met.y / double(quad.size.height);
      if (u < 0.0 || u >= 1.0 || v < 0.0 || v >= 1.0) continue;
      // Bilinear, held at its edges.
      const double px = std::clamp(u * shown.width - 0.5, 0.0, shown.width - 1.0),
                   py = std::clamp(v * shown.height - 0.5, 0.0, shown.height - 1.0);
      const int x0 = int(px), y0 = int(py), x1 = std::min(x0 + 1, shown.width - 1),
                y1 = std::min(y0 + 1, shown.height - 1);
      const auto texel = [&](int tx, int ty, int channel) {
        const double value =
            shown.pixels[(std::size_t(ty) * std::size_t(shown.width) + std::size_t(tx)) * 4 + std::size_t(channel)] /
            255.0;
        return channel == 3 ? value : linear(value);
      };
      const auto sample = [&](int channel) {
        const double fx = px - x0, fy = py - y0;
        return (1 - fy) * ((1 - fx) * texel(x0, y0, channel) + fx * texel(x1, y0, channel)) +
               fy * ((1 - fx) * texel(x0, y1, channel) + fx * texel(x1, y1, channel));
      };
      std::uint8_t* pixel = &picture.pixels[(std::size_t(y) * std::size_t(picture.width) + std::size_t(x)) * 4];
      const double alpha = sample(3);
      for (int channel = 0; channel < 3; ++channel) {
        const double under = linear(pixel[channel] / 255.0);
        pixel[channel] =
            std::uint8_t(std::lround(255.0 * std::clamp(encoded(under * (1.0 - alpha) + sample(channel)), 0.0, 1.0)));
      }
    }
}

}  // namespace

namespace {

template <class Record>
void run_now(const Vulkan& vulkan, const Record& record) {
  VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocate.commandPool = vulkan.pool;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(vulkan.device, &allocate, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  record(commands);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(vkQueueSubmit(vulkan.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  check(vkQueueWaitIdle(vulkan.queue), "vkQueueWaitIdle");
  vkFreeCommandBuffers(vulkan.device, vulkan.pool, 1, &commands);
}

}  // namespace

void prepare_images(const Vulkan& vulkan, const Swapchain& swapchain) {
  const bool depth = swapchain.info.usageFlags & XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  run_now(vulkan, [&](VkCommandBuffer commands) {
    for (VkImage image : swapchain.images) {
      VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
      barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
      barrier.newLayout =
          depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
      barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
      barrier.image = image;
      barrier.subresourceRange = {VkImageAspectFlags(depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), 0,
                                  1, 0, VK_REMAINING_ARRAY_LAYERS};
      vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                           nullptr, 0, nullptr, 1, &barrier);
    }
  });
}

Image8 read_layer(const Vulkan& vulkan, const Swapchain& swapchain, const XrSwapchainSubImage& part) {
  const std::uint32_t width = std::uint32_t(part.imageRect.extent.width),
                      height = std::uint32_t(part.imageRect.extent.height);
  const VkDeviceSize bytes = VkDeviceSize(width) * height * 4;
  const Memory readback = make_readback(vulkan, bytes);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, part.imageArrayIndex, 1};
  region.imageOffset = {part.imageRect.offset.x, part.imageRect.offset.y, 0};
  region.imageExtent = {width, height, 1};
  run_now(vulkan, [&](VkCommandBuffer commands) {
    record_copy(commands, swapchain.images[*swapchain.released], region, readback.buffer);
  });
  Image8 picture{int(width), int(height), 4, {}};
  void* mapped = nullptr;
  check(vkMapMemory(vulkan.device, readback.memory, 0, bytes, 0, &mapped), "vkMapMemory");
  picture.pixels.assign(static_cast<const std::uint8_t*>(mapped), static_cast<const std::uint8_t*>(mapped) + bytes);
  vkDestroyBuffer(vulkan.device, readback.buffer, nullptr);
  vkFreeMemory(vulkan.device, readback.memory, nullptr);
  return picture;
}

Image8 composed_picture(const Vulkan& vulkan, std::span<const XrCompositionLayerBaseHeader* const> layers,
                        std::size_t eye) {
  Image8 picture;
  const XrCompositionLayerProjectionView* view = nullptr;
  for (const XrCompositionLayerBaseHeader* layer : layers)
    if (layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
      view = &reinterpret_cast<const XrCompositionLayerProjection*>(layer)->views[eye];
      picture = read_layer(vulkan, object<Swapchain>(view->subImage.swapchain), view->subImage);
    } else if (layer->type == XR_TYPE_COMPOSITION_LAYER_QUAD && view != nullptr) {
      const auto& quad = *reinterpret_cast<const XrCompositionLayerQuad*>(layer);
      lay_quad(picture, *view, quad, read_layer(vulkan, object<Swapchain>(quad.subImage.swapchain), quad.subImage));
    }
  return picture;
}

}  // namespace seascape::simulated
