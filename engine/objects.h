// Ownership of Vulkan objects: every object is listed by the device while it lives, tagged with the effect it serves,
// and destroyed only after the frames in flight that may use it.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/vulkan.h"

namespace seascape {

class Device;
struct ImageSpec;
struct Shader;

// What an object was made with.
struct MadeWith {
  std::shared_ptr<const ImageSpec> image;              // of an image; of a view: its image's
  std::vector<std::shared_ptr<const Shader>> shaders;  // of a pipeline
};

struct ObjectRecord {
  VkObjectType type = VK_OBJECT_TYPE_UNKNOWN;
  std::uint64_t handle = 0;
  std::uint64_t bytes = 0;  // device memory of a buffer or image; code of a shader module
  std::string name;
  std::string effect;  // the EffectScope it was made in, "frame" outside any
  MadeWith made_with = {};
};

template <typename T>
inline constexpr VkObjectType object_type = VK_OBJECT_TYPE_UNKNOWN;
template <>
inline constexpr VkObjectType object_type<VkBuffer> = VK_OBJECT_TYPE_BUFFER;
template <>
inline constexpr VkObjectType object_type<VkImage> = VK_OBJECT_TYPE_IMAGE;
template <>
inline constexpr VkObjectType object_type<VkImageView> = VK_OBJECT_TYPE_IMAGE_VIEW;
template <>
inline constexpr VkObjectType object_type<VkSampler> = VK_OBJECT_TYPE_SAMPLER;
template <>
inline constexpr VkObjectType object_type<VkShaderModule> = VK_OBJECT_TYPE_SHADER_MODULE;
template <>
inline constexpr VkObjectType object_type<VkPipeline> = VK_OBJECT_TYPE_PIPELINE;
template <>
inline constexpr VkObjectType object_type<VkPipelineLayout> = VK_OBJECT_TYPE_PIPELINE_LAYOUT;
template <>
inline constexpr VkObjectType object_type<VkDescriptorSetLayout> = VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT;
template <>
inline constexpr VkObjectType object_type<VkDescriptorPool> = VK_OBJECT_TYPE_DESCRIPTOR_POOL;
template <>
inline constexpr VkObjectType object_type<VkRenderPass> = VK_OBJECT_TYPE_RENDER_PASS;
template <>
inline constexpr VkObjectType object_type<VkFramebuffer> = VK_OBJECT_TYPE_FRAMEBUFFER;
template <>
inline constexpr VkObjectType object_type<VkCommandPool> = VK_OBJECT_TYPE_COMMAND_POOL;
template <>
inline constexpr VkObjectType object_type<VkFence> = VK_OBJECT_TYPE_FENCE;
template <>
inline constexpr VkObjectType object_type<VkSemaphore> = VK_OBJECT_TYPE_SEMAPHORE;
template <>
inline constexpr VkObjectType object_type<VkQueryPool> = VK_OBJECT_TYPE_QUERY_POOL;
template <>
inline constexpr VkObjectType object_type<VkSwapchainKHR> = VK_OBJECT_TYPE_SWAPCHAIN_KHR;
template <>
inline constexpr VkObjectType object_type<VkSurfaceKHR> = VK_OBJECT_TYPE_SURFACE_KHR;

namespace detail {
void adopt(Device& device, VkObjectType type, std::uint64_t handle, std::string_view name, std::uint64_t bytes,
           MadeWith made_with);
void retire(Device& device, VkObjectType type, std::uint64_t handle);
}  // namespace detail

// Sole owner of one Vulkan handle.
template <typename T>
class Owned {
 public:
  Owned() = default;
  Owned(Device& device, T handle, std::string_view name, std::uint64_t bytes = 0, MadeWith made_with = {})
      : device_(&device), handle_(handle) {
    detail::adopt(device, object_type<T>, std::uint64_t(handle), name, bytes, std::move(made_with));
  }
  Owned(Owned&& other) noexcept : device_(other.device_), handle_(std::exchange(other.handle_, T{})) {}
  Owned& operator=(Owned&& other) noexcept {
    if (this != &other) {
      reset();
      device_ = other.device_;
      handle_ = std::exchange(other.handle_, T{});
    }
    return *this;
  }
  ~Owned() { reset(); }
  void reset() {
    if (handle_) detail::retire(*device_, object_type<T>, std::uint64_t(std::exchange(handle_, T{})));
  }
  T get() const { return handle_; }
  explicit operator bool() const { return handle_ != T{}; }

 private:
  Device* device_ = nullptr;
  T handle_{};
};

// Objects made on this thread while it lives belong to the named effect.
class EffectScope {
 public:
  EffectScope(Device& device, std::string_view effect);
  ~EffectScope();
  EffectScope(const EffectScope&) = delete;
  EffectScope& operator=(const EffectScope&) = delete;

 private:
  std::string previous_;
};

}  // namespace seascape
