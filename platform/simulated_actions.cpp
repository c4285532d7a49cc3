// The simulated runtime's calls of OpenXR that are about what is done: the script gives actions by their names.
#include <algorithm>

#include "platform/bindings.h"
#include "platform/simulated_state.h"

namespace seascape::simulated {

namespace {

using State = SimulatedRuntime::State;

constexpr std::string_view hands[] = {"/user/hand/left", "/user/hand/right"};
constexpr const char* held_profile = "/interaction_profiles/oculus/touch_controller";

// 0 left, 1 right, -1 neither.
int hand_of(const State& s, XrPath path) {
  for (int hand = 0; hand < 2; ++hand)
    if (path != XR_NULL_PATH && path <= s.paths.size() && s.paths[std::size_t(path) - 1] == hands[hand]) return hand;
  return -1;
}

bool has_focus(const State& s) { return s.session_state == XR_SESSION_STATE_FOCUSED && s.focused && s.on; }

XRAPI_ATTR XrResult XRAPI_CALL create_set(XrInstance instance, const XrActionSetCreateInfo* info, XrActionSet* made) {
  State& s = object<State>(instance);
  if (info->actionSetName[0] == 0 || info->localizedActionSetName[0] == 0) return XR_ERROR_NAME_INVALID;
  for (const auto& set : s.sets)
    if (set->name == info->actionSetName) return XR_ERROR_NAME_DUPLICATED;
  s.sets.push_back(std::make_unique<ActionSet>(ActionSet{s, info->actionSetName}));
  *made = handle<XrActionSet>(s.sets.back().get());
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_set(XrActionSet set) {
  State& s = object<ActionSet>(set).of;
  std::erase_if(s.sets, [&](const auto& one) { return handle<XrActionSet>(one.get()) == set; });
  if (!s.sets.empty()) return XR_SUCCESS;
  s.actions.clear();
  s.suggested.clear();
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL create_action(XrActionSet set, const XrActionCreateInfo* info, XrAction* made) {
  State& s = object<ActionSet>(set).of;
  if (object<ActionSet>(set).attached) return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
  for (const char c : std::string_view(info->actionName))
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.'))
      return XR_ERROR_PATH_FORMAT_INVALID;
  for (const auto& one : s.actions)
    if (&one->set == &object<ActionSet>(set) && one->name == info->actionName) return XR_ERROR_NAME_DUPLICATED;
  s.actions.push_back(std::make_unique<Action>(Action{s, object<ActionSet>(set), info->actionName, info->actionType}));
  *made = handle<XrAction>(s.actions.back().get());
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL suggest(XrInstance instance, const XrInteractionProfileSuggestedBinding* info) {
  State& s = object<State>(instance);
  if (info->countSuggestedBindings == 0) return XR_ERROR_VALIDATION_FAILURE;
  auto& bindings = s.suggested[s.paths.at(std::size_t(info->interactionProfile) - 1)];
  bindings.clear();
  for (const XrActionSuggestedBinding& one : std::span(info->suggestedBindings, info->countSuggestedBindings))
    bindings.push_back({one.action, s.paths.at(std::size_t(one.binding) - 1)});
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL attach(XrSession session, const XrSessionActionSetsAttachInfo* info) {
  State& s = object<State>(session);
  for (std::uint32_t i = 0; i < info->countActionSets; ++i) {
    ActionSet& set = object<ActionSet>(info->actionSets[i]);
    if (std::exchange(set.attached, true)) return XR_ERROR_ACTIONSETS_ALREADY_ATTACHED;
  }
  XrEventDataInteractionProfileChanged event{XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED};
  event.session = session;
  s.push(event);
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL get_profile(XrSession session, XrPath, XrInteractionProfileState* profile) {
  State& s = object<State>(session);
  const std::string held = s.options.profile.empty() ? held_profile : s.options.profile;
  const auto found = std::find(s.paths.begin(), s.paths.end(), held);
  profile->interactionProfile = found == s.paths.end() ? XR_NULL_PATH : XrPath(found - s.paths.begin()) + 1;
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL create_space(XrSession session, const XrActionSpaceCreateInfo* info, XrSpace* made) {
  State& s = object<State>(session);
  const int hand = hand_of(s, info->subactionPath);
  if (hand < 0) return XR_ERROR_PATH_UNSUPPORTED;
  if (object<Action>(info->action).type != XR_ACTION_TYPE_POSE_INPUT) return XR_ERROR_ACTION_TYPE_MISMATCH;
  s.spaces.push_back(std::make_unique<Space>(Space{s, Space::Kind::hand, hand, pose_from(info->poseInActionSpace)}));
  *made = handle<XrSpace>(s.spaces.back().get());
  return XR_SUCCESS;
}

// What was done between two frames and is over by now still counts in the one that follows.
XRAPI_ATTR XrResult XRAPI_CALL sync(XrSession session, const XrActionsSyncInfo* info) {
  State& s = object<State>(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  for (const auto& set : s.sets) set->active = false;
  for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i) {
    ActionSet& set = object<ActionSet>(info->activeActionSets[i].actionSet);
    if (!set.attached) return XR_ERROR_ACTIONSET_NOT_ATTACHED;
    set.active = true;
  }
  s.synced_focused = has_focus(s);
  const double now_s = s.time_s(), before_s = s.synced_s;
  s.synced_s = now_s;
  s.values = {};
  if (!s.synced_focused) return XR_SESSION_NOT_FOCUSED;
  s.values = s.timeline.values(now_s);
  for (const ActionPress& press : s.timeline.presses(before_s, now_s))
    if (double& value = s.values[std::size_t(press.action)]; std::abs(value) < 0.5) value = press.value;
  return XR_SUCCESS;
}

// Whether a bare hand, or both of them, would need a controller to do it.
bool needs_a_controller(const State& s, seascape::Action action) {
  using seascape::Action;
  const auto [left, right] = s.options.bare_hands;
  if (left && right) return true;
  return (left && (action == Action::grab_left || action == Action::select_left)) ||
         (right && (action == Action::grab_right || action == Action::select_right));
}

// Of several inputs that are bound to an action, the one that is pressed or pushed farthest counts.
void read_inputs(const State& s, XrAction action, XrActionStateFloat& state) {
  const auto bindings = s.suggested.find(s.options.profile);
  if (bindings == s.suggested.end()) return;
  for (const SuggestedBinding& one : bindings->second) {
    if (one.action != action) continue;
    state.isActive = XR_TRUE;
    const auto input = s.inputs.find(one.input.substr(std::string_view("/user/hand/").size()));
    const float value = input == s.inputs.end() ? 0.0f : float(input->second);
    if (std::abs(value) > std::abs(state.currentState)) state.currentState = value;
  }
}

XRAPI_ATTR XrResult XRAPI_CALL get_float(XrSession session, const XrActionStateGetInfo* info,
                                         XrActionStateFloat* state) {
  const State& s = object<State>(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  const Action& action = object<Action>(info->action);
  if (action.type != XR_ACTION_TYPE_FLOAT_INPUT) return XR_ERROR_ACTION_TYPE_MISMATCH;
  state->isActive = XR_FALSE;
  state->currentState = 0.0f;
  if (!s.synced_focused || !action.set.active) return XR_SUCCESS;
  if (s.options.profile.empty()) {
    const auto named = action_named(action.name);
    state->isActive = named && !needs_a_controller(s, *named);
    if (state->isActive) state->currentState = float(s.values[std::size_t(*named)] / controller_value(*named));
  } else {
    read_inputs(s, info->action, *state);
  }
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL get_pose(XrSession session, const XrActionStateGetInfo* info, XrActionStatePose* state) {
  const State& s = object<State>(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  const int hand = hand_of(s, info->subactionPath);
  if (hand < 0) return XR_ERROR_PATH_UNSUPPORTED;
  state->isActive = s.synced_focused && !s.options.bare_hands[std::size_t(hand)] &&
                    s.timeline.pose(hand == 0 ? Tracker::left : Tracker::right, s.time_s()).has_value();
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL buzz(XrSession session, const XrHapticActionInfo* info, const XrHapticBaseHeader* how) {
  State& s = object<State>(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  const auto& vibration = *reinterpret_cast<const XrHapticVibration*>(how);
  s.buzzes.push_back(
      {s.time_s(), hand_of(s, info->subactionPath), double(vibration.amplitude), double(vibration.duration) * 1e-9});
  return XR_SUCCESS;
}

}  // namespace

PFN_xrVoidFunction action_call(std::string_view name) {
  SEASCAPE_SIMULATED(CreateActionSet, create_set)
  SEASCAPE_SIMULATED(DestroyActionSet, destroy_set)
  SEASCAPE_SIMULATED(CreateAction, create_action)
  SEASCAPE_SIMULATED(SuggestInteractionProfileBindings, suggest)
  SEASCAPE_SIMULATED(AttachSessionActionSets, attach)
  SEASCAPE_SIMULATED(GetCurrentInteractionProfile, get_profile)
  SEASCAPE_SIMULATED(CreateActionSpace, create_space)
  SEASCAPE_SIMULATED(SyncActions, sync)
  SEASCAPE_SIMULATED(GetActionStateFloat, get_float)
  SEASCAPE_SIMULATED(GetActionStatePose, get_pose)
  SEASCAPE_SIMULATED(ApplyHapticFeedback, buzz)
  return nullptr;
}

}  // namespace seascape::simulated
