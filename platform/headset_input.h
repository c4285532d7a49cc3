// A headset's controllers: their buttons and sticks as actions, where the hands are, and what they feel. A hand without
// one grabs by closing, and selects by pinching.
#pragma once
#include <array>
#include <map>

#include "platform/bindings.h"
#include "platform/headset_hands.h"
#include "platform/headset_system.h"
#include "platform/xr_pose.h"

namespace seascape {

inline constexpr XrPosef nowhere{{0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};  // else: no offset

class HeadsetInput {
 public:
  // Suggests the bindings of every profile that the runtime knows and attaches them to the session.
  HeadsetInput(const HeadsetSystem& system, XrSession session);
  ~HeadsetInput();
  HeadsetInput(const HeadsetInput&) = delete;
  HeadsetInput& operator=(const HeadsetInput&) = delete;

  // Between xrWaitFrame and xrBeginFrame: reads what is done at `post`, and where the hands will be at `time` in
  // `space`. Of the left-handed, sticks and buttons of the other hand count (mirrored()). Without the focus nothing is
  // done and no hand is there. A hand that is not tracked lets go, and closes again only after it was open.
  void sync(XrSession session, XrSpace space, XrTime time, Post post, bool left_handed, bool focused);
  bool focused() const { return focused_; }  // in the last sync()
  // Adds it to a frame's actions.
  void gather(InputGatherer& gatherer) const;
  const std::array<std::optional<Hand>, 2>& hands() const { return hands_; }
  // What buzzes in a hand (0 left, 1 right): strength 0 to 1, for a time (s).
  void buzz(XrSession session, int hand, double strength, double seconds) const;
  // The profile in use, or "" while there is none; after an event that it changed.
  std::string profile(XrSession session) const;

 private:
  void make_action(XrActionSet set, const char* name, const char* title, XrActionType type, bool of_hands,
                   XrAction& action);
  void make_actions(bool left_handed);
  void suggest(const ControllerProfile& profile);
  std::optional<Pose> located(XrSpace what, XrSpace in, XrTime time, glm::dvec3* velocity_mps) const;
  void see_hand(std::size_t hand, XrSpace space, XrTime time);
  void let_go();

  const HeadsetSystem& system_;
  HeadsetHands seen_;
  std::array<HandGesture, 2> gestures_{HandGesture(false), HandGesture(true)};
  // Bindings are fixed once they are attached, so each action is there twice: for the right-handed and for the
  // left-handed.
  struct Side {
    std::array<XrActionSet, 3> sets{};  // of each Post
    std::array<XrAction, action_count> actions{};
  };
  std::array<Side, 2> sides_;
  std::array<Post, action_count> posts_{};
  std::array<double, action_count> values_{};
  XrAction grip_ = XR_NULL_HANDLE, aim_ = XR_NULL_HANDLE, buzz_ = XR_NULL_HANDLE;
  std::array<XrPath, 2> hand_paths_{};
  std::array<XrSpace, 2> grips_{}, aims_{};
  std::array<std::optional<Hand>, 2> hands_;
  bool focused_ = false;
  std::array<bool, 2> let_go_{};  // closed since it was lost
};

}  // namespace seascape
