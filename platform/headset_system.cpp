#include "platform/headset_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/address_space.h"
#include "platform/bindings.h"

namespace seascape {

namespace {

// Used where the runtime has them. What must be there is asked for by name below.
constexpr const char* wanted[] = {
    XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
    XR_KHR_VISIBILITY_MASK_EXTENSION_NAME,
    XR_EXT_LOCAL_FLOOR_EXTENSION_NAME,
    XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME,
    XR_EXT_USER_PRESENCE_EXTENSION_NAME,
    XR_EXT_PERFORMANCE_SETTINGS_EXTENSION_NAME,
    XR_EXT_HAND_TRACKING_EXTENSION_NAME,
};

}  // namespace

std::vector<std::string_view> headset_extensions() {
  std::vector<std::string_view> all(std::begin(wanted), std::end(wanted));
  for (const ControllerProfile& profile : controller_profiles())
    if (!profile.extension.empty()) all.push_back(profile.extension);
  return all;
}

bool HeadsetFacts::has(std::string_view extension) const {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

HeadsetSystem::HeadsetSystem(PFN_xrGetInstanceProcAddr get, const void* next) : api_(xr_api(get)) {
  expect_address_space();  // it loads a driver
  create_instance(next);
  try {
    load_instance(api_, instance_);
    find_system();
  } catch (...) {
    if (api_.DestroyInstance) api_.DestroyInstance(instance_);
    throw;
  }
}

HeadsetSystem::~HeadsetSystem() { api_.DestroyInstance(instance_); }

void HeadsetSystem::create_instance(const void* next) {
  const auto extensions = [&]() -> std::vector<XrExtensionProperties> {
    XrExtensionProperties blank{XR_TYPE_EXTENSION_PROPERTIES};
    std::uint32_t count = 0;
    const XrResult none = api_.EnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
    if (none == XR_ERROR_RUNTIME_UNAVAILABLE || none == XR_ERROR_RUNTIME_FAILURE)
      throw Error("OpenXR", "no headset runtime answers",
                  "start the headset's runtime (Monado, SteamVR) and see `seascape doctor`, or take --display window");
    return xr_list("xrEnumerateInstanceExtensionProperties", blank,
                   [&](std::uint32_t room, std::uint32_t* found, XrExtensionProperties* to) {
                     return api_.EnumerateInstanceExtensionProperties(nullptr, room, found, to);
                   });
  }();
  for (const XrExtensionProperties& one : extensions)
    facts_.extensions.emplace_back(one.extensionName, strnlen(one.extensionName, sizeof one.extensionName));
  if (!facts_.has(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME))
    throw Error("OpenXR", "the runtime lacks XR_KHR_vulkan_enable2, which shows what Vulkan draws",
                "update the headset's runtime");
  used_ = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME};
  for (const std::string_view name : headset_extensions())
    if (facts_.has(name)) used_.emplace_back(name);
  std::vector<const char*> names;
  for (const std::string& name : used_) names.push_back(name.c_str());
  XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
  info.next = next;
  std::strcpy(info.applicationInfo.applicationName, "Seascape");
  std::strcpy(info.applicationInfo.engineName, "Seascape");
  info.applicationInfo.applicationVersion = info.applicationInfo.engineVersion = 1;
  info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  info.enabledExtensionCount = std::uint32_t(names.size());
  info.enabledExtensionNames = names.data();
  const XrResult result = api_.CreateInstance(&info, &instance_);
  if (result == XR_ERROR_RUNTIME_UNAVAILABLE || result == XR_ERROR_RUNTIME_FAILURE)
    throw Error("OpenXR", fmt::format("the headset's runtime does not answer ({})", xr_result_name(result)),
                "start it (Monado: monado-service) and see `seascape doctor`, or take --display window");
  check_xr(result, "xrCreateInstance");
}

void HeadsetSystem::find_system() {
  XrInstanceProperties runtime{XR_TYPE_INSTANCE_PROPERTIES};
  check_xr(api_.GetInstanceProperties(instance_, &runtime), "xrGetInstanceProperties");
  facts_.runtime = std::string(runtime.runtimeName, strnlen(runtime.runtimeName, sizeof runtime.runtimeName));
  facts_.runtime_version =
      fmt::format("{}.{}.{}", XR_VERSION_MAJOR(runtime.runtimeVersion), XR_VERSION_MINOR(runtime.runtimeVersion),
                  XR_VERSION_PATCH(runtime.runtimeVersion));
  XrSystemGetInfo get{XR_TYPE_SYSTEM_GET_INFO};
  get.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
  const XrResult result = api_.GetSystem(instance_, &get, &id_);
  if (result == XR_ERROR_FORM_FACTOR_UNAVAILABLE || result == XR_ERROR_FORM_FACTOR_UNSUPPORTED)
    throw Error(facts_.runtime, "no headset is connected", "connect it and switch it on, or take --display window");
  check_xr(result, "xrGetSystem");
  XrSystemHandTrackingPropertiesEXT hands{XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT};
  XrSystemProperties system{XR_TYPE_SYSTEM_PROPERTIES};
  if (uses(XR_EXT_HAND_TRACKING_EXTENSION_NAME)) system.next = &hands;
  check_xr(api_.GetSystemProperties(instance_, id_, &system), "xrGetSystemProperties");
  facts_.sees_hands = hands.supportsHandTracking;
  facts_.headset = std::string(system.systemName, strnlen(system.systemName, sizeof system.systemName));

  const auto kinds = xr_list("xrEnumerateViewConfigurations", XrViewConfigurationType{},
                             [&](std::uint32_t room, std::uint32_t* found, XrViewConfigurationType* to) {
                               return api_.EnumerateViewConfigurations(instance_, id_, room, found, to);
                             });
  constexpr XrViewConfigurationType stereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  if (std::find(kinds.begin(), kinds.end(), stereo) == kinds.end())
    throw Error(facts_.headset, "it has no views for two eyes", "take another headset, or --display window");
  const auto views =
      xr_list("xrEnumerateViewConfigurationViews", XrViewConfigurationView{XR_TYPE_VIEW_CONFIGURATION_VIEW},
              [&](std::uint32_t room, std::uint32_t* found, XrViewConfigurationView* to) {
                return api_.EnumerateViewConfigurationViews(instance_, id_, stereo, room, found, to);
              });
  facts_.views = std::uint32_t(views.size());
  if (views.size() != 2)
    throw Error(facts_.headset, fmt::format("it has {} views, not two", views.size()),
                "update the headset's runtime, or take --display window");
  facts_.most_width = facts_.most_height = UINT32_MAX;
  for (const XrViewConfigurationView& view : views) {
    facts_.width = std::max(facts_.width, view.recommendedImageRectWidth);
    facts_.height = std::max(facts_.height, view.recommendedImageRectHeight);
    facts_.most_width = std::min(facts_.most_width, view.maxImageRectWidth);
    facts_.most_height = std::min(facts_.most_height, view.maxImageRectHeight);
  }
  constexpr std::uint32_t largest = 16384;
  facts_.most_width = std::min(facts_.most_width, largest);
  facts_.most_height = std::min(facts_.most_height, largest);
  if (facts_.width == 0 || facts_.height == 0 || facts_.most_width == 0 || facts_.most_height == 0 ||
      facts_.width > largest || facts_.height > largest)
    throw Error(facts_.headset,
                fmt::format("it asks for pictures of {}x{} pixels, at most {}x{}", facts_.width, facts_.height,
                            facts_.most_width, facts_.most_height),
                "update the headset's runtime, or take --display window");
  facts_.width = std::min(facts_.width, facts_.most_width);
  facts_.height = std::min(facts_.height, facts_.most_height);
}

bool HeadsetSystem::uses(std::string_view extension) const {
  return std::find(used_.begin(), used_.end(), extension) != used_.end();
}

XrPath HeadsetSystem::path(const std::string& text) const {
  XrPath path = XR_NULL_PATH;
  check_xr(api_.StringToPath(instance_, text.c_str(), &path), "xrStringToPath");
  return path;
}

void HeadsetSystem::make_device(DeviceOptions& options) {
  if (!api_.GetVulkanGraphicsRequirements2KHR || !api_.CreateVulkanInstanceKHR || !api_.GetVulkanGraphicsDevice2KHR ||
      !api_.CreateVulkanDeviceKHR)
    throw Error("OpenXR", "the runtime lacks functions of XR_KHR_vulkan_enable2", "update the headset's runtime");
  XrGraphicsRequirementsVulkan2KHR needs{XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
  check_xr(api_.GetVulkanGraphicsRequirements2KHR(instance_, id_, &needs), "xrGetVulkanGraphicsRequirements2KHR");
  constexpr XrVersion ours = XR_MAKE_VERSION(1, 1, 0);
  if (needs.minApiVersionSupported > ours || needs.maxApiVersionSupported < ours)
    throw Error(
        facts_.runtime,
        fmt::format("it takes Vulkan {}.{} to {}.{}, and seascape draws with 1.1",
                    XR_VERSION_MAJOR(needs.minApiVersionSupported), XR_VERSION_MINOR(needs.minApiVersionSupported),
                    XR_VERSION_MAJOR(needs.maxApiVersionSupported), XR_VERSION_MINOR(needs.maxApiVersionSupported)),
        "update the headset's runtime");
  options.create_instance = [this](const VkInstanceCreateInfo& vulkan, VkInstance* made) {
    XrVulkanInstanceCreateInfoKHR info{XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
    info.systemId = id_;
    info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
    info.vulkanCreateInfo = &vulkan;
    VkResult result = VK_SUCCESS;
    check_xr(api_.CreateVulkanInstanceKHR(instance_, &info, made, &result), "xrCreateVulkanInstanceKHR");
    return result;
  };
  options.choose_physical = [this](VkInstance vulkan) {
    XrVulkanGraphicsDeviceGetInfoKHR info{XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR};
    info.systemId = id_;
    info.vulkanInstance = vulkan;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    check_xr(api_.GetVulkanGraphicsDevice2KHR(instance_, &info, &physical), "xrGetVulkanGraphicsDevice2KHR");
    if (physical == VK_NULL_HANDLE) throw Error(facts_.runtime, "it names no GPU", "start the headset's runtime anew");
    return physical;
  };
  options.create_device = [this](VkPhysicalDevice physical, const VkDeviceCreateInfo& vulkan, VkDevice* made) {
    XrVulkanDeviceCreateInfoKHR info{XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR};
    info.systemId = id_;
    info.pfnGetInstanceProcAddr = vkGetInstanceProcAddr;
    info.vulkanPhysicalDevice = physical;
    info.vulkanCreateInfo = &vulkan;
    VkResult result = VK_SUCCESS;
    check_xr(api_.CreateVulkanDeviceKHR(instance_, &info, made, &result), "xrCreateVulkanDeviceKHR");
    return result;
  };
  options.show_depth = uses(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
}

XrSession make_session(const HeadsetSystem& system, const Device& device) {
  XrGraphicsBindingVulkan2KHR binding{XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR};
  binding.instance = device.instance();
  binding.physicalDevice = device.physical();
  binding.device = device.handle();
  binding.queueFamilyIndex = device.queue_family();
  XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO};
  info.next = &binding;
  info.systemId = system.id();
  XrSession session = XR_NULL_HANDLE;
  check_xr(system.api().CreateSession(system.instance(), &info, &session), "xrCreateSession");
  return session;
}

std::vector<float> headset_rates(const HeadsetSystem& system, const Device& device) {
  const XrApi& api = system.api();
  if (!system.uses(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME) || !api.EnumerateDisplayRefreshRatesFB) return {};
  const XrSession session = make_session(system, device);
  std::array<float, 64> rates{};
  std::uint32_t count = 0;
  const XrResult result =
      api.EnumerateDisplayRefreshRatesFB(session, std::uint32_t(rates.size()), &count, rates.data());
  api.DestroySession(session);
  check_xr(result, "xrEnumerateDisplayRefreshRatesFB");
  return {rates.begin(), rates.begin() + std::min<std::size_t>(count, rates.size())};
}

}  // namespace seascape
