// What a device has made: each object recorded with its effect, and destroyed when the GPU is done with it.
#include "engine/device.h"

namespace seascape {

namespace {
thread_local std::string effect_now = "frame";  // what is made on this thread is for
}  // namespace

namespace detail {

void adopt(Device& device, VkObjectType type, std::uint64_t handle, std::string_view name, std::uint64_t bytes) {
  const std::string whole(name);
  {
    const std::lock_guard lock(device.mutex_);
    const std::uint64_t number = ++device.created_;
    device.creation_[{type, handle}] = number;
    device.records_[number] = {type, handle, bytes, whole, effect_now};
  }
  if (type == VK_OBJECT_TYPE_PIPELINE) ++device.pipelines_made_;
  device.debug_name(type, handle, whole.c_str());
}

void retire(Device& device, VkObjectType type, std::uint64_t handle) {
  const std::lock_guard lock(device.mutex_);
  if (auto found = device.creation_.find({type, handle}); found != device.creation_.end()) {
    device.records_.erase(found->second);
    device.creation_.erase(found);
  }
  device.retired_.push_back({device.frame_number_, type, handle, 0});
}

}  // namespace detail

EffectScope::EffectScope(Device&, std::string_view effect) : previous_(effect_now) { effect_now = effect; }

EffectScope::~EffectScope() { effect_now = previous_; }

std::vector<ObjectRecord> Device::objects() const {
  const std::lock_guard lock(mutex_);
  std::vector<ObjectRecord> list;
  for (const auto& [number, record] : records_) list.push_back(record);
  return list;
}

void Device::retire_memory(VkDeviceMemory memory, VkDeviceSize offset) {
  const std::lock_guard lock(mutex_);
  retired_.push_back({frame_number_, VK_OBJECT_TYPE_DEVICE_MEMORY, std::uint64_t(memory), offset});
}

void Device::frames_finished_to(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  while (!retired_.empty() && retired_.front().frame <= number) {
    destroy(retired_.front());
    retired_.pop_front();
  }
}

void Device::destroy(const Retired& object) {
  const std::uint64_t h = object.handle;
  switch (object.type) {
    case VK_OBJECT_TYPE_DEVICE_MEMORY:
      memory_->free(VkDeviceMemory(h), object.offset);
      break;
    case VK_OBJECT_TYPE_BUFFER:
      vkDestroyBuffer(device_, VkBuffer(h), nullptr);
      break;
    case VK_OBJECT_TYPE_IMAGE:
      vkDestroyImage(device_, VkImage(h), nullptr);
      break;
    case VK_OBJECT_TYPE_IMAGE_VIEW:
      vkDestroyImageView(device_, VkImageView(h), nullptr);
      break;
    case VK_OBJECT_TYPE_SAMPLER:
      vkDestroySampler(device_, VkSampler(h), nullptr);
      break;
    case VK_OBJECT_TYPE_SHADER_MODULE:
      vkDestroyShaderModule(device_, VkShaderModule(h), nullptr);
      break;
    case VK_OBJECT_TYPE_PIPELINE:
      vkDestroyPipeline(device_, VkPipeline(h), nullptr);
      break;
    case VK_OBJECT_TYPE_PIPELINE_LAYOUT:
      vkDestroyPipelineLayout(device_, VkPipelineLayout(h), nullptr);
      break;
    case VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT:
      vkDestroyDescriptorSetLayout(device_, VkDescriptorSetLayout(h), nullptr);
      break;
    case VK_OBJECT_TYPE_DESCRIPTOR_POOL:
      vkDestroyDescriptorPool(device_, VkDescriptorPool(h), nullptr);
      break;
    case VK_OBJECT_TYPE_RENDER_PASS:
      vkDestroyRenderPass(device_, VkRenderPass(h), nullptr);
      break;
    case VK_OBJECT_TYPE_FRAMEBUFFER:
      vkDestroyFramebuffer(device_, VkFramebuffer(h), nullptr);
      break;
    case VK_OBJECT_TYPE_COMMAND_POOL:
      vkDestroyCommandPool(device_, VkCommandPool(h), nullptr);
      break;
    case VK_OBJECT_TYPE_FENCE:
      vkDestroyFence(device_, VkFence(h), nullptr);
      break;
    case VK_OBJECT_TYPE_SEMAPHORE:
      vkDestroySemaphore(device_, VkSemaphore(h), nullptr);
      break;
    case VK_OBJECT_TYPE_QUERY_POOL:
      vkDestroyQueryPool(device_, VkQueryPool(h), nullptr);
      break;
    case VK_OBJECT_TYPE_SWAPCHAIN_KHR:
      vkDestroySwapchainKHR(device_, VkSwapchainKHR(h), nullptr);
      break;
    case VK_OBJECT_TYPE_SURFACE_KHR:
      vkDestroySurfaceKHR(instance_, VkSurfaceKHR(h), nullptr);
      break;
    default:
      break;
  }
}

}  // namespace seascape
