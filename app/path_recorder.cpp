#include "app/path_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/input_script_file.h"
#include "app/located_json.h"

namespace seascape {

namespace {

// The most that a key and an event hold of what a file is limited to, beside their text: indentation, brackets, an
// event's time.
constexpr std::size_t bytes_around_key = 8, bytes_around_event = 48;
constexpr std::size_t values_of_key = 11, values_of_event = 12;  // the most: a pose with its time
// One frame never takes more, unless somebody presses keys by the hundred.
constexpr std::size_t spare_bytes = 1 << 16, spare_values = 1 << 12;

bool is_finite(const Pose& pose) {
  const glm::dvec3& p = pose.position_m;
  const glm::dquat& q = pose.orientation;
  return std::isfinite(p.x + p.y + p.z) && std::isfinite(q.x + q.y + q.z + q.w);
}

bool same(const std::optional<Pose>& a, const std::optional<Pose>& b) {
  if (!a || !b) return !a && !b;
  return a->position_m == b->position_m && a->orientation == b->orientation;
}

// As a file may have it.
double in_range(Action action, double value) {
  return std::isfinite(value) ? std::clamp(value, row_of(action).least(), 1.0) : 0.0;
}

}  // namespace

// A pose of each frame is kept to a ten-millionth: in half the text, so that twice as many fit in a file.
Pose PathRecorder::kept(const Pose& pose) const {
  if (!by_frames()) return pose;
  const auto rounded = [](double x) { return std::round(x * 1e7) / 1e7; };
  const glm::dvec3& p = pose.position_m;
  const glm::dquat& q = pose.orientation;
  return {{rounded(p.x), rounded(p.y), rounded(p.z)},
          glm::dquat(rounded(q.w), rounded(q.x), rounded(q.y), rounded(q.z))};
}

double PathRecorder::path_time(double time_s) const {
  const double at_s = time_s - began_s_;
  return by_frames() ? std::round(at_s * every_.rate_hz) / every_.rate_hz : at_s;
}

bool PathRecorder::has_room() {
  if (path_.keys.size() >= most_path_keys)
    full_ = "the path has " + std::to_string(most_path_keys) + " keys, the most that one may have";
  else if (bytes_ + spare_bytes > largest_json_bytes || json_values_ + spare_values > most_json_values)
    full_ = "the path fills a file of 16 MiB, the largest that is read";
  return full_.empty();
}

void PathRecorder::add_key(double at_s, const Pose& pose, double scene_time_s) {
  const PathKey key{at_s, kept(pose), scene_time_s};
  bytes_ += path_key_text(key).size() + bytes_around_key;
  json_values_ += values_of_key;
  path_.keys.push_back(key);
}

void PathRecorder::add_event(double at_s, decltype(InputEvent::what) what) {
  const InputEvent event{at_s, std::move(what)};
  const bool shares = !events_.empty() && share_an_event(events_.back(), event);
  bytes_ += input_event_text(event).size() + (shares ? 2 : bytes_around_event);
  events_.push_back(event);
  json_values_ += values_of_event;
}

void PathRecorder::add_hands(double at_s, const RecordedInput& input) {
  std::array<std::optional<Pose>, 2> now = input.hands;
  for (std::optional<Pose>& pose : now) pose = pose && is_finite(*pose) ? std::optional(kept(*pose)) : std::nullopt;
  // A hand that was still until the last frame moves from there on, not from when it came to rest.
  for (std::size_t i = 0; i < hands_.size(); ++i)
    if (hands_[i].pose && now[i] && !same(hands_[i].pose, now[i]) && hands_[i].written_s < last_s_)
      add_event(last_s_, TrackerEvent{Tracker(1 + i), hands_[i].pose});
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    if (same(hand.pose, now[i])) continue;
    if (!hand.ever_written && at_s > 0.0)  // else its first pose would hold from the beginning
      events_.insert(events_.begin(), {0.0, TrackerEvent{Tracker(1 + i), std::nullopt}});
    add_event(at_s, TrackerEvent{Tracker(1 + i), now[i]});
    hand = {now[i], at_s, true};
  }
}

void PathRecorder::add_actions(double at_s, const RecordedInput& input) {
  const auto change = [&](Action action, double value) {
    if (values_[std::size_t(action)] == value) return;
    add_event(at_s, ActionEvent{action, value});
    values_[std::size_t(action)] = value;
  };
  for (const ActionPress& press : input.presses) {
    const double value = in_range(press.action, press.value);
    if (!is_press(0.0, value)) continue;
    if (!is_press(values_[std::size_t(press.action)], value)) change(press.action, 0.0);  // let go of, and again
    change(press.action, value);
  }
  for (const ActionRow& row : action_rows())
    change(row.action, in_range(row.action, input.values[std::size_t(row.action)]));
}

void PathRecorder::start(double time_s, const Pose& pose, double scene_time_s, Every every) {
  *this = PathRecorder();
  recording_ = true;
  every_ = every;
  began_s_ = time_s;
  add_key(0.0, pose, scene_time_s);
}

void PathRecorder::sample(double time_s, const Pose& pose, double scene_time_s, const RecordedInput& input) {
  if (!recording_ || !full_.empty()) return;
  const double at_s = std::max(path_time(time_s), last_s_);
  const double last_key_s = path_.keys.back().time_s;
  const bool key_is_due = by_frames() ? at_s > last_key_s : at_s >= last_key_s + key_every_s;
  if ((key_is_due || at_s > last_s_) && !has_room()) return;
  add_hands(at_s, input);
  add_actions(at_s, input);
  if (key_is_due)
    add_key(at_s, pose, scene_time_s);
  else if (by_frames())  // on the same beat as the frame before: a display is never quite even
    path_.keys.back() = {at_s, kept(pose), scene_time_s};
  last_s_ = at_s;
}

CameraPath PathRecorder::stop(double time_s, const Pose& pose, double scene_time_s, const std::string& name) {
  recording_ = false;
  const double at_s = path_time(time_s);
  // The last pose belongs to the path; a key a moment before it would only make it jerk.
  constexpr double least_s = 0.05;
  if (full_.empty() && !by_frames() && path_.keys.size() > 1 && at_s < path_.keys.back().time_s + least_s)
    path_.keys.pop_back();
  if (full_.empty() && has_room() && at_s > path_.keys.back().time_s) add_key(at_s, pose, scene_time_s);
  if (!events_.empty()) {
    path_.actions.emplace();
    if (by_frames()) path_.actions->rate_hz = every_.rate_hz;
    path_.actions->events = std::move(events_);
  }
  path_.name = name;
  return std::exchange(path_, {});
}

}  // namespace seascape
