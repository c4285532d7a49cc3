// The simulated runtime's calls of OpenXR that are about hands without controllers: they are where the script has them,
// close as it grabs, and pinch as it selects.
#include <algorithm>

#include "platform/bindings.h"
#include "platform/hand_gesture.h"
#include "platform/simulated_state.h"

namespace seascape::simulated {

namespace {

using State = SimulatedRuntime::State;

XRAPI_ATTR XrResult XRAPI_CALL create_tracker(XrSession session, const XrHandTrackerCreateInfoEXT* info,
                                              XrHandTrackerEXT* made) {
  State& s = object<State>(session);
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (!s.sees_hands()) return XR_ERROR_FEATURE_UNSUPPORTED;
  const int hand = info->hand == XR_HAND_LEFT_EXT ? 0 : 1;
  s.trackers.push_back(std::make_unique<HandTracker>(HandTracker{s, hand}));
  *made = handle<XrHandTrackerEXT>(s.trackers.back().get());
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL destroy_tracker(XrHandTrackerEXT tracker) {
  auto& all = object<HandTracker>(tracker).of.trackers;
  std::erase_if(all, [&](const auto& one) { return handle<XrHandTrackerEXT>(one.get()) == tracker; });
  return XR_SUCCESS;
}

// Of a palm with its thumb's side at `thumb` of x, in the palm's axes; metres.
HandJoints joints_of(double thumb, double closed, double pinched) {
  HandJoints joints{};
  joints[joint_wrist].position_m = {0.0, 0.0, 0.08};
  for (std::size_t finger = 0; finger < 4; ++finger) {
    const std::size_t first = joint_index_metacarpal + finger * joints_a_finger;
    glm::dvec3 at(thumb * (0.03 - 0.02 * double(finger)), 0.0, 0.03);
    joints[first].position_m = at;
    at.z = -0.045;
    joints[first + 1].position_m = at;
    constexpr double bone_m[] = {0.045, 0.025, 0.02};
    for (std::size_t bone = 0; bone < 3; ++bone) {
      const double bent = glm::radians(75.0) * closed * double(bone + 1);
      at += bone_m[bone] * glm::dvec3(0.0, -std::sin(bent), -std::cos(bent));
      joints[first + 2 + bone].position_m = at;
    }
  }
  constexpr std::size_t thumb_metacarpal = 2;
  const glm::dvec3 root(thumb * 0.03, -0.01, 0.04), apart(thumb * 0.08, -0.02, -0.05);
  const glm::dvec3 met = joints[joint_index_tip].position_m + glm::dvec3(0.0, -0.008, 0.0);
  const glm::dvec3 tip = glm::mix(apart, met, pinched);
  for (std::size_t i = 0; i < 4; ++i) joints[thumb_metacarpal + i].position_m = glm::mix(root, tip, double(i) / 3.0);
  return joints;
}

XRAPI_ATTR XrResult XRAPI_CALL locate_joints(XrHandTrackerEXT tracker, const XrHandJointsLocateInfoEXT* info,
                                             XrHandJointLocationsEXT* to) {
  const HandTracker& what = object<HandTracker>(tracker);
  const State& s = what.of;
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (to->jointCount != hand_joints) return XR_ERROR_VALIDATION_FAILURE;
  const double at_s = s.script_s(info->time);
  const bool left = what.hand == 0;
  const std::optional<Pose> in = s.place(object<Space>(info->baseSpace), at_s);
  const std::optional<Pose> grip = s.timeline.pose(left ? Tracker::left : Tracker::right, at_s);
  to->isActive = in && grip;
  for (std::size_t i = 0; i < hand_joints; ++i) to->jointLocations[i].locationFlags = 0;
  if (!to->isActive) return XR_SUCCESS;
  const auto value = [&](seascape::Action action) { return s.values[std::size_t(action)]; };
  const HandJoints joints =
      joints_of(left ? 1.0 : -1.0, value(left ? seascape::Action::grab_left : seascape::Action::grab_right),
                value(left ? seascape::Action::select_left : seascape::Action::select_right));
  const Pose palm = composed(inverse(*in), palm_of_grip(*grip, !left));
  for (std::size_t i = 0; i < hand_joints; ++i) {
    XrHandJointLocationEXT& joint = to->jointLocations[i];
    joint.locationFlags = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT |
                          XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
    joint.pose = xr_pose(composed(palm, joints[i]));
    joint.radius = 0.01f;
  }
  return XR_SUCCESS;
}

}  // namespace

PFN_xrVoidFunction hand_call(std::string_view name) {
  SEASCAPE_SIMULATED(CreateHandTrackerEXT, create_tracker)
  SEASCAPE_SIMULATED(DestroyHandTrackerEXT, destroy_tracker)
  SEASCAPE_SIMULATED(LocateHandJointsEXT, locate_joints)
  return nullptr;
}

}  // namespace seascape::simulated
