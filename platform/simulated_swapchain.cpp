// The simulated runtime's calls of OpenXR that are about swapchains: images of the program's own device.
#include <algorithm>

#include "platform/simulated_state.h"

namespace seascape::simulated {

namespace {

using State = SimulatedRuntime::State;

constexpr std::size_t images_each = 3;
constexpr std::int64_t formats[] = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_D32_SFLOAT};

VkImageUsageFlags usage_of(XrSwapchainUsageFlags flags) {
  VkImageUsageFlags usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT;  // to be read, whatever else
  const auto take = [&](XrSwapchainUsageFlags flag, VkImageUsageFlags of) { usage |= flags & flag ? of : 0u; };
  take(XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  take(XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  take(XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  take(XR_SWAPCHAIN_USAGE_SAMPLED_BIT, VK_IMAGE_USAGE_SAMPLED_BIT);
  return usage;
}

VkResult make_image(const Vulkan& vulkan, const XrSwapchainCreateInfo& info, Swapchain& to) {
  VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  create.imageType = VK_IMAGE_TYPE_2D;
  create.format = VkFormat(info.format);
  create.extent = {info.width, info.height, 1};
  create.mipLevels = 1;
  create.arrayLayers = info.arraySize;
  create.samples = VK_SAMPLE_COUNT_1_BIT;
  create.usage = usage_of(info.usageFlags);
  VkImage image = VK_NULL_HANDLE;
  if (const VkResult result = vkCreateImage(vulkan.device, &create, nullptr, &image); result != VK_SUCCESS)
    return result;
  to.images.push_back(image);
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(vulkan.device, image, &needs);
  VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  allocate.allocationSize = needs.size;
  while (!(needs.memoryTypeBits & (1u << allocate.memoryTypeIndex))) ++allocate.memoryTypeIndex;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  if (const VkResult result = vkAllocateMemory(vulkan.device, &allocate, nullptr, &memory); result != VK_SUCCESS)
    return result;
  to.memories.push_back(memory);
  return vkBindImageMemory(vulkan.device, image, memory, 0);
}

XRAPI_ATTR XrResult XRAPI_CALL enumerate_formats(XrSession, std::uint32_t room, std::uint32_t* count,
                                                 std::int64_t* to) {
  return hand_out<std::int64_t>(formats, room, count, to);
}

XRAPI_ATTR XrResult XRAPI_CALL create_swapchain(XrSession session, const XrSwapchainCreateInfo* info,
                                                XrSwapchain* made) {
  State& s = object<State>(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (std::find(std::begin(formats), std::end(formats), info->format) == std::end(formats))
    return XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED;
  s.swapchains.push_back(std::make_unique<Swapchain>(Swapchain{s, *info}));
  Swapchain& swapchain = *s.swapchains.back();
  for (std::size_t i = 0; i < images_each; ++i)
    if (make_image(s.vulkan, *info, swapchain) != VK_SUCCESS) {
      destroy_swapchain(s, swapchain);
      return XR_ERROR_OUT_OF_MEMORY;
    }
  // As a real runtime lends them: in the layout of what is drawn into.
  prepare_images(s.vulkan, swapchain);
  *made = handle<XrSwapchain>(&swapchain);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL destroy(XrSwapchain swapchain) {
  Swapchain& gone = object<Swapchain>(swapchain);
  destroy_swapchain(gone.of, gone);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL enumerate_images(XrSwapchain swapchain, std::uint32_t room, std::uint32_t* count,
                                                XrSwapchainImageBaseHeader* to) {
  const Swapchain& of = object<Swapchain>(swapchain);
  *count = std::uint32_t(of.images.size());
  if (room == 0) return XR_SUCCESS;
  if (room < of.images.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  auto* images = reinterpret_cast<XrSwapchainImageVulkan2KHR*>(to);
  for (std::size_t i = 0; i < of.images.size(); ++i) images[i].image = of.images[i];
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL acquire(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo*,
                                       std::uint32_t* index) {
  Swapchain& of = object<Swapchain>(swapchain);
  if (of.of.lost) return XR_ERROR_SESSION_LOST;
  if (of.acquired) return XR_ERROR_CALL_ORDER_INVALID;
  of.acquired = of.next;
  of.waited = false;
  of.next = (of.next + 1) % of.images.size();
  *index = std::uint32_t(*of.acquired);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL wait(XrSwapchain swapchain, const XrSwapchainImageWaitInfo*) {
  Swapchain& of = object<Swapchain>(swapchain);
  if (of.of.lost) return XR_ERROR_SESSION_LOST;
  if (!of.acquired || of.waited) return XR_ERROR_CALL_ORDER_INVALID;
  of.waited = true;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL release(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo*) {
  Swapchain& of = object<Swapchain>(swapchain);
  if (of.of.lost) return XR_ERROR_SESSION_LOST;
  if (!of.acquired || !of.waited) return XR_ERROR_CALL_ORDER_INVALID;
  of.released = std::exchange(of.acquired, std::nullopt);
  return XR_SUCCESS;
}

}  // namespace

void destroy_swapchain(State& of, Swapchain& gone) {
  vkQueueWaitIdle(of.vulkan.queue);  // as Monado does
  for (VkImage image : gone.images) vkDestroyImage(of.vulkan.device, image, nullptr);
  for (VkDeviceMemory memory : gone.memories) vkFreeMemory(of.vulkan.device, memory, nullptr);
  std::erase_if(of.swapchains, [&](const auto& one) { return one.get() == &gone; });
}

PFN_xrVoidFunction picture_call(std::string_view name) {
  SEASCAPE_SIMULATED(EnumerateSwapchainFormats, enumerate_formats)
  SEASCAPE_SIMULATED(CreateSwapchain, create_swapchain)
  SEASCAPE_SIMULATED(DestroySwapchain, destroy)
  SEASCAPE_SIMULATED(EnumerateSwapchainImages, enumerate_images)
  SEASCAPE_SIMULATED(AcquireSwapchainImage, acquire)
  SEASCAPE_SIMULATED(WaitSwapchainImage, wait)
  SEASCAPE_SIMULATED(ReleaseSwapchainImage, release)
  return nullptr;
}

}  // namespace seascape::simulated
