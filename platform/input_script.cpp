#include "platform/input_script.h"

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {

constexpr std::array<std::string_view, 6> state_names{"unfocused", "focused", "off", "lost", "recentred", "closed"};
static_assert(std::size_t(HeadsetState::closed) + 1 == state_names.size());

// The first of `events` that comes after `time_s`.
template <class Event>
auto first_after(const std::vector<Event>& events, double time_s) {
  return std::upper_bound(events.begin(), events.end(), time_s,
                          [](double time, const Event& event) { return time < event.time_s; });
}

template <class Event>
std::span<const Event> between(const std::vector<Event>& events, double after_s, double to_s) {
  const auto first = first_after(events, after_s), end = first_after(events, to_s);
  return first < end ? std::span<const Event>(first, end) : std::span<const Event>();
}

double tangent(double angle_deg) { return std::tan(glm::radians(angle_deg)); }

}  // namespace

std::span<const std::string_view, 6> headset_state_names() { return state_names; }

Fov FovAngles::tangents() const { return {tangent(left_deg), tangent(right_deg), tangent(up_deg), tangent(down_deg)}; }

bool is_press(double before, double value) {
  return std::abs(value) >= 0.5 && (std::abs(before) < 0.5 || std::signbit(before) != std::signbit(value));
}

InputTimeline::InputTimeline(const InputScript& script) : end_s_(script.end_s()) {
  ActionValues values{};
  for (const InputEvent& event : script.events) {
    if (const auto* tracker = std::get_if<TrackerEvent>(&event.what)) {
      trackers_[std::size_t(tracker->tracker)].push_back({event.time_s, tracker->pose});
    } else if (const auto* action = std::get_if<ActionEvent>(&event.what)) {
      double& value = values[std::size_t(action->action)];
      if (is_press(value, action->value)) presses_.push_back({event.time_s, action->action, action->value});
      value = action->value;
      actions_[std::size_t(action->action)].push_back({event.time_s, value});
    } else {
      states_.push_back({event.time_s, std::get<HeadsetState>(event.what)});
    }
  }
}

std::optional<Pose> InputTimeline::pose(Tracker tracker, double time_s) const {
  const std::vector<TrackedPose>& track = trackers_[std::size_t(tracker)];
  if (track.empty()) return tracker == Tracker::head ? std::optional(Pose{{0.0, 1.7, 0.0}}) : std::nullopt;
  const auto next = first_after(track, time_s);
  if (next == track.begin()) return track.front().pose;
  const TrackedPose& from = *(next - 1);
  if (next == track.end() || !from.pose || !next->pose || time_s == from.time_s) return from.pose;
  const double s = (time_s - from.time_s) / (next->time_s - from.time_s);
  return Pose{from.pose->position_m + s * (next->pose->position_m - from.pose->position_m),
              glm::normalize(glm::slerp(from.pose->orientation, next->pose->orientation, s))};
}

ActionValues InputTimeline::values(double time_s) const {
  ActionValues values{};
  for (std::size_t i = 0; i < action_count; ++i)
    if (const auto next = first_after(actions_[i], time_s); next != actions_[i].begin()) values[i] = (next - 1)->value;
  return values;
}

std::span<const ActionPress> InputTimeline::presses(double after_s, double to_s) const {
  return between(presses_, after_s, to_s);
}

std::span<const StateChange> InputTimeline::states(double after_s, double to_s) const {
  return between(states_, after_s, to_s);
}

}  // namespace seascape
