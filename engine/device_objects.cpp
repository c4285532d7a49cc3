// What a device has made: each object recorded with its effect, and destroyed when the GPU is done with it.
#include "engine/device.h"

namespace seascape {

namespace {
thread_local std::string effect_now = "frame";  // what is made on this thread is for
}  // namespace

namespace detail {

void adopt(Device& device, VkObjectType type, std::uint64_t handle, std::string_view name, std::uint64_t bytes,
           MadeWith made_with) {
  const std::string whole(name);
  {
    const std::lock_guard lock(device.mutex_);
    const std::uint64_t number = ++device.created_;
    device.creation_[{type, handle}] = number;
    device.records_[number] = {type, handle, bytes, whole, effect_now, std::move(made_with)};
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

namespace {

// A pass of one subpass in the words of VK_KHR_create_renderpass2, with the resolve of its depth besides.
VkResult create_resolving_pass(VkDevice device, PFN_vkCreateRenderPass2KHR create, const VkRenderPassCreateInfo& info,
                               const VkAttachmentReference& depth_resolve, VkRenderPass* pass) {
  const VkSubpassDescription& of = info.pSubpasses[0];
  const auto* multiview = static_cast<const VkRenderPassMultiviewCreateInfo*>(info.pNext);
  std::vector<VkAttachmentDescription2> attachments;
  for (std::uint32_t i = 0; i < info.attachmentCount; ++i) {
    const VkAttachmentDescription& a = info.pAttachments[i];
    attachments.push_back({VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2, nullptr, a.flags, a.format, a.samples, a.loadOp,
                           a.storeOp, a.stencilLoadOp, a.stencilStoreOp, a.initialLayout, a.finalLayout});
  }
  const auto reference = [](const VkAttachmentReference& r, VkImageAspectFlags aspect) {
    return VkAttachmentReference2{VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2, nullptr, r.attachment, r.layout, aspect};
  };
  std::vector<VkAttachmentReference2> colours, resolves;
  for (std::uint32_t i = 0; i < of.colorAttachmentCount; ++i) {
    colours.push_back(reference(of.pColorAttachments[i], VK_IMAGE_ASPECT_COLOR_BIT));
    if (of.pResolveAttachments) resolves.push_back(reference(of.pResolveAttachments[i], VK_IMAGE_ASPECT_COLOR_BIT));
  }
  const VkAttachmentReference2 depth = reference(*of.pDepthStencilAttachment, VK_IMAGE_ASPECT_DEPTH_BIT);
  const VkAttachmentReference2 resolved = reference(depth_resolve, VK_IMAGE_ASPECT_DEPTH_BIT);
  VkSubpassDescriptionDepthStencilResolve resolve{VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE};
  resolve.depthResolveMode = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT;  // which every device has
  resolve.pDepthStencilResolveAttachment = &resolved;
  VkSubpassDescription2 subpass{VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2};
  subpass.pNext = &resolve;
  subpass.pipelineBindPoint = of.pipelineBindPoint;
  subpass.viewMask = multiview ? multiview->pViewMasks[0] : 0;
  subpass.colorAttachmentCount = of.colorAttachmentCount;
  subpass.pColorAttachments = colours.data();
  subpass.pResolveAttachments = resolves.empty() ? nullptr : resolves.data();
  subpass.pDepthStencilAttachment = &depth;
  VkRenderPassCreateInfo2 info2{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2};
  info2.attachmentCount = info.attachmentCount;
  info2.pAttachments = attachments.data();
  info2.subpassCount = 1;
  info2.pSubpasses = &subpass;
  info2.correlatedViewMaskCount = multiview ? multiview->correlationMaskCount : 0;
  info2.pCorrelatedViewMasks = multiview ? multiview->pCorrelationMasks : nullptr;
  return create(device, &info2, nullptr, pass);
}

}  // namespace

template <class Create>
VkRenderPass Device::cached(const std::string& key, const Create& create) {
  const std::lock_guard lock(mutex_);
  if (const auto found = render_passes_.find(key); found != render_passes_.end()) return found->second;
  VkRenderPass pass = VK_NULL_HANDLE;
  check(create(&pass), "vkCreateRenderPass");
  render_passes_.emplace(key, pass);
  debug_name(VK_OBJECT_TYPE_RENDER_PASS, std::uint64_t(pass), key.c_str());
  return pass;
}

VkRenderPass Device::cached_render_pass(const std::string& key, const VkRenderPassCreateInfo& info) {
  return cached(key, [&](VkRenderPass* pass) { return vkCreateRenderPass(device_, &info, nullptr, pass); });
}

VkRenderPass Device::cached_render_pass(const std::string& key, const VkRenderPassCreateInfo& info,
                                        const VkAttachmentReference& depth_resolve) {
  return cached(key, [&](VkRenderPass* pass) {
    return create_resolving_pass(device_, create_render_pass_2_, info, depth_resolve, pass);
  });
}

}  // namespace seascape
