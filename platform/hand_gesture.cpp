#include "platform/hand_gesture.h"

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {

constexpr double pinch_m = 0.015, let_go_m = 0.025;  // from the thumb's tip to the index's
constexpr double largest_m = 0.4;                    // from the palm to any joint
constexpr double open_deg = 50.0, fist_deg = 130.0;  // between a finger's outer half and the palm
constexpr double free_at = 1.0 / 3.0;                // as InputGatherer has it
constexpr double smooth_s = 0.05;                    // of where it points: the time in which two thirds are followed
constexpr double longest_gap_s = 0.25;               // a hand seen again after longer is where it is

glm::dvec3 ahead_of(const Pose& pose) { return pose.orientation * glm::dvec3(0.0, 0.0, -1.0); }

bool is_a_hand(const HandJoints& joints) {
  return std::all_of(joints.begin(), joints.end(), [&](const Pose& joint) {
    return glm::distance(joint.position_m, joints[joint_palm].position_m) < largest_m;  // nor is it where no number is
  });
}

// The mean of middle, ring and little finger: the index is needed to pinch and to point.
double closed_of(const HandJoints& joints) {
  const glm::dvec3 ahead = ahead_of(joints[joint_palm]);
  double sum = 0.0;
  for (std::size_t finger = 1; finger < 4; ++finger) {
    const std::size_t tip = joint_index_tip + finger * joints_a_finger;
    const glm::dvec3 along = joints[tip].position_m - joints[tip - 2].position_m;
    const double cosine = glm::dot(along, ahead) / std::max(glm::length(along), 1e-9);
    const double bent_deg = glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
    sum += std::clamp((bent_deg - open_deg) / (fist_deg - open_deg), 0.0, 1.0);
  }
  return sum / 3.0;
}

// Columns are where x, y and z of a grip lie in the palm's axes.
glm::dquat grip_in_palm(bool right) {
  const double side = right ? 1.0 : -1.0;  // the thumb is at the palm's -x in a right hand
  return glm::quat_cast(glm::dmat3(glm::dvec3(0.0, side, 0.0), glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(side, 0.0, 0.0)));
}

// Points along `ahead`, of unit length, with its own x as near to `x` as that goes.
glm::dquat pointing(const glm::dvec3& ahead, const glm::dvec3& x) {
  const glm::dvec3 back = -ahead;
  const glm::dvec3 right = glm::normalize(x - back * glm::dot(x, back));
  return glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back));
}

}  // namespace

Pose grip_of_palm(const Pose& palm, bool right) {
  return {palm.position_m, glm::normalize(palm.orientation * grip_in_palm(right))};
}

Pose palm_of_grip(const Pose& grip, bool right) {
  return {grip.position_m, glm::normalize(grip.orientation * glm::conjugate(grip_in_palm(right)))};
}

void HandGesture::lose() {
  hand_.reset();
  closed_ = 0.0;
  pinched_ = was_apart_ = was_open_ = false;
}

void HandGesture::see(const HandJoints& joints, double time_s) {
  if (!is_a_hand(joints)) return lose();
  const double passed_s = time_s - seen_s_;
  const bool followed = hand_ && passed_s > 0.0 && passed_s < longest_gap_s;
  seen_s_ = time_s;
  Hand hand;
  hand.grip = grip_of_palm(joints[joint_palm], right_);
  if (followed) hand.velocity_mps = (hand.grip.position_m - hand_->grip.position_m) / passed_s;
  // A pinch shakes the hand: where it points follows a little later.
  const glm::dvec3 ahead = ahead_of(joints[joint_palm]);
  glm::dvec3 aim = ahead;
  if (followed) aim = glm::mix(ahead_of(hand_->aim), ahead, 1.0 - std::exp(-passed_s / smooth_s));
  if (glm::length(aim) < 0.1) aim = ahead;  // turned about within a frame
  hand.aim = {hand.grip.position_m, pointing(glm::normalize(aim), hand.grip.orientation * glm::dvec3(1.0, 0.0, 0.0))};
  hand_ = hand;
  const double closed = closed_of(joints);
  was_open_ = was_open_ || closed < free_at;
  closed_ = was_open_ ? closed : 0.0;
  const double apart_m = glm::distance(joints[joint_thumb_tip].position_m, joints[joint_index_tip].position_m);
  was_apart_ = was_apart_ || apart_m > let_go_m;
  // In a fist they come near each other too.
  pinched_ = was_apart_ && (pinched_ ? apart_m <= let_go_m : apart_m < pinch_m && closed < 0.5);
}

}  // namespace seascape
