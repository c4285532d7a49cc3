#include "platform/headset.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "platform/headset_overlay.h"

namespace seascape {

namespace {

constexpr XrPosef nowhere{{0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};

XrPosef xr_pose(const Pose& pose) {
  const glm::quat q(pose.orientation);
  const glm::vec3 p(pose.position_m);
  return {{q.x, q.y, q.z, q.w}, {p.x, p.y, p.z}};
}

double yaw_of(const glm::dquat& orientation) {  // about +y, radians
  const glm::dvec3 ahead = orientation * glm::dvec3(0.0, 0.0, -1.0);
  const glm::dvec3 right = orientation * glm::dvec3(1.0, 0.0, 0.0);
  return std::hypot(ahead.x, ahead.z) > 1e-3 ? std::atan2(-ahead.x, -ahead.z) : std::atan2(-right.z, right.x);
}

bool fov_is_sound(const XrFovf& fov) {
  constexpr float most = 1.55f;  // 89 degrees
  return fov.angleLeft < fov.angleRight && fov.angleDown < fov.angleUp && std::abs(fov.angleLeft) < most &&
         std::abs(fov.angleRight) < most && std::abs(fov.angleUp) < most && std::abs(fov.angleDown) < most;
}

constexpr XrFovf usual_fov{-0.785f, 0.785f, 0.785f, -0.785f};

Fov fov_from(const XrFovf& fov) {
  return {std::tan(double(fov.angleLeft)), std::tan(double(fov.angleRight)), std::tan(double(fov.angleUp)),
          std::tan(double(fov.angleDown))};
}

const char* state_name(XrSessionState state) {
  constexpr const char* names[] = {"unknown", "idle",     "ready",        "synchronized", "visible",
                                   "focused", "stopping", "loss pending", "exiting"};
  return std::size_t(state) < std::size(names) ? names[std::size_t(state)] : "unheard of";
}

}  // namespace

Headset::Headset(HeadsetSystem& system, Device& device, const HeadsetOptions& options)
    : system_(system), api_(system.api()), device_(device), options_(options) {
  const HeadsetFacts& facts = system.facts();
  const auto wide = [](std::uint32_t wanted, std::uint32_t recommended, double scale, std::uint32_t most) {
    const double size = wanted ? double(wanted) : double(recommended) * scale;
    return std::uint32_t(std::clamp(std::round(size), 1.0, double(most)));
  };
  most_width_ = wide(options.width, facts.width, options.most_scale, facts.most_width);
  most_height_ = wide(options.height, facts.height, options.most_scale, facts.most_height);
  set_scale(options.scale);
  for (XrView& view : located_) view = {XR_TYPE_VIEW, nullptr, nowhere, usual_fov};
  try {
    begin_session();
  } catch (...) {
    end_session();
    throw;
  }
  spdlog::info("headset: {} on {} {}, {}x{} pixels an eye", facts.headset, facts.runtime, facts.runtime_version, width_,
               height_);
}

Headset::~Headset() {
  device_.wait_for_gpu();
  try {
    if (frame_begun_) end_frame(false);
  } catch (const Error&) {  // there is nobody left to show anything
  }
  end_session();
}

void Headset::set_scale(double scale) {
  const HeadsetFacts& facts = system_.facts();
  const auto size = [&](std::uint32_t wanted, std::uint32_t recommended, std::uint32_t most) {
    const double asked = double(wanted ? wanted : recommended) * scale;
    return std::uint32_t(std::clamp(std::round(asked), 1.0, double(most)));
  };
  width_ = size(options_.width, facts.width, most_width_);
  height_ = size(options_.height, facts.height, most_height_);
}

// A call that finds the session lost leaves it to begin() to make another.
XrResult Headset::checked(XrResult result, const char* call) {
  if (result == XR_ERROR_SESSION_LOST) {
    if (!session_lost_) spdlog::warn("headset: the session is lost ({}); waiting for another", call);
    session_lost_ = true;
    return result;
  }
  return check_xr(result, call);
}

void Headset::tell(HeadsetCall::Kind kind, std::span<const XrView> views) const {
  if (report_) report_({kind, frame_state_.predictedDisplayTime, {views.begin(), views.end()}});
}

void Headset::begin_session() {
  XrGraphicsBindingVulkan2KHR binding{XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR};
  binding.instance = device_.instance();
  binding.physicalDevice = device_.physical();
  binding.device = device_.handle();
  binding.queueFamilyIndex = device_.queue_family();
  XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO};
  info.next = &binding;
  info.systemId = system_.id();
  {
    const std::lock_guard lock(device_.queue_mutex());
    check_xr(api_.CreateSession(system_.instance(), &info, &session_), "xrCreateSession");
  }
  state_ = XR_SESSION_STATE_UNKNOWN;
  session_lost_ = running_ = false;
  first_time_.reset();
  choose_space();
  controllers_ = std::make_unique<HeadsetInput>(system_, session_, options_.left_handed);
  make_pictures();
  ask_for_rate();
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
}

// LOCAL_FLOOR, or STAGE, whose origins lie on the floor, or LOCAL, which is at the head's height.
void Headset::choose_space() {
  std::uint32_t count = 0;
  check_xr(api_.EnumerateReferenceSpaces(session_, 0, &count, nullptr), "xrEnumerateReferenceSpaces");
  std::vector<XrReferenceSpaceType> types(std::min(count, 64u));
  count = std::uint32_t(types.size());
  if (count > 0)
    check_xr(api_.EnumerateReferenceSpaces(session_, count, &count, types.data()), "xrEnumerateReferenceSpaces");
  space_type_ = XR_REFERENCE_SPACE_TYPE_LOCAL;
  for (const XrReferenceSpaceType type : {XR_REFERENCE_SPACE_TYPE_STAGE, XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT})
    if (std::find(types.begin(), types.end(), type) != types.end() &&
        (type != XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT || system_.uses(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME)))
      space_type_ = type;
  space_offset_ = nowhere;
  XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
  info.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_VIEW;
  info.poseInReferenceSpace = nowhere;
  check_xr(api_.CreateReferenceSpace(session_, &info, &view_space_), "xrCreateReferenceSpace");
  move_space();
}

// Makes the space anew where space_offset_ says.
void Headset::move_space() {
  XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO};
  info.referenceSpaceType = space_type_;
  info.poseInReferenceSpace = space_offset_;
  if (space_type_ == XR_REFERENCE_SPACE_TYPE_LOCAL)
    info.poseInReferenceSpace.position.y -= float(options_.eye_height_m);
  XrSpace made = XR_NULL_HANDLE;
  if (checked(api_.CreateReferenceSpace(session_, &info, &made), "xrCreateReferenceSpace") == XR_ERROR_SESSION_LOST)
    return;
  if (space_) api_.DestroySpace(space_);
  space_ = made;
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
      most_width_, most_height_, 2, colour_,
      XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT};
  colours_ = HeadsetSwapchain(system_, session_, spec);
  if (depth_format_ != VK_FORMAT_UNDEFINED) {
    spec.format = depth_format_;
    spec.usage = XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
    depths_ = HeadsetSwapchain(system_, session_, spec);
  }
  auto lent = std::make_shared<LentImages>();
  lent->width = most_width_;
  lent->height = most_height_;
  lent->colours = colours_.images();
  lent->depths = depths_.images();
  lent_ = std::move(lent);
}

void Headset::ask_for_rate() {
  if (options_.rate_hz <= 0.0 || !api_.RequestDisplayRefreshRateFB) return;
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
      if (checked(api_.BeginSession(session_, &info), "xrBeginSession") != XR_ERROR_SESSION_LOST) running_ = true;
      break;
    }
    case XR_SESSION_STATE_STOPPING:
      running_ = false;
      checked(api_.EndSession(session_), "xrEndSession");
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
        }
        break;
      case XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED:
        spdlog::debug("headset: controllers {}", controllers_->profile(session_));
        break;
      case XR_TYPE_EVENT_DATA_EVENTS_LOST:
        spdlog::warn("headset: the runtime lost {} events",
                     reinterpret_cast<const XrEventDataEventsLost&>(event).lostEventCount);
        break;
      case XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT:
        away_ = !reinterpret_cast<const XrEventDataUserPresenceChangedEXT&>(event).isUserPresent;
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

// Waits for the time to draw; false: there is no frame now.
bool Headset::wait_frame() {
  frame_state_ = {XR_TYPE_FRAME_STATE};
  if (checked(api_.WaitFrame(session_, nullptr, &frame_state_), "xrWaitFrame") == XR_ERROR_SESSION_LOST) return false;
  tell(HeadsetCall::Kind::wait);
  const XrTime time = frame_state_.predictedDisplayTime;
  if (!first_time_) {
    first_time_ = time;
    before_s_ = time_s_;
  }
  time_s_ = std::max(time_s_, before_s_ + double(time - *first_time_) * 1e-9);  // a clock that jumps back stands
  controllers_->sync(session_, space_, time, post_, state_ == XR_SESSION_STATE_FOCUSED);
  {
    const std::lock_guard lock(device_.queue_mutex());
    if (checked(api_.BeginFrame(session_, nullptr), "xrBeginFrame") == XR_ERROR_SESSION_LOST) return false;
  }
  tell(HeadsetCall::Kind::begin);
  frame_begun_ = true;
  return true;
}

DisplayFrame Headset::begin() {
  moved_ = false;
  take_events();
  if (session_lost_ && !closed_) {
    device_.wait_for_gpu();
    end_session();
    try {
      begin_session();
      spdlog::info("headset: another session begins");
    } catch (const HeadsetLost&) {
      throw;
    } catch (const Error& fault) {
      spdlog::debug("headset: no session yet: {}", fault.what());
      end_session();
      session_lost_ = true;
    }
  }
  DisplayFrame frame;
  frame.width = width_;
  frame.height = height_;
  frame.should_render = false;
  should_render_ = false;
  if (running_ && !closed_ && wait_frame()) {
    should_render_ = frame_state_.shouldRender && !session_lost_;
    if (should_render_) {
      const std::lock_guard lock(device_.queue_mutex());
      frame.colour = colours_.acquire();
      if (depths_) frame.depth = depths_.acquire();
    }
    frame.should_render = should_render_;
    frame.period_s = double(frame_state_.predictedDisplayPeriod) * 1e-9;
  } else if (!closed_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // events are all that comes now
    frame.away = true;
  }
  if (recentre_wanted_ && head_ && running_) {
    recentre_wanted_ = false;
    centre_under_head();
  }
  controllers_gather();
  frame.time_s = time_s_;
  frame.closed = closed_;
  frame.focused = state_ == XR_SESSION_STATE_FOCUSED;
  frame.moved = moved_;
  frame.lent = lent_;
  return frame;
}

void Headset::controllers_gather() {
  if (controllers_ && state_ == XR_SESSION_STATE_FOCUSED) controllers_->gather(gatherer_);
  input_ = gatherer_.take();
  input_.hands = controllers_ && state_ == XR_SESSION_STATE_FOCUSED ? controllers_->hands() : decltype(input_.hands){};
}

// The space's new origin, seen from the old one, is the floor under the head, turned as the head is.
void Headset::centre_under_head() {
  const double yaw = yaw_of(head_->orientation);
  const Pose before = pose_from(space_offset_);
  Pose offset;
  offset.orientation = before.orientation * glm::angleAxis(yaw, glm::dvec3(0.0, 1.0, 0.0));
  offset.position_m =
      before.position_m + before.orientation * glm::dvec3(head_->position_m.x, 0.0, head_->position_m.z);
  space_offset_ = xr_pose(offset);
  move_space();
  moved_ = true;
}

void Headset::locate() const {
  XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO};
  info.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  info.displayTime = frame_state_.predictedDisplayTime;
  info.space = space_;
  XrViewState state{XR_TYPE_VIEW_STATE};
  std::array<XrView, 2> views;
  views.fill({XR_TYPE_VIEW});
  std::uint32_t count = 0;
  const XrResult result = api_.LocateViews(session_, &info, &state, 2, &count, views.data());
  if (result == XR_ERROR_SESSION_LOST) return;  // the next call says so too
  check_xr(result, "xrLocateViews");
  constexpr XrViewStateFlags known = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
  if (count == 2 && (state.viewStateFlags & known) == known)
    for (std::size_t eye = 0; eye < 2; ++eye) {
      if (pose_is_sound(views[eye].pose)) located_[eye].pose = views[eye].pose;
      if (fov_is_sound(views[eye].fov)) {
        located_[eye].fov = views[eye].fov;
      } else if (!fov_told_) {
        fov_told_ = true;
        spdlog::warn(
            "headset: it asks for a field of view from {:.3g} to {:.3g} and {:.3g} to {:.3g} rad: 90 degrees are "
            "drawn instead",
            views[eye].fov.angleLeft, views[eye].fov.angleRight, views[eye].fov.angleDown, views[eye].fov.angleUp);
      }
    }
  tell(HeadsetCall::Kind::locate, located_);
}

Viewpoint Headset::viewpoint(const Pose& carrier) const {
  if (should_render_) locate();
  Viewpoint viewpoint;
  glm::dvec3 middle(0.0);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    eyes_[eye] = {pose_from(located_[eye].pose), fov_from(located_[eye].fov)};
    middle += 0.5 * eyes_[eye].pose.position_m;
    viewpoint.eyes.push_back({composed(carrier, eyes_[eye].pose), eyes_[eye].fov});
  }
  // The head lies between its eyes and looks as they do on average, which may squint.
  glm::dquat right = eyes_[1].pose.orientation;
  if (glm::dot(eyes_[0].pose.orientation, right) < 0.0) right = -right;
  head_ = Pose{middle, glm::normalize(eyes_[0].pose.orientation + right)};
  viewpoint.viewer = composed(carrier, *head_);
  viewpoint.pixels_per_radian = pixels_per_radian(viewpoint.eyes, height_);
  return viewpoint;
}

// The runtime takes its images back in the layouts in which it lent them.
void Headset::hand_over(Frame& frame, const RenderTarget& picture, const Image* depth) {
  Uses uses{use(picture.colour(), Access::colour_target)};
  if (depth && depths_) uses.add(use(*depth, Access::depth_target));
  frame.pass("hand over", uses, [](Commands&) {});
}

void Headset::end(Frame& frame, const RenderTarget* picture, const Image* depth) {
  const bool shown = picture != nullptr && should_render_;
  quad_.reset();
  if (shown && layer_) quad_ = layer_->draw(frame);
  if (shown) hand_over(frame, *picture, depth);
  if (picture) frame.submit();
  if (frame_begun_) end_frame(shown, depth != nullptr);
}

void Headset::end_frame(bool shown, bool with_depth) {
  frame_begun_ = false;
  const std::lock_guard lock(device_.queue_mutex());
  for (HeadsetSwapchain* one : {&colours_, &depths_})
    if (one->acquired()) one->release();
  if (quad_) layer_->release();
  std::array<XrCompositionLayerProjectionView, 2> views;
  std::array<XrCompositionLayerDepthInfoKHR, 2> depths;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    XrCompositionLayerProjectionView& view = views[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
    view.pose = located_[eye].pose;
    view.fov = located_[eye].fov;
    const XrRect2Di rect{{0, 0}, {std::int32_t(width_), std::int32_t(height_)}};
    view.subImage = {colours_.get(), rect, std::uint32_t(eye)};
    if (!with_depth || !depths_) continue;
    // Reversed depth: 1 at the near plane, 0 at infinity.
    depths[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR,
                   nullptr,
                   {depths_.get(), rect, std::uint32_t(eye)},
                   0.0f,
                   1.0f,
                   FLT_MAX,
                   float(options_.near_m)};
    view.next = &depths[eye];
  }
  XrCompositionLayerProjection projection{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  projection.space = space_;
  projection.viewCount = 2;
  projection.views = views.data();
  XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD};
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  if (shown && !session_lost_) layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection));
  if (shown && !session_lost_ && quad_) {
    quad.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
    quad.space = space_;
    quad.eyeVisibility = XR_EYE_VISIBILITY_BOTH;
    quad.subImage = {quad_->swapchain, {{0, 0}, {std::int32_t(quad_->width), std::int32_t(quad_->height)}}, 0};
    quad.pose = xr_pose(quad_->at);
    quad.size = {float(quad_->size_m.x), float(quad_->size_m.y)};
    layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&quad));
  }
  XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
  info.displayTime = frame_state_.predictedDisplayTime;
  info.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  info.layerCount = std::uint32_t(layers.size());
  info.layers = layers.data();
  tell(HeadsetCall::Kind::end, shown ? std::span<const XrView>(located_) : std::span<const XrView>());
  checked(api_.EndFrame(session_, &info), "xrEndFrame");
}

std::unique_ptr<Overlay> Headset::make_overlay() { return std::make_unique<HeadsetOverlay>(device_, *this); }

void Headset::buzz(int hand, double strength, double seconds) {
  if (controllers_ && state_ == XR_SESSION_STATE_FOCUSED) controllers_->buzz(session_, hand, strength, seconds);
}

void Headset::leave() {
  if (!running_ || XR_FAILED(api_.RequestExitSession(session_))) closed_ = true;
}

}  // namespace seascape
