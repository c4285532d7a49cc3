#include "engine/device.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "engine/address_space.h"
#include "engine/driver_files.h"
#include "engine/error.h"

namespace seascape {

const char* result_name(VkResult result) {
  switch (result) {
    case VK_SUCCESS:
      return "success";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "initialization failed";
    case VK_ERROR_DEVICE_LOST:
      return "device lost";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "layer not present";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "extension not present";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "feature not present";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no driver found";
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      return "format not supported";
    case VK_ERROR_SURFACE_LOST_KHR:
      return "surface lost";
    case VK_ERROR_OUT_OF_DATE_KHR:
      return "swapchain out of date";
    default:
      return "unknown result";
  }
}

VkResult check(VkResult result, const char* call) {
  if (result >= 0) return result;
  const char* remedy = result == VK_ERROR_DEVICE_LOST
                           ? "the driver gave up on this process: start again, and try --set msaa=1 or a lower --preset"
                       : result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY
                           ? "close other programs, or choose a smaller --size, fewer msaa samples or a lower --preset"
                           : "run `seascape doctor` to see devices and drivers";
  throw Error("Vulkan", fmt::format("{} failed: {} ({})", call, result_name(result), int(result)), remedy);
}

static void expect_driver_files() {
  const std::string fault = driver_files_fault();
  if (!fault.empty())
    throw Error("Vulkan", "no driver answers: " + fault,
                "correct or unset the variable, or install mesa-vulkan-drivers or your GPU's driver");
}

[[noreturn]] static void throw_no_driver() {
  throw Error("Vulkan", "no driver answers", "install mesa-vulkan-drivers or your GPU's driver");
}

// A software driver allocates and frees some 12 MB a frame. What glibc gives back to the system in between costs a page
// fault, and a page to clear, for every 4 KiB of the next frame: 3,000 a frame of open_sea (docs/performance.md).
static void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest it takes
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
#endif
}

VkBool32 Device::on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& device = *static_cast<Device*>(user);
  std::lock_guard lock(device.message_mutex_);
  device.messages_.emplace_back(data->pMessage ? data->pMessage : "");
  spdlog::error("validation: {}", device.messages_.back());
  return VK_FALSE;
}

Device::Device(const DeviceOptions& options) {
  expect_address_space();
  try {
    create_instance(options);
    choose_physical(options);
    create_device(options);
    memory_ = std::make_unique<Memory>(*this, options.memory_holds);
  } catch (...) {
    give_back();
    throw;
  }
  spdlog::debug("device: {} ({}, Vulkan {})", facts_.name, facts_.driver, facts_.api_version);
}

void Device::create_instance(const DeviceOptions& options) {
  std::uint32_t count = 0;
  vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> available(count);
  vkEnumerateInstanceExtensionProperties(nullptr, &count, available.data());
  std::vector<const char*> extensions;
  for (const std::string& name : options.instance_extensions) extensions.push_back(name.c_str());
  const bool has_debug_utils = std::any_of(available.begin(), available.end(), [](const VkExtensionProperties& e) {
    return std::strcmp(e.extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0;
  });
  debug_utils_ = has_debug_utils && !options.core_only;
  if (options.validation) debug_utils_ = true;
  if (debug_utils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "seascape";
  application.apiVersion = VK_API_VERSION_1_1;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  const char* layer = "VK_LAYER_KHRONOS_validation";
  const VkValidationFeatureEnableEXT enables[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = enables;
  VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  messenger.pfnUserCallback = on_message;
  messenger.pUserData = this;
  if (options.validation) {
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.pNext = &features;
    features.pNext = &messenger;
  }
  info.enabledExtensionCount = std::uint32_t(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = options.create_instance ? options.create_instance(info, &instance_)
                                                  : vkCreateInstance(&info, nullptr, &instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER || result == VK_ERROR_OUT_OF_HOST_MEMORY) expect_driver_files();
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) throw_no_driver();
  if (result == VK_ERROR_LAYER_NOT_PRESENT)
    throw Error("Vulkan", "the validation layer is not installed", "apt-get install vulkan-validationlayers");
  check(result, "vkCreateInstance");
  if (options.validation) {
    auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
  }
}

VkPhysicalDevice best_physical(VkInstance instance) {
  std::uint32_t count = 0;
  const VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  if (result >= 0) vkEnumeratePhysicalDevices(instance, &count, devices.data());
  const char* wanted = std::getenv("SEASCAPE_DEVICE");
  std::string seen;
  int best_rank = -1;
  VkPhysicalDevice best = VK_NULL_HANDLE;
  for (VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties p;
    vkGetPhysicalDeviceProperties(device, &p);
    seen += fmt::format("{}'{}'", seen.empty() ? "" : ", ", p.deviceName);
    if (p.apiVersion < VK_API_VERSION_1_1) continue;
    if (wanted && !std::strstr(p.deviceName, wanted)) continue;
    const int rank = p.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU     ? 4
                     : p.deviceType == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU ? 3
                     : p.deviceType == VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU    ? 2
                                                                              : 1;
    if (rank > best_rank) {
      best_rank = rank;
      best = device;
    }
  }
  if (!best) {
    if (count == 0) expect_driver_files();
    if (count == 0) throw_no_driver();
    throw Error(
        "Vulkan",
        fmt::format("no device with Vulkan 1.1{} among {}", wanted ? fmt::format(" named '{}'", wanted) : "", seen),
        wanted ? "unset SEASCAPE_DEVICE" : "install a newer driver");
  }
  return best;
}

void Device::choose_physical(const DeviceOptions& options) {
  physical_ = options.choose_physical ? options.choose_physical(instance_) : best_physical(instance_);
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 p2{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  vkGetPhysicalDeviceProperties(physical_, &p2.properties);
  if (p2.properties.apiVersion >= VK_API_VERSION_1_2 && !options.core_only) {
    p2.pNext = &driver;
    vkGetPhysicalDeviceProperties2(physical_, &p2);
  }
  const VkPhysicalDeviceProperties& p = p2.properties;
  if (p.apiVersion < VK_API_VERSION_1_1)
    throw Error(p.deviceName, "the device lacks Vulkan 1.1", "install a newer driver");
  facts_.name = p.deviceName;
  facts_.driver = driver.driverInfo[0] ? fmt::format("{} {}", driver.driverName, driver.driverInfo)
                                       : fmt::format("version {:#x}", p.driverVersion);
  facts_.api_version = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(p.apiVersion), VK_API_VERSION_MINOR(p.apiVersion),
                                   VK_API_VERSION_PATCH(p.apiVersion));
  facts_.software = p.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  if (facts_.software) keep_freed_memory();
  facts_.kind = facts_.software                                          ? "software"
                : p.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU   ? "discrete"
                : p.deviceType == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU ? "integrated"
                                                                         : "other";
  facts_.timestamp_period_ns = double(p.limits.timestampPeriod);
  facts_.max_workgroup = options.core_only ? 128 : p.limits.maxComputeWorkGroupInvocations;
  facts_.shared_memory = options.core_only ? 16384 : p.limits.maxComputeSharedMemorySize;
  facts_.sampled_images = options.core_only ? 16 : p.limits.maxPerStageDescriptorSampledImages;
  facts_.uniform_alignment = options.core_only ? 256 : std::uint32_t(p.limits.minUniformBufferOffsetAlignment);
  const VkSampleCountFlags samples = p.limits.framebufferColorSampleCounts & p.limits.framebufferDepthSampleCounts;
  facts_.sample_counts = samples | 1u;
  for (int s : {2, 4, 8})
    if (samples & VkSampleCountFlags(s)) facts_.max_samples = s;
  VkFormatProperties format;
  vkGetPhysicalDeviceFormatProperties(physical_, VK_FORMAT_R32G32B32A32_SFLOAT, &format);
  facts_.float32_linear =
      (format.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) && !options.core_only;
  vkGetPhysicalDeviceFormatProperties(physical_, facts_.depth_format, &format);
  VkFormatProperties both;
  vkGetPhysicalDeviceFormatProperties(physical_, facts_.depth_stencil_format, &both);
  if (!(both.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT))
    facts_.depth_stencil_format = VK_FORMAT_D24_UNORM_S8_UINT;
  facts_.depth_linear =
      (format.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) && !options.core_only;
}

static bool has_extensions(VkPhysicalDevice physical, std::span<const char* const> wanted) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> available(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, available.data());
  return std::all_of(wanted.begin(), wanted.end(), [&](const char* name) {
    return std::any_of(available.begin(), available.end(),
                       [&](const VkExtensionProperties& one) { return std::strcmp(one.extensionName, name) == 0; });
  });
}

void Device::create_device(const DeviceOptions& options) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  const VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  bool found = false;
  for (std::uint32_t i = 0; i < count && !found; ++i)
    if ((families[i].queueFlags & wanted) == wanted) {
      queue_family_ = i;
      found = true;
      facts_.timestamps = families[i].timestampValidBits > 0 && !options.core_only;
    }
  if (!found) throw Error(facts_.name, "the device has no queue for both graphics and compute", "use another device");

  VkPhysicalDeviceMultiviewFeatures multiview{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES};
  VkPhysicalDeviceFeatures2 has{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  has.pNext = &multiview;
  vkGetPhysicalDeviceFeatures2(physical_, &has);
  if (!multiview.multiview)
    throw Error(facts_.name, "the driver lacks multiview, which Vulkan 1.1 demands", "install a newer driver");
  VkPhysicalDeviceFeatures2 use{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceMultiviewFeatures use_multiview{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES};
  use_multiview.multiview = VK_TRUE;
  use.pNext = &use_multiview;
  if (!options.core_only) {
    use.features.samplerAnisotropy = has.features.samplerAnisotropy;
    use.features.fillModeNonSolid = has.features.fillModeNonSolid;
    use.features.vertexPipelineStoresAndAtomics = has.features.vertexPipelineStoresAndAtomics;
    use.features.sampleRateShading = has.features.sampleRateShading;
    use.features.shaderClipDistance = has.features.shaderClipDistance;
    use.features.textureCompressionBC = has.features.textureCompressionBC;
  }
  facts_.wireframe = use.features.fillModeNonSolid;
  facts_.vertex_stores = use.features.vertexPipelineStoresAndAtomics;
  facts_.sample_shading = use.features.sampleRateShading;
  facts_.clip_distances = use.features.shaderClipDistance;
  facts_.block_textures = use.features.textureCompressionBC;
  if (use.features.samplerAnisotropy) {
    VkPhysicalDeviceProperties p;
    vkGetPhysicalDeviceProperties(physical_, &p);
    facts_.max_anisotropy = p.limits.maxSamplerAnisotropy;
    // Mesa's software driver: 22.3 never returns from an anisotropic lookup in a multisampled pass, and 25.0.7 gives
    // the same pictures, to the bit, whatever the anisotropy (both seen). Shaders must know what they get.
    if (facts_.software && facts_.driver.find("Mesa ") != std::string::npos) facts_.max_anisotropy = 1.0f;
  }
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  std::vector<const char*> extensions;
  if (options.present) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  constexpr const char* resolves_depth[] = {VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME,
                                            VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME};
  facts_.depth_resolve = options.show_depth && !options.core_only && has_extensions(physical_, resolves_depth);
  if (facts_.depth_resolve) extensions.insert(extensions.end(), std::begin(resolves_depth), std::end(resolves_depth));
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &use;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = std::uint32_t(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = options.create_device ? options.create_device(physical_, info, &device_)
                                                : vkCreateDevice(physical_, &info, nullptr, &device_);
  if (result == VK_ERROR_EXTENSION_NOT_PRESENT)
    throw Error(facts_.name, "the driver cannot present to a window", "use --display headless or another device");
  check(result, "vkCreateDevice");
  vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
  if (debug_utils_) {
    set_name_ = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
        vkGetInstanceProcAddr(instance_, "vkSetDebugUtilsObjectNameEXT"));
    begin_label_ = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(instance_, "vkCmdBeginDebugUtilsLabelEXT"));
    end_label_ = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
        vkGetInstanceProcAddr(instance_, "vkCmdEndDebugUtilsLabelEXT"));
  }
  if (facts_.depth_resolve)
    create_render_pass_2_ =
        reinterpret_cast<PFN_vkCreateRenderPass2KHR>(vkGetDeviceProcAddr(device_, "vkCreateRenderPass2KHR"));
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = queue_family_;
  pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  check(vkCreateCommandPool(device_, &pool, nullptr, &now_pool_), "vkCreateCommandPool");
  cache_ = options.cache;
  load_pipeline_cache();
}

Device::~Device() { give_back(); }

void Device::give_back() {
  if (device_) vkDeviceWaitIdle(device_);
  while (!retired_.empty()) {
    destroy(retired_.front());
    retired_.pop_front();
  }
  for (auto& [key, pass] : render_passes_) vkDestroyRenderPass(device_, pass, nullptr);
  if (now_pool_) vkDestroyCommandPool(device_, now_pool_, nullptr);
  if (pipeline_cache_) {
    keep_pipeline_cache();
    vkDestroyPipelineCache(device_, pipeline_cache_, nullptr);
  }
  memory_.reset();
  if (device_) vkDestroyDevice(device_, nullptr);
  if (messenger_) {
    auto destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy_messenger(instance_, messenger_, nullptr);
  }
  if (instance_) vkDestroyInstance(instance_, nullptr);
}

void Device::wait_for_gpu() noexcept {
  const std::lock_guard lock(queue_mutex_);
  (void)vkDeviceWaitIdle(device_);
}

void Device::wait_idle() {
  {
    const std::lock_guard lock(queue_mutex_);
    check(vkDeviceWaitIdle(device_), "vkDeviceWaitIdle");
  }
  frames_finished_to(~std::uint64_t{0});
}

std::vector<std::string> Device::validation_messages() const {
  std::lock_guard lock(message_mutex_);
  return messages_;
}

void Device::clear_validation_messages() {
  std::lock_guard lock(message_mutex_);
  messages_.clear();
}

VkCommandBuffer Device::begin_now() {
  VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  info.commandPool = now_pool_;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &info, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  return commands;
}

void Device::end_now(VkCommandBuffer commands) {
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  VkFence fence = VK_NULL_HANDLE;
  check(vkCreateFence(device_, &info, nullptr, &fence), "vkCreateFence");
  VkResult result = VK_SUCCESS;
  {
    const std::lock_guard lock(queue_mutex_);
    result = vkQueueSubmit(queue_, 1, &submit, fence);
  }
  const char* failed = "vkQueueSubmit";
  if (result == VK_SUCCESS) {
    failed = "vkWaitForFences";
    result = vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX);
  }
  vkDestroyFence(device_, fence, nullptr);
  check(result, failed);
  vkFreeCommandBuffers(device_, now_pool_, 1, &commands);
}

void Device::debug_name(VkObjectType type, std::uint64_t handle, const char* name) {
  // Mesa 22.3 takes a surface for one of its device's objects and crashes when it is named.
  if (!set_name_ || type == VK_OBJECT_TYPE_SURFACE_KHR) return;
  VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = name;
  set_name_(device_, &info);
}

void Device::label_begin(VkCommandBuffer commands, const char* name) const {
  if (!begin_label_) return;
  VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
  label.pLabelName = name;
  begin_label_(commands, &label);
}

void Device::label_end(VkCommandBuffer commands) const {
  if (end_label_) end_label_(commands);
}

}  // namespace seascape
