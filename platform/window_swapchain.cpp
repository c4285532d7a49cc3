// The window's swapchain: made anew whenever the window asks for it, its images taken and presented.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/error.h"
#include "platform/window.h"

namespace seascape {

namespace {

Owned<VkSemaphore> make_semaphore(Device& device, const char* name) {
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device.handle(), &info, nullptr, &semaphore), "vkCreateSemaphore");
  return Owned<VkSemaphore>(device, semaphore, name);
}

Owned<VkFence> make_fence(Device& device, const char* name) {
  const VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  VkFence fence = VK_NULL_HANDLE;
  check(vkCreateFence(device.handle(), &info, nullptr, &fence), "vkCreateFence");
  return Owned<VkFence>(device, fence, name);
}

// FIFO, which all have, may hold a presenting thread up.
VkPresentModeKHR mode_without_waiting(const Device& device, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical(), surface, &count, nullptr),
        "vkGetPhysicalDeviceSurfacePresentModesKHR");
  std::vector<VkPresentModeKHR> modes(count);
  check(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physical(), surface, &count, modes.data()),
        "vkGetPhysicalDeviceSurfacePresentModesKHR");
  for (const VkPresentModeKHR mode : {VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR})
    if (std::find(modes.begin(), modes.end(), mode) != modes.end()) return mode;
  return VK_PRESENT_MODE_FIFO_KHR;
}

}  // namespace

void Window::make_waits() {
  for (auto& semaphore : acquired_) semaphore = make_semaphore(device_, "picture acquired");
  if (!options_.waits) image_free_ = make_fence(device_, "window's image free");
}

bool Window::make_swapchain() {
  const EffectScope scope(device_, "window");
  VkSurfaceCapabilitiesKHR can{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_.get(), &can),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  VkExtent2D extent = can.currentExtent;
  if (extent.width == UINT32_MAX)  // the surface takes the swapchain's size
    extent = {std::clamp(std::uint32_t(width_), can.minImageExtent.width, can.maxImageExtent.width),
              std::clamp(std::uint32_t(height_), can.minImageExtent.height, can.maxImageExtent.height)};
  if (extent.width == 0 || extent.height == 0) return false;
  // Neither frames nor presenting use the old images after this. What is given up here lives until the frame that is
  // being recorded has finished, as everything does.
  if (options_.waits) {  // or else its own frames have left the GPU, and others have nothing to do with it
    const std::lock_guard lock(device_.queue_mutex());
    check(vkDeviceWaitIdle(device_.handle()), "vkDeviceWaitIdle");
  }
  images_.clear();
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = surface_.get();
  info.minImageCount = std::max(3u, can.minImageCount);
  if (can.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = can.currentTransform;
  info.compositeAlpha = can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = options_.waits ? VK_PRESENT_MODE_FIFO_KHR : mode_without_waiting(device_, surface_.get());
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain_.get();
  VkSwapchainKHR made = VK_NULL_HANDLE;
  check(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &made), "vkCreateSwapchainKHR");
  swapchain_ = Owned<VkSwapchainKHR>(device_, made, "window");
  extent_ = extent;
  ++swapchains_made_;

  std::uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(device_.handle(), made, &count, nullptr), "vkGetSwapchainImagesKHR");
  std::vector<VkImage> handles(count);
  check(vkGetSwapchainImagesKHR(device_.handle(), made, &count, handles.data()), "vkGetSwapchainImagesKHR");
  ImageSpec spec;
  spec.width = extent.width;
  spec.height = extent.height;
  spec.format = format_.format;
  spec.usage = info.imageUsage;
  spec.array = false;
  for (VkImage handle : handles) {
    SwapImage& one = images_.emplace_back();
    one.image = Image(device_, "window", handle, spec);
    one.drawn = make_semaphore(device_, "picture drawn");
    const VkImageView view = one.image.view();
    VkFramebufferCreateInfo framebuffer{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    framebuffer.renderPass = overlay_pass_;
    framebuffer.attachmentCount = 1;
    framebuffer.pAttachments = &view;
    framebuffer.width = extent.width;
    framebuffer.height = extent.height;
    framebuffer.layers = 1;
    VkFramebuffer framebuffer_handle = VK_NULL_HANDLE;
    check(vkCreateFramebuffer(device_.handle(), &framebuffer, nullptr, &framebuffer_handle), "vkCreateFramebuffer");
    one.framebuffer = Owned<VkFramebuffer>(device_, framebuffer_handle, "window");
  }
  stale_ = false;
  return true;
}

// The swapchain's next image, or null when the window cannot take a picture at present.
Window::SwapImage* Window::acquire(std::size_t slot) {
  constexpr std::uint64_t patience_ns = 1'000'000'000;  // a desktop may withhold images of a hidden window for ever
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (stale_ && !make_swapchain()) return nullptr;
    const VkResult result = vkAcquireNextImageKHR(device_.handle(), swapchain_.get(), patience_ns,
                                                  acquired_[slot].get(), VK_NULL_HANDLE, &image_index_);
    if (result == VK_ERROR_OUT_OF_DATE_KHR) {
      stale_ = true;
      continue;
    }
    check(result, "vkAcquireNextImageKHR");
    if (result == VK_TIMEOUT || result == VK_NOT_READY) return nullptr;
    if (result == VK_SUBOPTIMAL_KHR) stale_ = true;  // still good for this picture
    SwapImage& image = images_[image_index_];
    // The semaphore is waited for at the copy: the first barrier continues from there.
    image.image.state() = {};
    image.image.state().write_stages = VK_PIPELINE_STAGE_TRANSFER_BIT;
    return &image;
  }
  return nullptr;
}

// `drawn`: waited for; null: the image has left the GPU.
void Window::present(VkSemaphore drawn) {
  const VkSwapchainKHR swapchain = swapchain_.get();
  VkPresentInfoKHR present{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  present.waitSemaphoreCount = drawn ? 1 : 0;
  present.pWaitSemaphores = &drawn;
  present.swapchainCount = 1;
  present.pSwapchains = &swapchain;
  present.pImageIndices = &image_index_;
  const VkResult result = [&] {
    const std::lock_guard lock(device_.queue_mutex());
    return vkQueuePresentKHR(device_.queue(), &present);
  }();
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
    stale_ = true;
  else
    check(result, "vkQueuePresentKHR");
}

bool Window::ready(const Frame& frame) {
  if (!frame.ready()) return false;
  if (std::exchange(shown_next_, false)) present(VK_NULL_HANDLE);
  return shows() && hold_image();
}

// Whether an image is there to draw into that the desktop has done with. No semaphore stands for that, for which the
// queue would wait with all that others give it meanwhile.
bool Window::hold_image() {
  const VkFence fence = image_free_.get();
  const auto is_free = [&] {
    const VkResult result = vkGetFenceStatus(device_.handle(), fence);
    if (result != VK_NOT_READY) check(result, "vkGetFenceStatus");
    return result == VK_SUCCESS;
  };
  const auto give_up_fence = [&] {
    check(vkResetFences(device_.handle(), 1, &fence), "vkResetFences");
    holds_image_ = false;
  };
  if (holds_image_) {
    if (!is_free()) return false;
    if (!stale_) return true;
    give_up_fence();  // the image goes with its swapchain
  }
  if (stale_ && !make_swapchain()) return false;
  const VkResult result =
      vkAcquireNextImageKHR(device_.handle(), swapchain_.get(), 0, VK_NULL_HANDLE, fence, &image_index_);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) stale_ = true;
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_TIMEOUT || result == VK_NOT_READY) return false;
  check(result, "vkAcquireNextImageKHR");  // one that fits badly is still good; presenting it says so again
  holds_image_ = true;
  return is_free();
}

void Window::show(Frame& frame, std::span<const WindowPart> parts) {
  const VkFence fence = image_free_.get();
  check(vkResetFences(device_.handle(), 1, &fence), "vkResetFences");
  SwapImage& target = images_[image_index_];
  target.image.state() = {};
  draw(frame, target, parts);
  frame.submit();
  holds_image_ = false;
  shown_next_ = true;
}

}  // namespace seascape
