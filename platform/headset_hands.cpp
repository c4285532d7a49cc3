#include "platform/headset_hands.h"

#include <spdlog/spdlog.h>

#include "platform/xr_pose.h"

namespace seascape {

static_assert(hand_joints == XR_HAND_JOINT_COUNT_EXT && std::size_t(joint_palm) == XR_HAND_JOINT_PALM_EXT &&
              std::size_t(joint_wrist) == XR_HAND_JOINT_WRIST_EXT &&
              std::size_t(joint_thumb_tip) == XR_HAND_JOINT_THUMB_TIP_EXT &&
              std::size_t(joint_index_metacarpal) == XR_HAND_JOINT_INDEX_METACARPAL_EXT &&
              std::size_t(joint_index_tip) == XR_HAND_JOINT_INDEX_TIP_EXT &&
              std::size_t(joint_little_tip) == XR_HAND_JOINT_LITTLE_TIP_EXT);

namespace {

// Hands are no reason to end: without them there are controllers still.
bool succeeded(XrResult result, const char* call) {
  if (result == XR_ERROR_SESSION_LOST || result == XR_ERROR_INSTANCE_LOST) check_xr(result, call);
  return XR_SUCCEEDED(result);
}

}  // namespace

HeadsetHands::HeadsetHands(const HeadsetSystem& system, XrSession session) : api_(system.api()) {
  if (!system.facts().sees_hands || !api_.CreateHandTrackerEXT || !api_.DestroyHandTrackerEXT ||
      !api_.LocateHandJointsEXT)
    return;
  try {
    for (const std::size_t hand : {0u, 1u}) {
      XrHandTrackerCreateInfoEXT info{XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT};
      info.hand = hand == 0 ? XR_HAND_LEFT_EXT : XR_HAND_RIGHT_EXT;
      info.handJointSet = XR_HAND_JOINT_SET_DEFAULT_EXT;
      const XrResult result = api_.CreateHandTrackerEXT(session, &info, &trackers_[hand]);
      if (succeeded(result, "xrCreateHandTrackerEXT")) continue;
      trackers_[hand] = XR_NULL_HANDLE;
      spdlog::warn("headset: it does not see the {} hand: {}", hand == 0 ? "left" : "right", xr_result_name(result));
    }
  } catch (...) {
    if (trackers_[0]) api_.DestroyHandTrackerEXT(trackers_[0]);
    throw;
  }
}

HeadsetHands::~HeadsetHands() {
  for (XrHandTrackerEXT tracker : trackers_)
    if (tracker) api_.DestroyHandTrackerEXT(tracker);
}

std::optional<HandJoints> HeadsetHands::joints(std::size_t hand, XrSpace space, XrTime time) const {
  if (!trackers_[hand]) return std::nullopt;
  XrHandJointsLocateInfoEXT info{XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT};
  info.baseSpace = space;
  info.time = time;
  std::array<XrHandJointLocationEXT, hand_joints> found{};
  XrHandJointLocationsEXT locations{XR_TYPE_HAND_JOINT_LOCATIONS_EXT};
  locations.jointCount = std::uint32_t(found.size());
  locations.jointLocations = found.data();
  const XrResult result = api_.LocateHandJointsEXT(trackers_[hand], &info, &locations);
  if (!succeeded(result, "xrLocateHandJointsEXT") || !locations.isActive) return std::nullopt;
  HandJoints joints;
  constexpr XrSpaceLocationFlags known = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if ((found[i].locationFlags & known) != known || !pose_is_sound(found[i].pose)) return std::nullopt;
    joints[i] = pose_from(found[i].pose);
  }
  return joints;
}

}  // namespace seascape
