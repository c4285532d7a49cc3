#include "platform/xr_api.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <openxr/openxr_reflection.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace seascape {

namespace {

template <class Function>
bool find(PFN_xrGetInstanceProcAddr get, XrInstance instance, const char* name, Function& function) {
  PFN_xrVoidFunction found = nullptr;
  if (XR_FAILED(get(instance, name, &found))) found = nullptr;
  function = reinterpret_cast<Function>(found);
  return found != nullptr;
}

template <class Function>
void need(PFN_xrGetInstanceProcAddr get, XrInstance instance, const char* name, Function& function) {
  if (!find(get, instance, name, function))
    throw Error("OpenXR", fmt::format("the runtime has no {}", name), "update the headset's runtime");
}

}  // namespace

XrApi xr_api(PFN_xrGetInstanceProcAddr get) {
  XrApi api;
  api.GetInstanceProcAddr = get;
  need(get, XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties", api.EnumerateInstanceExtensionProperties);
  need(get, XR_NULL_HANDLE, "xrCreateInstance", api.CreateInstance);
  return api;
}

void load_instance(XrApi& api, XrInstance instance) {
#define SEASCAPE_XR_NEED(name) need(api.GetInstanceProcAddr, instance, "xr" #name, api.name);
#define SEASCAPE_XR_FIND(name) find(api.GetInstanceProcAddr, instance, "xr" #name, api.name);
  SEASCAPE_XR_CORE(SEASCAPE_XR_NEED)
  SEASCAPE_XR_VULKAN(SEASCAPE_XR_FIND)  // doctor does without
  SEASCAPE_XR_OPTIONAL(SEASCAPE_XR_FIND)
#undef SEASCAPE_XR_NEED
#undef SEASCAPE_XR_FIND
}

XrLoader::XrLoader() {
  setenv("XR_LOADER_DEBUG", "none", 0);  // it tells each fault in four lines; ours tells it in one
  library_ = dlopen("libopenxr_loader.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr)
    throw Error("OpenXR", "its loader is not installed",
                "apt-get install libopenxr-loader1 and the headset's runtime, or take --display window");
  get_ = reinterpret_cast<PFN_xrGetInstanceProcAddr>(dlsym(library_, "xrGetInstanceProcAddr"));
  if (get_ != nullptr) return;
  dlclose(library_);
  throw Error("OpenXR", "libopenxr_loader.so.1 has no xrGetInstanceProcAddr", "install libopenxr-loader1 anew");
}

XrLoader::~XrLoader() { dlclose(library_); }

std::string xr_result_name(XrResult result) {
#define SEASCAPE_XR_NAME(name, value) \
  if (result == value) return #name;
  XR_LIST_ENUM_XrResult(SEASCAPE_XR_NAME)
#undef SEASCAPE_XR_NAME
      return fmt::format("result {}", int(result));
}

HeadsetLost::HeadsetLost(const std::string& call)
    : Error("OpenXR", "the headset's runtime is gone" + (call.empty() ? "" : " (seen in " + call + ")"),
            "start it again, then seascape") {}

SessionLost::SessionLost(const std::string& call)
    : Error("OpenXR", call + " failed: XR_ERROR_SESSION_LOST", "start the headset's runtime anew, then seascape") {}

XrResult check_xr(XrResult result, const char* call) {
  if (XR_SUCCEEDED(result)) return result;
  if (result == XR_ERROR_INSTANCE_LOST) throw HeadsetLost(call);
  if (result == XR_ERROR_SESSION_LOST) throw SessionLost(call);
  throw Error("OpenXR", fmt::format("{} failed: {}", call, xr_result_name(result)),
              "run `seascape doctor`, start the headset's runtime anew, or take --display window");
}

}  // namespace seascape
