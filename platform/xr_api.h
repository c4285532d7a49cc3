// OpenXR's functions as they are called here: found at run time, so that nothing of OpenXR is loaded unless a headset
// is asked for.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/vulkan.h"

#define XR_USE_GRAPHICS_API_VULKAN
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

// Newer than Debian 12's headers (OpenXR 1.1, XR_EXT_local_floor, XR_EXT_user_presence), with their fixed numbers.
#ifndef XR_EXT_local_floor
#define XR_EXT_LOCAL_FLOOR_EXTENSION_NAME "XR_EXT_local_floor"
inline constexpr XrReferenceSpaceType XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT = XrReferenceSpaceType(1000426000);
#endif
#ifndef XR_EXT_user_presence
#define XR_EXT_USER_PRESENCE_EXTENSION_NAME "XR_EXT_user_presence"
inline constexpr XrStructureType XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT = XrStructureType(1000470000);
struct XrEventDataUserPresenceChangedEXT {
  XrStructureType type;
  const void* next;
  XrSession session;
  XrBool32 isUserPresent;
};
#endif

// Functions of OpenXR itself, then those of extensions, which are null without theirs.
#define SEASCAPE_XR_CORE(apply)                                                                                       \
  apply(DestroyInstance) apply(GetInstanceProperties) apply(PollEvent) apply(GetSystem) apply(GetSystemProperties)    \
      apply(EnumerateEnvironmentBlendModes) apply(EnumerateViewConfigurations) apply(EnumerateViewConfigurationViews) \
          apply(StringToPath) apply(PathToString) apply(CreateSession) apply(DestroySession) apply(BeginSession)      \
              apply(EndSession) apply(RequestExitSession) apply(EnumerateReferenceSpaces) apply(CreateReferenceSpace) \
                  apply(CreateActionSpace) apply(DestroySpace) apply(LocateSpace) apply(CreateActionSet)              \
                      apply(DestroyActionSet) apply(CreateAction) apply(SuggestInteractionProfileBindings)            \
                          apply(AttachSessionActionSets) apply(GetCurrentInteractionProfile) apply(SyncActions)       \
                              apply(GetActionStateFloat) apply(GetActionStatePose) apply(ApplyHapticFeedback)         \
                                  apply(EnumerateSwapchainFormats) apply(CreateSwapchain) apply(DestroySwapchain)     \
                                      apply(EnumerateSwapchainImages) apply(AcquireSwapchainImage)                    \
                                          apply(WaitSwapchainImage) apply(ReleaseSwapchainImage) apply(WaitFrame)     \
                                              apply(BeginFrame) apply(EndFrame) apply(LocateViews)
#define SEASCAPE_XR_VULKAN(apply)                                                                            \
  apply(GetVulkanGraphicsRequirements2KHR) apply(CreateVulkanInstanceKHR) apply(GetVulkanGraphicsDevice2KHR) \
      apply(CreateVulkanDeviceKHR)
#define SEASCAPE_XR_OPTIONAL(apply)                                                                            \
  apply(GetVisibilityMaskKHR) apply(EnumerateDisplayRefreshRatesFB) apply(GetDisplayRefreshRateFB)             \
      apply(RequestDisplayRefreshRateFB) apply(PerfSettingsSetPerformanceLevelEXT) apply(CreateHandTrackerEXT) \
          apply(DestroyHandTrackerEXT) apply(LocateHandJointsEXT)

namespace seascape {

struct XrApi {
  PFN_xrGetInstanceProcAddr GetInstanceProcAddr = nullptr;
  PFN_xrEnumerateInstanceExtensionProperties EnumerateInstanceExtensionProperties = nullptr;
  PFN_xrCreateInstance CreateInstance = nullptr;
#define SEASCAPE_XR_DECLARE(name) PFN_xr##name name = nullptr;
  SEASCAPE_XR_CORE(SEASCAPE_XR_DECLARE)
  SEASCAPE_XR_VULKAN(SEASCAPE_XR_DECLARE)
  SEASCAPE_XR_OPTIONAL(SEASCAPE_XR_DECLARE)
#undef SEASCAPE_XR_DECLARE
};

// Those that need no instance. Throws Error where one is missing.
XrApi xr_api(PFN_xrGetInstanceProcAddr get);
// The others, of an instance.
void load_instance(XrApi& api, XrInstance instance);

// The loader's library, open for as long as this lives. Throws Error where it is not installed.
class XrLoader {
 public:
  XrLoader();
  ~XrLoader();
  XrLoader(const XrLoader&) = delete;
  XrLoader& operator=(const XrLoader&) = delete;
  PFN_xrGetInstanceProcAddr get() const { return get_; }

 private:
  void* library_ = nullptr;
  PFN_xrGetInstanceProcAddr get_ = nullptr;
};

std::string xr_result_name(XrResult result);

// The runtime is gone, and the instance with it: nothing more can be shown.
class HeadsetLost : public Error {
 public:
  explicit HeadsetLost(const std::string& call);
};

// The session is gone; the runtime may give another.
class SessionLost : public Error {
 public:
  explicit SessionLost(const std::string& call);
};

// Returns a success code. Throws HeadsetLost where the runtime is gone, SessionLost where the session is, Error else.
XrResult check_xr(XrResult result, const char* call);

// A runtime's list: how many there are, then all of them.
template <class T, class Ask>
std::vector<T> xr_list(const char* call, const T& blank, const Ask& ask) {
  std::vector<T> all;
  std::uint32_t count = 0;
  check_xr(ask(0u, &count, static_cast<T*>(nullptr)), call);
  if (count > 4096)
    throw Error("OpenXR", std::string(call) + " counts " + std::to_string(count), "update the headset's runtime");
  all.resize(count, blank);
  if (count > 0) check_xr(ask(count, &count, all.data()), call);
  all.resize(std::min<std::size_t>(count, all.size()));
  return all;
}

}  // namespace seascape
