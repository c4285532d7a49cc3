// What a hand that holds no controller does, from where its joints are: it points, closes and pinches. Pure.
#pragma once
#include <array>
#include <optional>

#include "platform/input.h"

namespace seascape {

// The joints that are asked for, in the order of XR_EXT_hand_tracking.
enum HandJoint : std::size_t {
  joint_palm = 0,
  joint_wrist = 1,
  joint_thumb_tip = 5,
  joint_index_metacarpal = 6,  // then proximal, intermediate, distal and tip; and so on for each finger
  joint_index_tip = 10,
  joint_little_tip = 25,
};
inline constexpr std::size_t hand_joints = 26;
inline constexpr std::size_t joints_a_finger = 5;

// Each lies in metres from the middle of the floor; -z along its bone to the tip, +y out of the hand's back.
using HandJoints = std::array<Pose, hand_joints>;

class HandGesture {
 public:
  explicit HandGesture(bool right) : right_(right) {}

  // What it is at `time_s`, of a clock that need not go evenly. Joints that cannot be a hand's are none.
  void see(const HandJoints& joints, double time_s);
  // It is not seen any more, and lets go. It closes and pinches again only after it was open.
  void lose();

  const std::optional<Hand>& hand() const { return hand_; }
  double closed() const { return closed_; }  // the fingers but the index: 0 open to 1 a fist
  bool pinched() const { return pinched_; }  // thumb and index meet

 private:
  bool right_;
  std::optional<Hand> hand_;
  double closed_ = 0.0, seen_s_ = 0.0;
  bool pinched_ = false, was_apart_ = false, was_open_ = false;  // since it was lost
};

// Where a controller's grip would be in a hand of this palm, whose -z lies along the thumb's side of a fist, and
// whose +x is normal to the palm: the palm of a grip.
Pose grip_of_palm(const Pose& palm, bool right);
Pose palm_of_grip(const Pose& grip, bool right);

}  // namespace seascape
