#include "platform/headset_input.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstring>

namespace seascape {

namespace {

constexpr const char* set_names[2][3] = {{"anywhere", "afoot", "aboard"},
                                         {"anywhere_left_handed", "afoot_left_handed", "aboard_left_handed"}};
constexpr const char* set_titles[2][3] = {{"Anywhere", "Afoot", "In a boat"},
                                          {"Anywhere, left-handed", "Afoot, left-handed", "In a boat, left-handed"}};
constexpr const char* hand_names[] = {"/user/hand/left", "/user/hand/right"};

}  // namespace

HeadsetInput::HeadsetInput(const HeadsetSystem& system, XrSession session) : system_(system), seen_(system, session) {
  const XrApi& api = system.api();
  try {
    for (std::size_t h = 0; h < 2; ++h) hand_paths_[h] = system.path(hand_names[h]);
    for (const bool left_handed : {false, true}) make_actions(left_handed);
    const XrActionSet set = sides_[0].sets[0];
    make_action(set, "grip", "hand", XR_ACTION_TYPE_POSE_INPUT, true, grip_);
    make_action(set, "aim", "pointing", XR_ACTION_TYPE_POSE_INPUT, true, aim_);
    make_action(set, "buzz", "feel", XR_ACTION_TYPE_VIBRATION_OUTPUT, true, buzz_);
    for (const ControllerProfile& profile : controller_profiles())
      if (profile.extension.empty() || system.uses(profile.extension)) suggest(profile);
    for (std::size_t h = 0; h < 2; ++h)
      for (const auto& [action, space] : {std::pair{grip_, &grips_[h]}, std::pair{aim_, &aims_[h]}}) {
        XrActionSpaceCreateInfo info{XR_TYPE_ACTION_SPACE_CREATE_INFO};
        info.action = action;
        info.subactionPath = hand_paths_[h];
        info.poseInActionSpace.orientation.w = 1.0f;
        check_xr(api.CreateActionSpace(session, &info, space), "xrCreateActionSpace");
      }
    std::vector<XrActionSet> all;
    for (const Side& side : sides_) all.insert(all.end(), side.sets.begin(), side.sets.end());
    XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO};
    attach.countActionSets = std::uint32_t(all.size());
    attach.actionSets = all.data();
    check_xr(api.AttachSessionActionSets(session, &attach), "xrAttachSessionActionSets");
  } catch (...) {
    for (const Side& side : sides_)
      for (XrActionSet set : side.sets)
        if (set) api.DestroyActionSet(set);
    throw;
  }
}

HeadsetInput::~HeadsetInput() {
  const XrApi& api = system_.api();
  for (std::size_t h = 0; h < 2; ++h)
    for (XrSpace space : {grips_[h], aims_[h]})
      if (space) api.DestroySpace(space);
  for (const Side& side : sides_)
    for (XrActionSet set : side.sets) api.DestroyActionSet(set);
}

void HeadsetInput::make_actions(bool left_handed) {
  Side& side = sides_[left_handed];
  for (std::size_t i = 0; i < side.sets.size(); ++i) {
    XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO};
    std::strcpy(info.actionSetName, set_names[left_handed][i]);
    std::strcpy(info.localizedActionSetName, set_titles[left_handed][i]);
    check_xr(system_.api().CreateActionSet(system_.instance(), &info, &side.sets[i]), "xrCreateActionSet");
  }
  for (const ActionRow& row : action_rows()) {
    const std::size_t i = std::size_t(row.action);
    posts_[i] = controller_post(row.action);
    std::string title(row.name);
    for (char& c : title)
      if (c == '_') c = ' ';
    make_action(side.sets[std::size_t(posts_[i])], std::string(row.name).c_str(), title.c_str(),
                XR_ACTION_TYPE_FLOAT_INPUT, false, side.actions[i]);
  }
}

void HeadsetInput::make_action(XrActionSet set, const char* name, const char* title, XrActionType type, bool of_hands,
                               XrAction& action) {
  XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO};
  std::strncpy(info.actionName, name, sizeof info.actionName - 1);
  std::strncpy(info.localizedActionName, title, sizeof info.localizedActionName - 1);
  info.actionType = type;
  info.countSubactionPaths = of_hands ? 2 : 0;
  info.subactionPaths = of_hands ? hand_paths_.data() : nullptr;
  check_xr(system_.api().CreateAction(set, &info, &action), "xrCreateAction");
}

void HeadsetInput::suggest(const ControllerProfile& profile) {
  std::vector<XrActionSuggestedBinding> all;
  for (const bool left_handed : {false, true})
    for (const ControllerBinding& binding : profile.bindings) {
      const bool mirror = left_handed && !stays_with_its_hand(binding.action);
      const std::string path = mirror ? mirrored(profile, binding.path) : std::string(binding.path);
      all.push_back({sides_[left_handed].actions[std::size_t(binding.action)], system_.path("/user/hand/" + path)});
    }
  for (const char* hand : hand_names) {
    all.push_back({grip_, system_.path(fmt::format("{}/input/grip/pose", hand))});
    all.push_back({aim_, system_.path(fmt::format("{}/input/aim/pose", hand))});
    all.push_back({buzz_, system_.path(fmt::format("{}/output/haptic", hand))});
  }
  XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
  info.interactionProfile = system_.path(std::string(profile.path));
  info.countSuggestedBindings = std::uint32_t(all.size());
  info.suggestedBindings = all.data();
  const XrResult result = system_.api().SuggestInteractionProfileBindings(system_.instance(), &info);
  if (result == XR_ERROR_INSTANCE_LOST) throw HeadsetLost("xrSuggestInteractionProfileBindings");
  // A runtime need not know every controller.
  if (XR_FAILED(result)) spdlog::info("headset: no bindings for {}: {}", profile.path, xr_result_name(result));
}

std::optional<Pose> HeadsetInput::located(XrSpace what, XrSpace in, XrTime time, glm::dvec3* velocity_mps) const {
  XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
  XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
  location.next = &velocity;
  check_xr(system_.api().LocateSpace(what, in, time, &location), "xrLocateSpace");
  constexpr XrSpaceLocationFlags known = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  if ((location.locationFlags & known) != known || !pose_is_sound(location.pose)) return std::nullopt;
  if (velocity_mps && (velocity.velocityFlags & XR_SPACE_VELOCITY_LINEAR_VALID_BIT)) {
    const auto& v = velocity.linearVelocity;
    const glm::dvec3 told(v.x, v.y, v.z);
    if (glm::length(told) < 100.0) *velocity_mps = told;
  }
  return pose_from(location.pose);
}

void HeadsetInput::sync(XrSession session, XrSpace space, XrTime time, Post post, bool left_handed, bool focused) {
  values_.fill(0.0);
  hands_ = {};
  focused_ = false;
  if (!focused) return;
  const XrApi& api = system_.api();
  const Side& side = sides_[left_handed];
  std::array<XrActiveActionSet, 3> active{{{sides_[0].sets[0], XR_NULL_PATH}}};  // where the hands are
  XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO};
  info.countActiveActionSets = 1;
  const auto activate = [&](Post of) {
    active[info.countActiveActionSets++] = {side.sets[std::size_t(of)], XR_NULL_PATH};
  };
  if (left_handed) activate(Post::anywhere);
  if (post != Post::anywhere) activate(post);
  info.activeActionSets = active.data();
  if (check_xr(api.SyncActions(session, &info), "xrSyncActions") == XR_SESSION_NOT_FOCUSED) return;
  focused_ = true;
  for (const ActionRow& row : action_rows()) {
    const std::size_t i = std::size_t(row.action);
    if (!holds_at(posts_[i], post)) continue;
    XrActionStateGetInfo get{XR_TYPE_ACTION_STATE_GET_INFO};
    get.action = side.actions[i];
    XrActionStateFloat state{XR_TYPE_ACTION_STATE_FLOAT};
    check_xr(api.GetActionStateFloat(session, &get, &state), "xrGetActionStateFloat");
    if (state.isActive && std::isfinite(state.currentState)) values_[i] = double(state.currentState);
  }
  for (std::size_t h = 0; h < 2; ++h) {
    XrActionStateGetInfo get{XR_TYPE_ACTION_STATE_GET_INFO};
    get.action = grip_;
    get.subactionPath = hand_paths_[h];
    XrActionStatePose state{XR_TYPE_ACTION_STATE_POSE};
    check_xr(api.GetActionStatePose(session, &get, &state), "xrGetActionStatePose");
    if (!state.isActive) {
      see_hand(h, space, time);
      continue;
    }
    gestures_[h].lose();
    Hand hand;
    const std::optional<Pose> grip = located(grips_[h], space, time, &hand.velocity_mps);
    if (!grip) continue;
    hand.grip = *grip;
    hand.aim = located(aims_[h], space, time, nullptr).value_or(*grip);
    hands_[h] = hand;
  }
  let_go();
}

void HeadsetInput::see_hand(std::size_t hand, XrSpace space, XrTime time) {
  HandGesture& gesture = gestures_[hand];
  if (const std::optional<HandJoints> joints = seen_.joints(hand, space, time))
    gesture.see(*joints, double(time) * 1e-9);
  else
    gesture.lose();
  hands_[hand] = gesture.hand();
  if (!gesture.hand()) return;
  const auto at_least = [&](Action action, double value) {
    values_[std::size_t(action)] = std::max(values_[std::size_t(action)], value);
  };
  at_least(hand == 0 ? Action::grab_left : Action::grab_right, gesture.closed());
  at_least(hand == 0 ? Action::select_left : Action::select_right, gesture.pinched() ? 1.0 : 0.0);
}

void HeadsetInput::let_go() {
  for (std::size_t h = 0; h < 2; ++h) {
    constexpr double open = 1.0 / 3.0;  // as InputGatherer has it
    double& grab = values_[std::size_t(h == 0 ? Action::grab_left : Action::grab_right)];
    if (grab < open)
      let_go_[h] = false;
    else if (!hands_[h])
      let_go_[h] = true;
    if (!hands_[h] || let_go_[h]) grab = 0.0;
  }
}

void HeadsetInput::gather(InputGatherer& gatherer) const {
  for (const ActionRow& row : action_rows())
    if (const double value = values_[std::size_t(row.action)]; value != 0.0) {
      constexpr double at_rest = 0.1;  // a stick hardly ever stands in its middle; runtimes see to the rest
      if (row.kind != ActionKind::axis || std::abs(value) >= at_rest)
        gatherer.add(row.action, value * controller_value(row.action));
    }
}

void HeadsetInput::buzz(XrSession session, int hand, double strength, double seconds) const {
  XrHapticActionInfo what{XR_TYPE_HAPTIC_ACTION_INFO};
  what.action = buzz_;
  what.subactionPath = hand_paths_[std::size_t(hand)];
  XrHapticVibration how{XR_TYPE_HAPTIC_VIBRATION};
  how.duration = XrDuration(seconds * 1e9);
  how.frequency = XR_FREQUENCY_UNSPECIFIED;
  how.amplitude = float(std::clamp(strength, 0.0, 1.0));
  const XrResult result =
      system_.api().ApplyHapticFeedback(session, &what, reinterpret_cast<const XrHapticBaseHeader*>(&how));
  if (result == XR_ERROR_INSTANCE_LOST) throw HeadsetLost("xrApplyHapticFeedback");
  // A hand that feels nothing is no fault.
}

std::string HeadsetInput::profile(XrSession session) const {
  for (const XrPath hand : {hand_paths_[1], hand_paths_[0]}) {
    XrInteractionProfileState state{XR_TYPE_INTERACTION_PROFILE_STATE};
    if (XR_FAILED(system_.api().GetCurrentInteractionProfile(session, hand, &state))) continue;
    if (state.interactionProfile == XR_NULL_PATH) continue;
    char text[XR_MAX_PATH_LENGTH] = {};
    std::uint32_t length = 0;
    if (XR_SUCCEEDED(
            system_.api().PathToString(system_.instance(), state.interactionProfile, sizeof text, &length, text)))
      return text;
  }
  return {};
}

}  // namespace seascape
