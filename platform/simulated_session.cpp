// The simulated runtime's calls of OpenXR that are about the session, its spaces and its frames.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/files.h"
#include "platform/simulated_state.h"

namespace seascape::simulated {

namespace {

using State = SimulatedRuntime::State;

State& state(XrSession session) { return object<State>(session); }

XRAPI_ATTR XrResult XRAPI_CALL create_session(XrInstance instance, const XrSessionCreateInfo* info, XrSession* made) {
  State& s = object<State>(instance);
  const auto* binding = static_cast<const XrGraphicsBindingVulkanKHR*>(info->next);
  if (binding == nullptr || binding->type != XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR)
    return XR_ERROR_GRAPHICS_DEVICE_INVALID;
  if (s.session) return XR_ERROR_LIMIT_REACHED;
  s.vulkan = {binding->physicalDevice, binding->device, VK_NULL_HANDLE, VK_NULL_HANDLE, binding->queueFamilyIndex};
  vkGetDeviceQueue(binding->device, binding->queueFamilyIndex, binding->queueIndex, &s.vulkan.queue);
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = binding->queueFamilyIndex;
  check(vkCreateCommandPool(binding->device, &pool, nullptr, &s.vulkan.pool), "vkCreateCommandPool");
  s.session = true;
  s.lost = s.running = s.waited = s.begun = false;
  *made = handle<XrSession>(&s);
  s.go(XR_SESSION_STATE_IDLE);
  s.go(XR_SESSION_STATE_READY);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_session(XrSession session) {
  State& s = state(session);
  while (!s.swapchains.empty()) destroy_swapchain(s, *s.swapchains.back());
  vkDestroyCommandPool(s.vulkan.device, s.vulkan.pool, nullptr);
  s.session = s.running = false;
  s.events.clear();
  s.spaces.clear();
  s.trackers.clear();
  for (auto& set : s.sets) set->attached = false;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL begin_session(XrSession session, const XrSessionBeginInfo*) {
  State& s = state(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (s.running) return XR_ERROR_SESSION_RUNNING;
  if (s.session_state != XR_SESSION_STATE_READY) return XR_ERROR_SESSION_NOT_READY;
  s.running = true;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL end_session(XrSession session) {
  State& s = state(session);
  if (!s.running) return XR_ERROR_SESSION_NOT_RUNNING;
  if (s.session_state != XR_SESSION_STATE_STOPPING) return XR_ERROR_SESSION_NOT_STOPPING;
  s.running = false;
  s.go(XR_SESSION_STATE_IDLE);
  s.go(XR_SESSION_STATE_EXITING);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL request_exit(XrSession session) {
  State& s = state(session);
  if (!s.running) return XR_ERROR_SESSION_NOT_RUNNING;
  s.leaving = true;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL enumerate_spaces(XrSession, std::uint32_t room, std::uint32_t* count,
                                                XrReferenceSpaceType* to) {
  const std::array all{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL, XR_REFERENCE_SPACE_TYPE_STAGE,
                       XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT};
  return hand_out<XrReferenceSpaceType>(all, room, count, to);
}

XRAPI_ATTR XrResult XRAPI_CALL create_space(XrSession session, const XrReferenceSpaceCreateInfo* info, XrSpace* made) {
  State& s = state(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  Space::Kind kind;
  switch (int(info->referenceSpaceType)) {
    case XR_REFERENCE_SPACE_TYPE_VIEW:
      kind = Space::Kind::view;
      break;
    case XR_REFERENCE_SPACE_TYPE_LOCAL:
      kind = Space::Kind::local;
      break;
    case XR_REFERENCE_SPACE_TYPE_STAGE:
      kind = Space::Kind::stage;
      break;
    case XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT:
      kind = Space::Kind::local_floor;
      break;
    default:
      return XR_ERROR_REFERENCE_SPACE_UNSUPPORTED;
  }
  s.spaces.push_back(std::make_unique<Space>(Space{s, kind, 0, pose_from(info->poseInReferenceSpace)}));
  *made = handle<XrSpace>(s.spaces.back().get());
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_space(XrSpace space) {
  auto& all = object<Space>(space).of.spaces;
  std::erase_if(all, [&](const auto& one) { return handle<XrSpace>(one.get()) == space; });
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL locate_space(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
  const Space& what = object<Space>(space);
  const State& s = what.of;
  if (s.lost) return XR_ERROR_SESSION_LOST;
  location->locationFlags = 0;
  auto* velocity = static_cast<XrSpaceVelocity*>(location->next);
  if (velocity) velocity->velocityFlags = 0;
  const double at_s = s.script_s(time);
  const std::optional<Pose> in = s.place(object<Space>(base), at_s), at = s.place(what, at_s);
  if (!in || !at) return XR_SUCCESS;
  location->locationFlags = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT |
                            XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
  location->pose = xr_pose(composed(inverse(*in), *at));
  const double before_s = at_s - 1.0 / s.options.script.rate_hz;
  if (const std::optional<Pose> before = s.place(what, before_s); velocity && before) {
    const glm::vec3 moved(inverse(*in).orientation * (at->position_m - before->position_m) * s.options.script.rate_hz);
    velocity->velocityFlags = XR_SPACE_VELOCITY_LINEAR_VALID_BIT;
    velocity->linearVelocity = {moved.x, moved.y, moved.z};
  }
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL wait_frame(XrSession session, const XrFrameWaitInfo*, XrFrameState* frame) {
  State& s = state(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (!s.running) return XR_ERROR_SESSION_NOT_RUNNING;
  if (s.waited) return XR_ERROR_CALL_ORDER_INVALID;
  s.waited = true;
  ++s.frame;
  s.follow_script();
  if (s.lost) return XR_ERROR_SESSION_LOST;
  frame->predictedDisplayTime = s.time();
  frame->predictedDisplayPeriod = XrDuration(std::llround(1e9 / s.options.script.rate_hz));
  frame->shouldRender =
      s.session_state == XR_SESSION_STATE_VISIBLE || s.session_state == XR_SESSION_STATE_FOCUSED ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL begin_frame(XrSession session, const XrFrameBeginInfo*) {
  State& s = state(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (!s.running) return XR_ERROR_SESSION_NOT_RUNNING;
  if (!s.waited) return XR_ERROR_CALL_ORDER_INVALID;
  const bool discarded = std::exchange(s.begun, true);
  s.waited = false;
  return discarded ? XR_FRAME_DISCARDED : XR_SUCCESS;
}

bool shows(const State& s, const XrSwapchainSubImage& part) {
  const Swapchain& swapchain = object<Swapchain>(part.swapchain);
  const XrRect2Di& rect = part.imageRect;
  return &swapchain.of == &s && swapchain.released && rect.offset.x >= 0 && rect.offset.y >= 0 &&
         rect.extent.width > 0 && rect.extent.height > 0 &&
         std::uint32_t(rect.offset.x + rect.extent.width) <= swapchain.info.width &&
         std::uint32_t(rect.offset.y + rect.extent.height) <= swapchain.info.height &&
         part.imageArrayIndex < swapchain.info.arraySize;
}

bool is_sound(const XrPosef& pose) {
  const auto& q = pose.orientation;
  const float length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return std::abs(length - 1.0f) < 0.02f && std::isfinite(pose.position.x + pose.position.y + pose.position.z);
}

XrResult check_layer(const State& s, const XrCompositionLayerBaseHeader* layer) {
  if (layer->type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
    const auto& quad = *reinterpret_cast<const XrCompositionLayerQuad*>(layer);
    return !is_sound(quad.pose)       ? XR_ERROR_POSE_INVALID
           : !shows(s, quad.subImage) ? XR_ERROR_SWAPCHAIN_RECT_INVALID
                                      : XR_SUCCESS;
  }
  if (layer->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION) return XR_ERROR_LAYER_INVALID;
  const auto& projection = *reinterpret_cast<const XrCompositionLayerProjection*>(layer);
  if (projection.viewCount != 2) return XR_ERROR_VALIDATION_FAILURE;
  for (std::uint32_t eye = 0; eye < 2; ++eye) {
    const XrCompositionLayerProjectionView& view = projection.views[eye];
    if (!is_sound(view.pose)) return XR_ERROR_POSE_INVALID;
    if (!shows(s, view.subImage)) return XR_ERROR_SWAPCHAIN_RECT_INVALID;
    if (const auto* depth = static_cast<const XrCompositionLayerDepthInfoKHR*>(view.next);
        depth && (!shows(s, depth->subImage) || depth->nearZ == depth->farZ))
      return XR_ERROR_VALIDATION_FAILURE;
  }
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL end_frame(XrSession session, const XrFrameEndInfo* info) {
  State& s = state(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (!s.running) return XR_ERROR_SESSION_NOT_RUNNING;
  if (!s.begun) return XR_ERROR_CALL_ORDER_INVALID;
  if (info->displayTime != s.time()) return XR_ERROR_TIME_INVALID;
  const std::span layers(info->layers, info->layerCount);
  for (const XrCompositionLayerBaseHeader* layer : layers)
    if (const XrResult fault = check_layer(s, layer); fault != XR_SUCCESS) return fault;
  s.begun = false;
  ++s.ended;
  s.shown += !layers.empty();
  if (s.options.every > 0 && s.frame % s.options.every == 0 && !layers.empty())
    for (std::size_t eye = 0; eye < 2; ++eye)
      write_png(s.options.out / fmt::format("frame_{:04}_{}.png", s.frame, eye == 0 ? "left" : "right"),
                composed_picture(s.vulkan, layers, eye));
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL locate_views(XrSession session, const XrViewLocateInfo* info, XrViewState* view_state,
                                            std::uint32_t room, std::uint32_t* count, XrView* views) {
  const State& s = state(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  *count = 2;
  if (room == 0) return XR_SUCCESS;
  if (room < 2) return XR_ERROR_SIZE_INSUFFICIENT;
  const double at_s = s.script_s(info->displayTime);
  const std::optional<Pose> head = s.timeline.pose(Tracker::head, at_s), in = s.place(object<Space>(info->space), at_s);
  view_state->viewStateFlags = 0;
  if (!head || !in) return XR_SUCCESS;
  view_state->viewStateFlags = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT |
                               XR_VIEW_STATE_POSITION_TRACKED_BIT | XR_VIEW_STATE_ORIENTATION_TRACKED_BIT;
  const InputScript& script = s.options.script;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const Pose of_head{{(eye == 0 ? -0.5 : 0.5) * script.eye_distance_m, 0.0, 0.0}};
    views[eye].pose = xr_pose(composed(inverse(*in), composed(*head, of_head)));
    const FovAngles& fov = script.eyes[eye];
    const auto radians = [](double degrees) { return float(glm::radians(degrees)); };
    views[eye].fov = {radians(fov.left_deg), radians(fov.right_deg), radians(fov.up_deg), radians(fov.down_deg)};
  }
  return XR_SUCCESS;
}

// Between an ellipse in the eye's field, nearer to the nose than its middle, and what lies outside the field: a ring of
// quads.
XRAPI_ATTR XrResult XRAPI_CALL get_mask(XrSession session, XrViewConfigurationType, std::uint32_t eye,
                                        XrVisibilityMaskTypeKHR type, XrVisibilityMaskKHR* mask) {
  const State& s = state(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (eye > 1 || type != XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR) return XR_ERROR_VALIDATION_FAILURE;
  constexpr std::uint32_t sides = 48;
  const std::uint32_t quads = s.options.lens > 0.0 ? sides : 0;
  mask->vertexCountOutput = 2 * quads;
  mask->indexCountOutput = 6 * quads;
  if (mask->vertexCapacityInput == 0 && mask->indexCapacityInput == 0) return XR_SUCCESS;
  if (mask->vertexCapacityInput < 2 * quads || mask->indexCapacityInput < 6 * quads) return XR_ERROR_SIZE_INSUFFICIENT;
  const FovAngles& fov = s.options.script.eyes[eye];
  const auto tangent = [](double degrees) { return std::tan(glm::radians(degrees)); };
  const double left = tangent(fov.left_deg), right = tangent(fov.right_deg), up = tangent(fov.up_deg),
               down = tangent(fov.down_deg);
  const glm::dvec2 half(0.5 * (right - left), 0.5 * (up - down));
  const glm::dvec2 middle(0.5 * (left + right) + (eye == 0 ? 0.05 : -0.05) * half.x, 0.5 * (up + down));
  for (std::uint32_t side = 0; side < quads; ++side) {
    const double about = glm::radians(360.0) * side / quads;
    const glm::dvec2 out = half * glm::dvec2(std::cos(about), std::sin(about));
    const glm::dvec2 inner = middle + s.options.lens * out, outer = middle + 2.0 * out;
    mask->vertices[2 * side] = {float(inner.x), float(inner.y)};
    mask->vertices[2 * side + 1] = {float(outer.x), float(outer.y)};
    const std::uint32_t next = (side + 1) % quads;
    const std::uint32_t corners[] = {2 * side, 2 * side + 1, 2 * next, 2 * next, 2 * side + 1, 2 * next + 1};
    std::copy(std::begin(corners), std::end(corners), mask->indices + 6 * side);
  }
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL enumerate_rates(XrSession session, std::uint32_t room, std::uint32_t* count, float* to) {
  const std::array all{float(state(session).options.script.rate_hz)};
  return hand_out<float>(all, room, count, to);
}

XRAPI_ATTR XrResult XRAPI_CALL get_rate(XrSession session, float* rate) {
  *rate = float(state(session).options.script.rate_hz);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL request_rate(XrSession session, float rate) {
  return rate == 0.0f || rate == float(state(session).options.script.rate_hz)
             ? XR_SUCCESS
             : XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB;
}

}  // namespace

PFN_xrVoidFunction session_call(std::string_view name) {
  SEASCAPE_SIMULATED(CreateSession, create_session)
  SEASCAPE_SIMULATED(DestroySession, destroy_session)
  SEASCAPE_SIMULATED(BeginSession, begin_session)
  SEASCAPE_SIMULATED(EndSession, end_session)
  SEASCAPE_SIMULATED(RequestExitSession, request_exit)
  SEASCAPE_SIMULATED(EnumerateReferenceSpaces, enumerate_spaces)
  SEASCAPE_SIMULATED(CreateReferenceSpace, create_space)
  SEASCAPE_SIMULATED(DestroySpace, destroy_space)
  SEASCAPE_SIMULATED(LocateSpace, locate_space)
  SEASCAPE_SIMULATED(WaitFrame, wait_frame)
  SEASCAPE_SIMULATED(BeginFrame, begin_frame)
  SEASCAPE_SIMULATED(EndFrame, end_frame)
  SEASCAPE_SIMULATED(LocateViews, locate_views)
  SEASCAPE_SIMULATED(GetVisibilityMaskKHR, get_mask)
  SEASCAPE_SIMULATED(EnumerateDisplayRefreshRatesFB, enumerate_rates)
  SEASCAPE_SIMULATED(GetDisplayRefreshRateFB, get_rate)
  SEASCAPE_SIMULATED(RequestDisplayRefreshRateFB, request_rate)
  return nullptr;
}

}  // namespace seascape::simulated
