// Hands without controllers, of joints made here. Controls are named beside each test; each was seen to fail.
#include "platform/hand_gesture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace seascape {
namespace {

constexpr double frame_s = 1.0 / 72.0;

// A right hand whose palm looks down, fingers ahead; or its mirror image. Fingers bend by 75 degrees a joint where
// `fist` is 1; the tips of thumb and index are so far apart.
HandJoints joints(bool right, double fist, double apart_m, const Pose& at = {{0.2, 1.2, -0.4}}) {
  const double side = right ? 1.0 : -1.0;
  HandJoints all;
  for (Pose& joint : all) joint = at;
  const auto place = [&](std::size_t joint, const glm::dvec3& in_palm) {
    all[joint].position_m = at.position_m + at.orientation * (in_palm * glm::dvec3(side, 1.0, 1.0));
  };
  place(joint_wrist, {0.0, 0.0, 0.07});
  for (std::size_t finger = 0; finger < 4; ++finger) {
    const std::size_t first = joint_index_metacarpal + finger * joints_a_finger;
    glm::dvec3 bone{-0.03 + 0.02 * double(finger), 0.0, 0.02};
    place(first, bone);
    bone.z = -0.04;
    place(first + 1, bone);
    for (std::size_t i = 0; i < 3; ++i) {
      const double bent = glm::radians(75.0) * fist * double(i + 1);
      bone += 0.03 * glm::dvec3(0.0, -std::sin(bent), -std::cos(bent));
      place(first + 2 + i, bone);
    }
  }
  const glm::dvec3 index = glm::conjugate(at.orientation) * (all[joint_index_tip].position_m - at.position_m);
  place(joint_thumb_tip, index * glm::dvec3(side, 1.0, 1.0) + glm::dvec3(-apart_m, 0.0, 0.0));
  return all;
}

HandGesture seen(bool right, double fist, double apart_m) {
  HandGesture gesture(right);
  gesture.see(joints(right, 0.0, 0.06), 1.0);
  gesture.see(joints(right, fist, apart_m), 1.0 + frame_s);
  return gesture;
}

// Controls: the angle at the finger's root; the index among them; open_deg 0.
TEST(HandGesture, ClosesAsItsFingersBend) {
  for (const bool right : {false, true}) {
    EXPECT_EQ(seen(right, 0.0, 0.06).closed(), 0.0);
    EXPECT_EQ(seen(right, 0.2, 0.06).closed(), 0.0);  // at rest fingers are a little bent
    EXPECT_EQ(seen(right, 1.0, 0.06).closed(), 1.0);
    double last = 0.0;
    for (double fist = 0.3; fist < 0.75; fist += 0.05) {
      const double closed = seen(right, fist, 0.06).closed();
      EXPECT_GT(closed, last) << fist;
      last = closed;
    }
    HandJoints one = joints(right, 0.0, 0.06), other = joints(right, 1.0, 0.06);
    std::copy(other.begin() + joint_index_metacarpal, other.begin() + joint_index_tip + 1,
              one.begin() + joint_index_metacarpal);
    HandGesture gesture(right);
    gesture.see(one, 1.0);
    EXPECT_EQ(gesture.closed(), 0.0);  // by the index alone
  }
}

// Below 1.5 cm, and until over 2.5 cm. Controls: one bound for both, either of them; pinched in a fist.
TEST(HandGesture, PinchesWithHysteresis) {
  HandGesture gesture(true);
  int frame = 0;
  const auto pinches = [&](double apart_m, double fist = 0.0) {
    gesture.see(joints(true, fist, apart_m), 5.0 + frame_s * ++frame);
    return gesture.pinched();
  };
  EXPECT_FALSE(pinches(0.05));
  EXPECT_FALSE(pinches(0.02));
  EXPECT_FALSE(pinches(0.0151));
  EXPECT_TRUE(pinches(0.0149));
  EXPECT_TRUE(pinches(0.02));
  EXPECT_TRUE(pinches(0.0249));
  EXPECT_FALSE(pinches(0.0251));
  EXPECT_FALSE(pinches(0.02));
  EXPECT_TRUE(pinches(0.01));
  EXPECT_TRUE(pinches(0.01, 1.0));  // holds on
  EXPECT_FALSE(pinches(0.03, 1.0));
  EXPECT_FALSE(pinches(0.01, 1.0));
  EXPECT_TRUE(pinches(0.01));
}

// A hand that is lost, or seen for the first time, while it pinches or is a fist does so only after it was open.
// Controls: lose() that leaves was_apart_; that leaves was_open_.
TEST(HandGesture, LetsGoWhenItIsLost) {
  HandGesture gesture = seen(true, 1.0, 0.06);
  gesture.see(joints(true, 0.0, 0.06), 1.1);
  gesture.see(joints(true, 0.0, 0.01), 1.2);
  EXPECT_TRUE(gesture.pinched());
  gesture.lose();
  EXPECT_FALSE(gesture.pinched());
  EXPECT_FALSE(gesture.hand());
  EXPECT_EQ(gesture.closed(), 0.0);
  gesture.see(joints(true, 0.0, 0.01), 1.3);
  EXPECT_FALSE(gesture.pinched());
  EXPECT_TRUE(gesture.hand());
  gesture.see(joints(true, 0.0, 0.03), 1.4);
  gesture.see(joints(true, 0.0, 0.01), 1.5);
  EXPECT_TRUE(gesture.pinched());
  gesture.lose();
  for (const auto& [fist, closed] : {std::pair(1.0, 0.0), {0.9, 0.0}, {0.2, 0.0}, {1.0, 1.0}}) {
    gesture.see(joints(true, fist, 0.06), 1.6);
    EXPECT_EQ(gesture.closed(), closed) << fist;
  }
}

// Controls: is_a_hand() true for all; largest_m 10.
TEST(HandGesture, WhatCannotBeAHandIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const std::size_t joint : {joint_palm, joint_wrist, joint_thumb_tip, joint_index_tip, joint_little_tip})
    for (const glm::dvec3& at : {glm::dvec3(nan, 1.2, -0.4), glm::dvec3(0.2, inf, 0.0), glm::dvec3(0.2, 1.2, -5.4)}) {
      HandGesture gesture = seen(true, 0.0, 0.01);
      ASSERT_TRUE(gesture.pinched());
      HandJoints hostile = joints(true, 0.0, 0.01);
      hostile[joint].position_m = at;
      gesture.see(hostile, 2.0);
      EXPECT_FALSE(gesture.hand()) << joint;
      EXPECT_FALSE(gesture.pinched()) << joint;
    }
}

// The grip as OpenXR has it: in a fist held ahead with the thumb up, -z up along it and +x to the right in either hand.
// It points as the palm does, upright, after a while. Controls: the thumb at the other side; no smoothing; the velocity
// of a frame for that of a second.
TEST(HandGesture, PointsWhereThePalmDoes) {
  for (const bool right : {false, true}) {
    // The palm to the side, its back to the outside: its y is to the right in a right hand.
    const Pose palm{{0.2, 1.2, -0.4}, glm::angleAxis(glm::radians(right ? -90.0 : 90.0), glm::dvec3(0.0, 0.0, 1.0))};
    HandGesture gesture(right);
    gesture.see(joints(right, 0.0, 0.06, palm), 1.0);
    ASSERT_TRUE(gesture.hand());
    const Hand hand = *gesture.hand();
    const auto axis = [](const Pose& pose, const glm::dvec3& of) { return pose.orientation * of; };
    EXPECT_LT(glm::distance(axis(hand.grip, {0, 0, -1}), glm::dvec3(0, 1, 0)), 1e-9) << right;
    EXPECT_LT(glm::distance(axis(hand.grip, {1, 0, 0}), glm::dvec3(1, 0, 0)), 1e-9) << right;
    EXPECT_LT(glm::distance(axis(hand.aim, {0, 0, -1}), glm::dvec3(0, 0, -1)), 1e-9) << right;
    EXPECT_LT(glm::distance(axis(hand.aim, {0, 1, 0}), glm::dvec3(0, 1, 0)), 1e-9) << right;
    const Pose back = palm_of_grip(hand.grip, right);
    EXPECT_GT(std::abs(glm::dot(back.orientation, palm.orientation)), 1.0 - 1e-12);
    // Turned by 20 degrees and moved by 2 cm within a frame.
    const Pose turned{palm.position_m + glm::dvec3(0.02, 0.0, 0.0),
                      glm::angleAxis(glm::radians(20.0), glm::dvec3(0.0, 1.0, 0.0)) * palm.orientation};
    gesture.see(joints(right, 0.0, 0.06, turned), 1.0 + frame_s);
    EXPECT_NEAR(gesture.hand()->velocity_mps.x, 0.02 * 72.0, 1e-9);
    const auto turned_deg = [&] {
      const glm::dvec3 ahead = axis(gesture.hand()->aim, {0, 0, -1});
      return glm::degrees(std::atan2(-ahead.x, -ahead.z));
    };
    EXPECT_GT(turned_deg(), 2.0);
    EXPECT_LT(turned_deg(), 8.0);
    for (int frame = 2; frame < 30; ++frame) gesture.see(joints(right, 0.0, 0.06, turned), 1.0 + frame_s * frame);
    EXPECT_NEAR(turned_deg(), 20.0, 0.1);
    EXPECT_NEAR(gesture.hand()->velocity_mps.x, 0.0, 1e-9);
    gesture.see(joints(right, 0.0, 0.06, palm), 9.0);  // long after
    EXPECT_NEAR(turned_deg(), 0.0, 1e-9);
    EXPECT_NEAR(gesture.hand()->velocity_mps.x, 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace seascape
