// The simulated runtime's calls of OpenXR that are about the instance, its system and the device.
#include <algorithm>

#include "engine/device.h"
#include "platform/simulated_state.h"

namespace seascape::simulated {

namespace {

using State = SimulatedRuntime::State;

State& state(XrInstance instance) { return object<State>(instance); }

constexpr const char* offered[] = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME, XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
                                   XR_EXT_LOCAL_FLOOR_EXTENSION_NAME,    XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME,
                                   XR_EXT_USER_PRESENCE_EXTENSION_NAME,  XR_KHR_VISIBILITY_MASK_EXTENSION_NAME,
                                   XR_EXT_HAND_TRACKING_EXTENSION_NAME,  "XR_META_touch_controller_plus"};

XRAPI_ATTR XrResult XRAPI_CALL enumerate_extensions(const char*, std::uint32_t room, std::uint32_t* count,
                                                    XrExtensionProperties* to) {
  std::vector<XrExtensionProperties> all;
  for (const char* name : offered) {
    all.push_back({XR_TYPE_EXTENSION_PROPERTIES});
    std::strcpy(all.back().extensionName, name);
    all.back().extensionVersion = 1;
  }
  return hand_out<XrExtensionProperties>(all, room, count, to);
}

XRAPI_ATTR XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info, XrInstance* made) {
  const auto* next = static_cast<const State::Next*>(info->next);
  if (next == nullptr || next->state->instance) return XR_ERROR_INITIALIZATION_FAILED;
  for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i)
    if (std::none_of(std::begin(offered), std::end(offered),
                     [&](const char* name) { return std::strcmp(name, info->enabledExtensionNames[i]) == 0; }))
      return XR_ERROR_EXTENSION_NOT_PRESENT;
  next->state->instance = true;
  *made = handle<XrInstance>(next->state);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_instance(XrInstance instance) {
  state(instance).instance = false;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL get_instance_properties(XrInstance, XrInstanceProperties* properties) {
  std::strcpy(properties->runtimeName, "Seascape's simulated runtime");
  properties->runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL poll_event(XrInstance instance, XrEventDataBuffer* event) {
  auto& events = state(instance).events;
  if (events.empty()) return XR_EVENT_UNAVAILABLE;
  *event = events.front();
  events.pop_front();
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL get_system(XrInstance, const XrSystemGetInfo* info, XrSystemId* id) {
  if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY) return XR_ERROR_FORM_FACTOR_UNSUPPORTED;
  *id = 1;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL get_system_properties(XrInstance instance, XrSystemId id,
                                                     XrSystemProperties* properties) {
  properties->systemId = id;
  std::strcpy(properties->systemName, "a simulated headset");
  properties->graphicsProperties = {16384, 16384, 16};
  properties->trackingProperties = {XR_TRUE, XR_TRUE};
  if (auto* hands = static_cast<XrSystemHandTrackingPropertiesEXT*>(properties->next);
      hands && hands->type == XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT)
    hands->supportsHandTracking = state(instance).sees_hands();
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL enumerate_blend_modes(XrInstance, XrSystemId, XrViewConfigurationType,
                                                     std::uint32_t room, std::uint32_t* count,
                                                     XrEnvironmentBlendMode* to) {
  const std::array all{XR_ENVIRONMENT_BLEND_MODE_OPAQUE};
  return hand_out<XrEnvironmentBlendMode>(all, room, count, to);
}

XRAPI_ATTR XrResult XRAPI_CALL enumerate_view_configurations(XrInstance, XrSystemId, std::uint32_t room,
                                                             std::uint32_t* count, XrViewConfigurationType* to) {
  const std::array all{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
  return hand_out<XrViewConfigurationType>(all, room, count, to);
}

XRAPI_ATTR XrResult XRAPI_CALL enumerate_views(XrInstance instance, XrSystemId, XrViewConfigurationType type,
                                               std::uint32_t room, std::uint32_t* count, XrViewConfigurationView* to) {
  if (type != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
  const InputScript& script = state(instance).options.script;
  XrViewConfigurationView view{XR_TYPE_VIEW_CONFIGURATION_VIEW};
  view.recommendedImageRectWidth = std::uint32_t(script.width);
  view.recommendedImageRectHeight = std::uint32_t(script.height);
  view.maxImageRectWidth = view.maxImageRectHeight = 16384;
  view.recommendedSwapchainSampleCount = view.maxSwapchainSampleCount = 1;
  const std::array all{view, view};
  return hand_out<XrViewConfigurationView>(all, room, count, to);
}

XRAPI_ATTR XrResult XRAPI_CALL string_to_path(XrInstance instance, const char* text, XrPath* path) {
  auto& paths = state(instance).paths;
  if (text[0] != '/') return XR_ERROR_PATH_FORMAT_INVALID;
  const auto found = std::find(paths.begin(), paths.end(), text);
  *path = XrPath(found - paths.begin()) + 1;
  if (found == paths.end()) paths.emplace_back(text);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL path_to_string(XrInstance instance, XrPath path, std::uint32_t room,
                                              std::uint32_t* count, char* to) {
  const auto& paths = state(instance).paths;
  if (path == XR_NULL_PATH || path > paths.size()) return XR_ERROR_PATH_INVALID;
  const std::string& text = paths[std::size_t(path) - 1];
  return hand_out<char>({text.c_str(), text.size() + 1}, room, count, to);
}

XRAPI_ATTR XrResult XRAPI_CALL get_graphics_requirements(XrInstance, XrSystemId,
                                                         XrGraphicsRequirementsVulkanKHR* needs) {
  needs->minApiVersionSupported = XR_MAKE_VERSION(1, 0, 0);
  needs->maxApiVersionSupported = XR_MAKE_VERSION(1, 4, 0);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL create_vulkan_instance(XrInstance, const XrVulkanInstanceCreateInfoKHR* info,
                                                      VkInstance* made, VkResult* result) {
  *result = vkCreateInstance(info->vulkanCreateInfo, info->vulkanAllocator, made);
  return XR_SUCCESS;
}

// The device's own choice is as good as any: there is no screen.
XRAPI_ATTR XrResult XRAPI_CALL get_graphics_device(XrInstance, const XrVulkanGraphicsDeviceGetInfoKHR* info,
                                                   VkPhysicalDevice* physical) {
  *physical = best_physical(info->vulkanInstance);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL create_vulkan_device(XrInstance, const XrVulkanDeviceCreateInfoKHR* info, VkDevice* made,
                                                    VkResult* result) {
  *result = vkCreateDevice(info->vulkanPhysicalDevice, info->vulkanCreateInfo, info->vulkanAllocator, made);
  return XR_SUCCESS;
}

}  // namespace

PFN_xrVoidFunction instance_call(std::string_view name) {
  SEASCAPE_SIMULATED(EnumerateInstanceExtensionProperties, enumerate_extensions)
  SEASCAPE_SIMULATED(CreateInstance, create_instance)
  SEASCAPE_SIMULATED(DestroyInstance, destroy_instance)
  SEASCAPE_SIMULATED(GetInstanceProperties, get_instance_properties)
  SEASCAPE_SIMULATED(PollEvent, poll_event)
  SEASCAPE_SIMULATED(GetSystem, get_system)
  SEASCAPE_SIMULATED(GetSystemProperties, get_system_properties)
  SEASCAPE_SIMULATED(EnumerateEnvironmentBlendModes, enumerate_blend_modes)
  SEASCAPE_SIMULATED(EnumerateViewConfigurations, enumerate_view_configurations)
  SEASCAPE_SIMULATED(EnumerateViewConfigurationViews, enumerate_views)
  SEASCAPE_SIMULATED(StringToPath, string_to_path)
  SEASCAPE_SIMULATED(PathToString, path_to_string)
  SEASCAPE_SIMULATED(GetVulkanGraphicsRequirements2KHR, get_graphics_requirements)
  SEASCAPE_SIMULATED(CreateVulkanInstanceKHR, create_vulkan_instance)
  SEASCAPE_SIMULATED(GetVulkanGraphicsDevice2KHR, get_graphics_device)
  SEASCAPE_SIMULATED(CreateVulkanDeviceKHR, create_vulkan_device)
  return nullptr;
}

}  // namespace seascape::simulated
