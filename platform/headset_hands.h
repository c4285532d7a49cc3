// The joints of hands that hold no controllers, where runtime and headset see them (XR_EXT_hand_tracking).
#pragma once
#include <array>
#include <optional>

#include "platform/hand_gesture.h"
#include "platform/headset_system.h"

namespace seascape {

class HeadsetHands {
 public:
  // The system outlives it. Without such an extension, or such eyes, it sees none. Throws SessionLost, HeadsetLost.
  HeadsetHands(const HeadsetSystem& system, XrSession session);
  ~HeadsetHands();
  HeadsetHands(const HeadsetHands&) = delete;
  HeadsetHands& operator=(const HeadsetHands&) = delete;

  // Of a hand (0 left, 1 right) at a time, in a space; nothing of one that is not seen whole, or makes no sense. Throws
  // SessionLost, HeadsetLost.
  std::optional<HandJoints> joints(std::size_t hand, XrSpace space, XrTime time) const;

 private:
  const XrApi& api_;
  std::array<XrHandTrackerEXT, 2> trackers_{};  // null: it does not see them
};

}  // namespace seascape
