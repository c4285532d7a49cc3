// What a person does with a headset, written down: poses of the head and the hands, actions and the headset's states by
// time. Plays the part of the person for the simulated headset, and of the hands in a recorded path. Pure.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/view.h"
#include "platform/actions.h"

namespace seascape {

enum class Tracker : std::uint8_t { head, left, right };

// What a runtime tells the program. unfocused: the runtime's own menu has the input; off: the headset lies on the
// table; lost: the session is gone; recentred: the person has chosen another middle; closed: he wants to leave.
enum class HeadsetState : std::uint8_t { unfocused, focused, off, lost, recentred, closed };
std::span<const std::string_view, 6> headset_state_names();  // in the order of HeadsetState

struct TrackerEvent {
  Tracker tracker = Tracker::head;
  std::optional<Pose> pose;  // nothing: lost until the tracker's next pose
};
struct ActionEvent {
  Action action = Action::move_x;
  double value = 0.0;  // from row_of(action).least() to 1; holds until the action's next event
};
struct InputEvent {
  double time_s = 0.0;
  std::variant<TrackerEvent, ActionEvent, HeadsetState> what;
};

// Half angles of an eye in degrees as files have them: left and down are negative for a usual view.
struct FovAngles {
  double left_deg = 0.0, right_deg = 0.0, up_deg = 0.0, down_deg = 0.0;
  Fov tangents() const;
};

struct InputScript {
  int width = 1440, height = 1584;  // pixels an eye
  double rate_hz = 90.0;            // frames a second
  double eye_distance_m = 0.063;
  std::array<FovAngles, 2> eyes{{{-50.0, 45.0, 48.0, -50.0}, {-45.0, 50.0, 48.0, -50.0}}};  // left, right
  std::vector<InputEvent> events;  // by rising time; those of one time count in their order
  double end_s() const { return events.empty() ? 0.0 : events.back().time_s; }
};

using ActionValues = std::array<double, action_count>;

// An action is pressed where its value comes to half or more, to either side.
bool is_press(double before, double value);

struct ActionPress {
  double time_s = 0.0;
  Action action = Action::move_x;
  double value = 1.0;  // its sign says to which side
};
struct StateChange {
  double time_s = 0.0;
  HeadsetState state = HeadsetState::focused;
};

// A script sorted by what it is about, so that each question takes the logarithm of its length. Any thread may ask.
class InputTimeline {
 public:
  explicit InputTimeline(const InputScript& script);

  // Nothing where tracking is lost. Between two poses positions go straight and orientations turn evenly; the first
  // event holds before it, the last after it. A head without any event stands 1.7 m above the floor's middle, and a
  // hand without any is lost.
  std::optional<Pose> pose(Tracker tracker, double time_s) const;
  // 0 before an action's first event.
  ActionValues values(double time_s) const;

  // What happened after `after_s` up to and with `to_s`, in order: also a press that is over by then. The first frame
  // asks from before 0.
  std::span<const ActionPress> presses(double after_s, double to_s) const;
  std::span<const StateChange> states(double after_s, double to_s) const;

  double end_s() const { return end_s_; }

 private:
  struct TrackedPose {
    double time_s;
    std::optional<Pose> pose;
  };
  struct ActionValue {
    double time_s, value;
  };
  std::array<std::vector<TrackedPose>, 3> trackers_;  // by Tracker
  std::array<std::vector<ActionValue>, action_count> actions_;
  std::vector<ActionPress> presses_;
  std::vector<StateChange> states_;
  double end_s_ = 0.0;
};

}  // namespace seascape
