#include "platform/simulated_runtime.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "platform/simulated_state.h"

namespace seascape {

namespace simulated {

namespace {

XRAPI_ATTR XrResult XRAPI_CALL get_instance_proc_addr(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  for (const auto find : {instance_call, session_call, picture_call, action_call, hand_call})
    if ((*function = find(name)) != nullptr) return XR_SUCCESS;
  return XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

}  // namespace simulated

using State = SimulatedRuntime::State;

SimulatedRuntime::SimulatedRuntime(const SimulatedOptions& options) : state_(std::make_unique<State>(options)) {
  state_->chained = {XR_TYPE_UNKNOWN, nullptr, state_.get()};
}

SimulatedRuntime::~SimulatedRuntime() = default;

PFN_xrGetInstanceProcAddr SimulatedRuntime::get() const { return simulated::get_instance_proc_addr; }
const void* SimulatedRuntime::next() const { return &state_->chained; }
void SimulatedRuntime::set_input(const std::string& path, double value) { state_->inputs[path] = value; }
void SimulatedRuntime::set_lens(double lens) {
  state_->options.lens = lens;
  for (const std::uint32_t eye : {0u, 1u}) {
    XrEventDataVisibilityMaskChangedKHR event{XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR};
    event.session = simulated::handle<XrSession>(state_.get());
    event.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    event.viewIndex = eye;
    state_->push(event);
  }
}
std::size_t SimulatedRuntime::frames_ended() const { return state_->ended; }
std::size_t SimulatedRuntime::frames_shown() const { return state_->shown; }
const std::vector<SimulatedBuzz>& SimulatedRuntime::buzzes() const { return state_->buzzes; }

void State::go(XrSessionState state) {
  session_state = state;
  XrEventDataSessionStateChanged event{XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED};
  event.session = simulated::handle<XrSession>(this);
  event.state = state;
  event.time = time();
  push(event);
}

// Through all states between, as OpenXR has it: a session that is shown is one that runs.
void State::go_towards(XrSessionState goal) {
  constexpr XrSessionState ladder[] = {XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE,
                                       XR_SESSION_STATE_FOCUSED};
  const auto rung = [&](XrSessionState state) { return int(std::find(ladder, ladder + 3, state) - ladder); };
  const int to = rung(goal);
  int at = session_state == XR_SESSION_STATE_READY ? -1 : rung(session_state);
  if (at > 2) return;  // on its way out
  while (at != to) go(ladder[at += at < to ? 1 : -1]);
}

Pose State::head_at(double time_s) const {
  return timeline.pose(Tracker::head, time_s).value_or(Pose{{0.0, 1.7, 0.0}});
}

void State::follow_script() {
  const double now_s = time_s();
  for (const StateChange& change : timeline.states(before_s, now_s)) {
    switch (change.state) {
      case HeadsetState::unfocused:
        focused = false;
        break;
      case HeadsetState::focused:
        focused = true;
        on = true;
        break;
      case HeadsetState::off:
        on = false;
        break;
      case HeadsetState::lost:
        lost = true;
        break;
      case HeadsetState::recentred: {
        const Pose head = head_at(change.time_s);
        floor = {{head.position_m.x, 0.0, head.position_m.z}, heading(head.orientation)};
        for (const XrReferenceSpaceType type :
             {XR_REFERENCE_SPACE_TYPE_LOCAL, XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT}) {
          XrEventDataReferenceSpaceChangePending event{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING};
          event.session = simulated::handle<XrSession>(this);
          event.referenceSpaceType = type;
          event.changeTime = time();
          push(event);
        }
        break;
      }
      case HeadsetState::closed:
        leaving = true;
        break;
    }
    if (change.state == HeadsetState::off || change.state == HeadsetState::focused) {
      XrEventDataUserPresenceChangedEXT event{XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT};
      event.session = simulated::handle<XrSession>(this);
      event.isUserPresent = on;
      push(event);
    }
  }
  if (options.ends && now_s > timeline.end_s()) leaving = true;
  before_s = now_s;
  if (!focused || !on) synced_s = now_s;  // what is done meanwhile is meant for others
  if (lost) return;
  if (leaving) {
    if (session_state == XR_SESSION_STATE_STOPPING) return;
    go_towards(XR_SESSION_STATE_SYNCHRONIZED);
    go(XR_SESSION_STATE_STOPPING);
    return;
  }
  go_towards(!on ? XR_SESSION_STATE_SYNCHRONIZED : focused ? XR_SESSION_STATE_FOCUSED : XR_SESSION_STATE_VISIBLE);
}

std::optional<Pose> State::place(const simulated::Space& space, double time_s) const {
  using Kind = simulated::Space::Kind;
  constexpr double eyes_m = 1.6;  // of who calls LOCAL what is ahead of his eyes
  std::optional<Pose> at;
  switch (space.kind) {
    case Kind::view:
      at = timeline.pose(Tracker::head, time_s);
      break;
    case Kind::hand:
      at = timeline.pose(space.hand == 0 ? Tracker::left : Tracker::right, time_s);
      break;
    case Kind::local:
      at = composed(floor, Pose{{0.0, eyes_m, 0.0}});
      break;
    case Kind::local_floor:
      at = floor;
      break;
    case Kind::stage:
      at = Pose{};
      break;
  }
  if (!at) return std::nullopt;
  return composed(*at, space.offset);
}

}  // namespace seascape
