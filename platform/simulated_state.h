// What the simulated runtime's functions share. OpenXR's handles are pointers to these.
#pragma once
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/view.h"
#include "platform/simulated_runtime.h"
#include "platform/xr_pose.h"

// In a lookup of calls: the function that stands for one, checked against its type.
#define SEASCAPE_SIMULATED(call, function) \
  if (name == "xr" #call) return reinterpret_cast<PFN_xrVoidFunction>(static_cast<PFN_xr##call>(function));

namespace seascape::simulated {

struct Space {
  SimulatedRuntime::State& of;
  enum class Kind { view, local, local_floor, stage, hand } kind;
  int hand = 0;
  Pose offset;
};

struct ActionSet {
  SimulatedRuntime::State& of;
  std::string name;
  bool attached = false;
  bool active = false;  // in the last sync
};

struct Action {
  SimulatedRuntime::State& of;
  const ActionSet& set;
  std::string name;
  XrActionType type;
};

struct SuggestedBinding {
  XrAction action;
  std::string input;  // "/user/hand/left/input/trigger/value"
};

struct HandTracker {
  SimulatedRuntime::State& of;
  int hand;  // 0 left, 1 right
};

struct Swapchain {
  SimulatedRuntime::State& of;
  XrSwapchainCreateInfo info{};
  std::vector<VkImage> images;
  std::vector<VkDeviceMemory> memories;
  std::size_t next = 0;
  std::optional<std::size_t> acquired;  // between acquire and release
  bool waited = false;
  std::optional<std::size_t> released;  // shown by the next xrEndFrame
};

struct Vulkan {
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  std::uint32_t family = 0;
};

void destroy_swapchain(SimulatedRuntime::State& of, Swapchain& gone);
// Brings new images into the layout in which they are lent.
void prepare_images(const Vulkan& vulkan, const Swapchain& swapchain);

// The part of a swapchain's layer as 8-bit RGBA, after all that was submitted before.
Image8 read_layer(const Vulkan& vulkan, const Swapchain& swapchain, const XrSwapchainSubImage& part);
// What an eye sees of the layers of a frame.
Image8 composed_picture(const Vulkan& vulkan, std::span<const XrCompositionLayerBaseHeader* const> layers,
                        std::size_t eye);

// A call of a name, of those that a file of the runtime has; null: not one of them.
PFN_xrVoidFunction instance_call(std::string_view name);
PFN_xrVoidFunction session_call(std::string_view name);
PFN_xrVoidFunction picture_call(std::string_view name);
PFN_xrVoidFunction action_call(std::string_view name);
PFN_xrVoidFunction hand_call(std::string_view name);

// A list as OpenXR hands it out: how many there are, then as many as there is room for.
template <class T>
XrResult hand_out(std::span<const T> all, std::uint32_t room, std::uint32_t* count, T* to) {
  *count = std::uint32_t(all.size());
  if (room == 0) return XR_SUCCESS;
  if (room < all.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  for (std::size_t i = 0; i < all.size(); ++i) to[i] = all[i];
  return XR_SUCCESS;
}

template <class Object, class Handle>
Object& object(Handle handle) {
  return *reinterpret_cast<Object*>(handle);
}
template <class Handle, class Object>
Handle handle(Object* made) {
  return reinterpret_cast<Handle>(made);
}

}  // namespace seascape::simulated

namespace seascape {

struct SimulatedRuntime::State {
  explicit State(const SimulatedOptions& given) : options(given), timeline(given.script) {}

  SimulatedOptions options;
  InputTimeline timeline;
  struct Next {  // in the chain of XrInstanceCreateInfo
    XrStructureType type;
    const void* next;
    State* state;
  } chained{};

  bool instance = false, session = false, lost = false, running = false, leaving = false;
  bool focused = true, on = true;  // as the script says
  XrSessionState session_state = XR_SESSION_STATE_UNKNOWN;
  std::deque<XrEventDataBuffer> events;
  std::vector<std::string> paths;  // XrPath is 1 and more
  std::vector<std::unique_ptr<simulated::Space>> spaces;
  std::vector<std::unique_ptr<simulated::Action>> actions;
  std::vector<std::unique_ptr<simulated::ActionSet>> sets;
  std::vector<std::unique_ptr<simulated::Swapchain>> swapchains;
  std::vector<std::unique_ptr<simulated::HandTracker>> trackers;
  simulated::Vulkan vulkan;
  std::map<std::string, std::vector<simulated::SuggestedBinding>> suggested;  // by profile
  std::map<std::string, double> inputs;                                       // "left/input/trigger/value"

  Pose floor;               // the middle of the floor: where it was centred last, in the room
  std::int64_t frame = -1;  // the one that was waited for last
  bool waited = false, begun = false;
  double before_s = -1.0;  // the frame before
  std::size_t ended = 0, shown = 0;
  std::vector<SimulatedBuzz> buzzes;
  ActionValues values{};   // of the last sync
  double synced_s = -1.0;  // when
  bool synced_focused = false;

  double time_s() const { return double(std::max<std::int64_t>(frame, 0)) / options.script.rate_hz; }
  bool sees_hands() const { return options.bare_hands[0] || options.bare_hands[1]; }
  XrTime time() const { return XrTime(std::llround(time_s() * 1e9)) + first_time; }
  double script_s(XrTime at) const { return double(at - first_time) * 1e-9; }
  static constexpr XrTime first_time = 1'000'000'000;

  template <class Event>
  void push(const Event& event) {
    XrEventDataBuffer buffer{};
    static_assert(sizeof(Event) <= sizeof buffer);
    std::memcpy(static_cast<void*>(&buffer), &event, sizeof event);
    events.push_back(buffer);
  }
  void go(XrSessionState state);
  void go_towards(XrSessionState goal);
  void follow_script();
  Pose head_at(double time_s) const;
  // Where a space lies in the room; nothing where its tracker is lost.
  std::optional<Pose> place(const simulated::Space& space, double time_s) const;
};

}  // namespace seascape
