// A headset's session: its beginning and end, its space, its images, and what the runtime tells of it.
#include <spdlog/spdlog.h>

#include <algorithm>

#include "platform/headset.h"

namespace seascape {

namespace {

const char* state_name(XrSessionState state) {
  constexpr const char* names[] = {"unknown", "idle",     "ready",        "synchronized", "visible",
                                   "focused", "stopping", "loss pending", "exiting"};
  return std::size_t(state) < std::size(names) ? names[std::size_t(state)] : "unheard of";
}

}  // namespace

void Headset::begin_session() {
  {
    const std::lock_guard lock(device_.queue_mutex());
    session_ = make_session(system_, device_);
  }
  state_ = XR_SESSION_STATE_UNKNOWN;
  session_lost_ = running_ = false;
  last_time_.reset();
  choose_space();
  controllers_ = std::make_unique<HeadsetInput>(system_, session_);
  make_pictures();
  mask_.ask(session_);
  if (options_.rate_hz > 0.0) ask_for_rate();
  if (system_.uses(XR_EXT_PERFORMANCE_SETTINGS_EXTENSION_NAME) && api_.PerfSettingsSetPerformanceLevelEXT)
    for (const XrPerfSettingsDomainEXT domain : {XR_PERF_SETTINGS_DOMAIN_CPU_EXT, XR_PERF_SETTINGS_DOMAIN_GPU_EXT})
      api_.PerfSettingsSetPerformanceLevelEXT(session_, domain, XR_PERF_SETTINGS_LEVEL_SUSTAINED_HIGH_EXT);
}

void Headset::end_session() {
  controllers_.reset();
  if (layer_) layer_->reset();
  colours_ = {};
  depths_ = {};
  for (XrSpace* space : {&space_, &view_space_}) {
    if (*space) api_.DestroySpace(*space);
    *space = XR_NULL_HANDLE;
  }
  if (session_) {
    const std::lock_guard lock(device_.queue_mutex());
    api_.DestroySession(session_);
  }
  session_ = XR_NULL_HANDLE;
  running_ = frame_begun_ = false;
  submitted_.reset();
}

// LOCAL_FLOOR, or STAGE, whose origins lie on the floor, or LOCAL, which is at the head's height.
void Headset::choose_space() {
  const auto types = xr_list("xrEnumerateReferenceSpaces", XrReferenceSpaceType{},
                             [&](std::uint32_t room, std::uint32_t* found, XrReferenceSpaceType* to) {
                               return api_.EnumerateReferenceSpaces(session_, room, found, to);
                             });
  space_type_ = XR_REFERENCE_SPACE_TYPE_LOCAL;
  for (const XrReferenceSpaceType type : {XR_REFERENCE_SPACE_TYPE_STAGE, XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT})
    if (std::find(types.begin(), types.end(), type) != types.end() &&
        (type != XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT || system_.uses(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME)))
      space_type_ = type;
  space_offset_ = nowhere;
  floor_m_ = floor_of_who_stands_m();
  stature_changed_ = options_.seated;
  XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
  info.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_VIEW;
  info.poseInReferenceSpace = nowhere;
  check_xr(api_.CreateReferenceSpace(session_, &info, &view_space_), "xrCreateReferenceSpace");
  move_space();
}

// Makes the space anew where space_offset_ and floor_m_ say.
void Headset::move_space() {
  XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
  info.referenceSpaceType = space_type_;
  info.poseInReferenceSpace = space_offset_;
  info.poseInReferenceSpace.position.y += float(floor_m_);
  XrSpace made = XR_NULL_HANDLE;
  check_xr(api_.CreateReferenceSpace(session_, &info, &made), "xrCreateReferenceSpace");
  if (space_) api_.DestroySpace(space_);
  space_ = made;
}

double Headset::floor_of_who_stands_m() const {
  return space_type_ == XR_REFERENCE_SPACE_TYPE_LOCAL ? -options_.eye_height_m : 0.0;
}

// For someone who sits: under the head as it is at `time`, as soon as it is tracked.
void Headset::lay_floor(XrTime time) {
  double floor_m = floor_of_who_stands_m();
  if (options_.seated) {
    XrSpaceLocation head{XR_TYPE_SPACE_LOCATION};
    check_xr(api_.LocateSpace(view_space_, space_, time, &head), "xrLocateSpace");
    if (!(head.locationFlags & XR_SPACE_LOCATION_POSITION_VALID_BIT) || !pose_is_sound(head.pose)) return;
    floor_m = floor_m_ + double(head.pose.position.y) - options_.eye_height_m;
  }
  stature_changed_ = false;
  if (floor_m == floor_m_) return;
  floor_m_ = floor_m;
  move_space();
  moved_ = true;
}

void Headset::make_pictures() {
  const VkFormat colour = headset_format(system_, session_, {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB});
  if (colour == VK_FORMAT_UNDEFINED)
    throw Error(system_.facts().runtime, "it takes no sRGB pictures of 8 bits", "update the headset's runtime");
  if (colour_ != VK_FORMAT_UNDEFINED && colour != colour_)
    throw Error(system_.facts().runtime, "its new session takes other pictures than the last", "start seascape anew");
  colour_ = colour;
  depth_format_ = VK_FORMAT_UNDEFINED;
  if (system_.uses(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME))
    depth_format_ = headset_format(system_, session_, {device_.facts().depth_format});
  HeadsetSwapchainSpec spec{
      room_.x, room_.y, 2, colour_,
      XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT};
  colours_ = HeadsetSwapchain(system_, device_, session_, spec);
  if (depth_format_ != VK_FORMAT_UNDEFINED) {
    spec.format = depth_format_;
    spec.usage = XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
    depths_ = HeadsetSwapchain(system_, device_, session_, spec);
  }
  auto lent = std::make_shared<LentImages>();
  lent->width = room_.x;
  lent->height = room_.y;
  lent->colours = colours_.images();
  lent->depths = depths_.images();
  lent_ = std::move(lent);
}

void Headset::ask_for_rate() {
  if (!api_.RequestDisplayRefreshRateFB) return;
  if (XR_FAILED(api_.RequestDisplayRefreshRateFB(session_, float(options_.rate_hz))))
    spdlog::warn("headset: it does not show {:g} pictures a second", options_.rate_hz);
}

void Headset::take_state(XrSessionState state) {
  spdlog::debug("headset: {}", state_name(state));
  const bool was_focused = state_ == XR_SESSION_STATE_FOCUSED;
  state_ = state;
  if (was_focused && state != XR_SESSION_STATE_FOCUSED) gatherer_.reset();
  switch (state) {
    case XR_SESSION_STATE_READY: {
      XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO};
      info.primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
      check_xr(api_.BeginSession(session_, &info), "xrBeginSession");
      running_ = true;
      break;
    }
    case XR_SESSION_STATE_STOPPING:
      running_ = false;
      check_xr(api_.EndSession(session_), "xrEndSession");
      break;
    case XR_SESSION_STATE_EXITING:
      closed_ = true;
      running_ = false;
      break;
    case XR_SESSION_STATE_LOSS_PENDING:
      session_lost_ = true;
      break;
    default:
      break;
  }
}

void Headset::take_events() {
  for (int patience = 0; patience < 1000; ++patience) {
    XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
    if (check_xr(api_.PollEvent(system_.instance(), &event), "xrPollEvent") != XR_SUCCESS) return;
    switch (int(event.type)) {  // newer ones have no name here
      case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
        throw HeadsetLost("");
      case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED:
        if (const auto& changed = reinterpret_cast<const XrEventDataSessionStateChanged&>(event);
            changed.session == session_)
          take_state(changed.state);
        break;
      case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING:
        // The runtime centred it anew: what was centred here before counts no more.
        if (reinterpret_cast<const XrEventDataReferenceSpaceChangePending&>(event).referenceSpaceType == space_type_) {
          space_offset_ = nowhere;
          move_space();
          moved_ = true;
          stature_changed_ = options_.seated;
        }
        break;
      case XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR:
        if (reinterpret_cast<const XrEventDataVisibilityMaskChangedKHR&>(event).session == session_)
          mask_.ask(session_);
        break;
      case XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED:
        spdlog::debug("headset: controllers {}", controllers_->profile(session_));
        break;
      case XR_TYPE_EVENT_DATA_EVENTS_LOST:
        spdlog::warn("headset: the runtime lost {} events",
                     reinterpret_cast<const XrEventDataEventsLost&>(event).lostEventCount);
        break;
      case XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT:
        spdlog::debug(
            "headset: {} wears it",
            reinterpret_cast<const XrEventDataUserPresenceChangedEXT&>(event).isUserPresent ? "somebody" : "nobody");
        break;
      case XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB:
        spdlog::info("headset: {:g} pictures a second",
                     reinterpret_cast<const XrEventDataDisplayRefreshRateChangedFB&>(event).toDisplayRefreshRate);
        break;
      case XR_TYPE_EVENT_DATA_PERF_SETTINGS_EXT:
        spdlog::warn("headset: the runtime says that the machine is {} for this load",
                     reinterpret_cast<const XrEventDataPerfSettingsEXT&>(event).toLevel ==
                             XR_PERF_SETTINGS_NOTIF_LEVEL_NORMAL_EXT
                         ? "cool enough again"
                         : "too warm or too slow");
        break;
      default:
        break;
    }
  }
}

}  // namespace seascape
