#include "platform/headset_swapchain.h"

#include <algorithm>
#include <utility>

namespace seascape {

HeadsetSwapchain::HeadsetSwapchain(const HeadsetSystem& system, Device& device, XrSession session,
                                   const HeadsetSwapchainSpec& spec)
    : api_(&system.api()), device_(&device), spec_(spec) {
  XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
  info.usageFlags = spec.usage;
  info.format = spec.format;
  info.sampleCount = 1;
  info.width = spec.width;
  info.height = spec.height;
  info.faceCount = 1;
  info.arraySize = spec.layers;
  info.mipCount = 1;
  {
    const std::lock_guard lock(device.queue_mutex());
    check_xr(api_->CreateSwapchain(session, &info, &swapchain_), "xrCreateSwapchain");
  }
  try {
    std::uint32_t count = 0;
    check_xr(api_->EnumerateSwapchainImages(swapchain_, 0, &count, nullptr), "xrEnumerateSwapchainImages");
    if (count == 0 || count > 64)
      throw Error("OpenXR", "xrEnumerateSwapchainImages counts " + std::to_string(count),
                  "update the headset's runtime");
    std::vector<XrSwapchainImageVulkan2KHR> images(count, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR});
    check_xr(api_->EnumerateSwapchainImages(swapchain_, count, &count,
                                            reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
             "xrEnumerateSwapchainImages");
    for (const auto& one : images) {
      if (one.image == VK_NULL_HANDLE)
        throw Error("OpenXR", "xrEnumerateSwapchainImages gives fewer images than it counts",
                    "update the headset's runtime");
      images_.push_back(one.image);
    }
  } catch (...) {
    reset();
    throw;
  }
}

void HeadsetSwapchain::swap(HeadsetSwapchain& other) noexcept {
  std::swap(api_, other.api_);
  std::swap(device_, other.device_);
  std::swap(swapchain_, other.swapchain_);
  std::swap(spec_, other.spec_);
  std::swap(images_, other.images_);
  std::swap(acquired_, other.acquired_);
}

void HeadsetSwapchain::reset() {
  if (swapchain_) {
    const std::lock_guard lock(device_->queue_mutex());
    api_->DestroySwapchain(swapchain_);
  }
  swapchain_ = XR_NULL_HANDLE;
}

std::size_t HeadsetSwapchain::acquire() {
  std::uint32_t index = 0;
  check_xr(api_->AcquireSwapchainImage(swapchain_, nullptr, &index), "xrAcquireSwapchainImage");
  acquired_ = true;
  if (index >= images_.size())
    throw Error("OpenXR", "xrAcquireSwapchainImage gives an image that there is not", "update the headset's runtime");
  XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
  wait.timeout = 1'000'000'000;
  for (int patience = 0; patience < 5; ++patience)
    if (check_xr(api_->WaitSwapchainImage(swapchain_, &wait), "xrWaitSwapchainImage") != XR_TIMEOUT_EXPIRED)
      return index;
  throw Error("OpenXR", "the runtime holds a picture for more than five seconds", "start the headset's runtime anew");
}

void HeadsetSwapchain::release() {
  acquired_ = false;
  check_xr(api_->ReleaseSwapchainImage(swapchain_, nullptr), "xrReleaseSwapchainImage");
}

VkFormat headset_format(const HeadsetSystem& system, XrSession session, std::initializer_list<VkFormat> wanted) {
  const auto formats = xr_list("xrEnumerateSwapchainFormats", std::int64_t{},
                               [&](std::uint32_t room, std::uint32_t* found, std::int64_t* to) {
                                 return system.api().EnumerateSwapchainFormats(session, room, found, to);
                               });
  // The runtime's own order is by what it likes best.
  for (const std::int64_t format : formats)
    if (std::find(wanted.begin(), wanted.end(), VkFormat(format)) != wanted.end()) return VkFormat(format);
  return VK_FORMAT_UNDEFINED;
}

}  // namespace seascape
