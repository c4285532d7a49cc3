// The connection to a headset's runtime: which it is, what it offers, and how the device is made for it.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/device.h"
#include "platform/xr_api.h"

namespace seascape {

// What a runtime and its headset say of themselves.
struct HeadsetFacts {
  std::string runtime, runtime_version, headset;
  std::vector<std::string> extensions;  // all that the runtime has
  std::uint32_t width = 0, height = 0;  // recommended, pixels an eye
  std::uint32_t most_width = 0, most_height = 0;
  std::uint32_t views = 0;
  bool sees_hands = false;  // that hold no controllers, joint by joint

  bool has(std::string_view extension) const;
};

// The extensions that are used where a runtime has them, XR_KHR_vulkan_enable2 besides.
std::vector<std::string_view> headset_extensions();

// Made before the device, which has to be made for it.
class HeadsetSystem {
 public:
  // `get`: of the loader, or of a runtime that stands in for one. `next`: handed to xrCreateInstance. Throws Error
  // where there is no runtime, no headset, or one that the program cannot draw for.
  explicit HeadsetSystem(PFN_xrGetInstanceProcAddr get, const void* next = nullptr);
  ~HeadsetSystem();
  HeadsetSystem(const HeadsetSystem&) = delete;
  HeadsetSystem& operator=(const HeadsetSystem&) = delete;

  // Has a device made by the runtime. This must outlive it.
  void make_device(DeviceOptions& options);

  const XrApi& api() const { return api_; }
  XrInstance instance() const { return instance_; }
  XrSystemId id() const { return id_; }
  const HeadsetFacts& facts() const { return facts_; }
  // Whether an extension is in use: the runtime has it, and it was asked for.
  bool uses(std::string_view extension) const;
  XrPath path(const std::string& text) const;

 private:
  void create_instance(const void* next);
  void find_system();
  XrApi api_;
  XrInstance instance_ = XR_NULL_HANDLE;
  XrSystemId id_ = XR_NULL_SYSTEM_ID;
  HeadsetFacts facts_;
  std::vector<std::string> used_;
};

// A session of a device that was made for it, whose queue must be still meanwhile (Device::queue_mutex). Whoever asks
// gives it back by xrDestroySession. Throws Error.
XrSession make_session(const HeadsetSystem& system, const Device& device);

// The pictures a second that the headset can be switched to; empty where it does not say. The device was made for it.
std::vector<float> headset_rates(const HeadsetSystem& system, const Device& device);

}  // namespace seascape
