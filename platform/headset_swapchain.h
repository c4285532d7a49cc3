// Images that a headset's runtime lends to be drawn into, one at a time.
#pragma once
#include "engine/render_target.h"
#include "platform/headset_system.h"

namespace seascape {

struct HeadsetSwapchainSpec {
  std::uint32_t width = 0, height = 0, layers = 2;
  VkFormat format = VK_FORMAT_UNDEFINED;
  XrSwapchainUsageFlags usage = 0;
};

class HeadsetSwapchain {
 public:
  HeadsetSwapchain() = default;
  // Made and destroyed while the device's queue is still: runtimes use it then too.
  HeadsetSwapchain(const HeadsetSystem& system, Device& device, XrSession session, const HeadsetSwapchainSpec& spec);
  ~HeadsetSwapchain() { reset(); }
  HeadsetSwapchain(HeadsetSwapchain&& other) noexcept { swap(other); }
  HeadsetSwapchain& operator=(HeadsetSwapchain&& other) noexcept {
    swap(other);
    return *this;
  }

  // The device's queue must be still during these two (Device::queue_mutex).
  std::size_t acquire();  // its number among images(), ready to be drawn into
  void release();         // submitted, and shown with the layers of the next xrEndFrame
  bool acquired() const { return acquired_; }

  XrSwapchain get() const { return swapchain_; }
  const std::vector<VkImage>& images() const { return images_; }
  const HeadsetSwapchainSpec& spec() const { return spec_; }
  explicit operator bool() const { return swapchain_ != XR_NULL_HANDLE; }

 private:
  void swap(HeadsetSwapchain& other) noexcept;
  void reset();
  const XrApi* api_ = nullptr;
  Device* device_ = nullptr;
  XrSwapchain swapchain_ = XR_NULL_HANDLE;
  HeadsetSwapchainSpec spec_;
  std::vector<VkImage> images_;
  bool acquired_ = false;
};

// The first of `wanted` that the runtime has; VK_FORMAT_UNDEFINED: none.
VkFormat headset_format(const HeadsetSystem& system, XrSession session, std::initializer_list<VkFormat> wanted);

}  // namespace seascape
