#include "app/input_script_file.h"

#include <algorithm>
#include <array>

#include "app/located_pose.h"
#include "app/picture_size.h"
#include "app/scene.h"
#include "engine/files.h"
#include "engine/text.h"

namespace seascape {

namespace {

constexpr std::array<std::string_view, 3> tracker_names{"head", "left", "right"};  // in the order of Tracker

enum class Use { headset, path };

std::vector<std::string_view> action_names() {
  std::vector<std::string_view> names;
  for (const ActionRow& row : action_rows()) names.push_back(row.name);
  return names;
}

FovAngles read_eye(const LocatedJson& json, const std::string& name, const std::string& where) {
  if (!json.is(LocatedJson::Kind::array) || json.items.size() != 4)
    throw Error(where + ":" + std::to_string(json.line), name + ": " + described(json) + " is not a list of 4 numbers",
                "write [left, right, up, down] in degrees, as [-50, 45, 48, -50]");
  const std::vector<double> angles = numbers_of(json, name, 4, -89.0, 89.0, "deg", where);
  if (!(angles[0] < angles[1] && angles[3] < angles[2]))
    throw Error(where + ":" + std::to_string(json.line),
                name + ": " + (angles[0] < angles[1] ? "down is not below up" : "left is not left of right"),
                "write [left, right, up, down] with left < right and down < up, as [-50, 45, 48, -50]");
  return {angles[0], angles[1], angles[2], angles[3]};
}

// Reads one event, which may be of several things at once.
class EventReader {
 public:
  EventReader(InputScript& script, const LocatedJson& json, const std::string& name, const std::string& where,
              Faults& faults)
      : script_(script), json_(json), name_(name), where_(where), faults_(faults), reader_(json, name, where, faults) {}

  // Its time where it was read well.
  std::optional<double> read(Use use) {
    time_s_ = reader_.required_number("time_s", 0.0, 1e9, "s");
    for (std::size_t i = 0; i < tracker_names.size(); ++i) tracker(Tracker(i), use);
    action();
    state();
    reader_.finish();
    if (!json_.is(LocatedJson::Kind::object)) return std::nullopt;
    faults_.attempt([&] {
      for (const char* key : {"head", "left", "right", "action", "value", "state"})
        if (json_.member(key) != nullptr) return;
      throw Error(reader_.place(json_), name_ + ": nothing happens in it",
                  use == Use::path ? "give left, right, action and value, or state"
                                   : "give head, left, right, action and value, or state");
    });
    const LocatedJson* time = json_.member("time_s");
    const bool read_well = time != nullptr && time->is(LocatedJson::Kind::number) && time->number == time_s_;
    return read_well ? std::optional(time_s_) : std::nullopt;
  }

 private:
  void add(decltype(InputEvent::what) what) { script_.events.push_back({time_s_, std::move(what)}); }

  void tracker(Tracker tracker, Use use) {
    const std::string_view key = tracker_names[std::size_t(tracker)];
    const LocatedJson* found = reader_.optional(key);
    if (found == nullptr) return;
    if (use == Use::path && tracker == Tracker::head) {
      faults_.attempt([&] {
        throw Error(reader_.place(*found), reader_.key_name(key) + ": the head of a path is its keys",
                    "put its poses among \"keys\" and remove it here");
      });
      return;
    }
    if (found->is(LocatedJson::Kind::null)) return add(TrackerEvent{tracker, std::nullopt});
    ObjectReader pose(*found, reader_.key_name(key), where_, faults_);
    add(TrackerEvent{tracker, read_pose(pose, *found, where_, faults_)});
    pose.finish();
  }

  void action() {
    const LocatedJson* found = reader_.optional("action");
    if (found == nullptr) {
      if (const LocatedJson* value = reader_.optional("value"))
        faults_.attempt([&] {
          throw Error(reader_.place(*value), reader_.key_name("value") + ": it is no action's",
                      "add \"action\": the name of one, as \"throttle\"");
        });
      return;
    }
    std::optional<Action> action;
    faults_.attempt([&] {
      if (found->is(LocatedJson::Kind::text)) action = action_named(found->text);
      if (!action) throw unknown("action", *found, action_names());
    });
    const double least = action ? row_of(*action).least() : -1.0;
    const double value = reader_.required_number("value", least, 1.0, "");
    if (action) add(ActionEvent{*action, value});
  }

  void state() {
    const LocatedJson* found = reader_.optional("state");
    if (found == nullptr) return;
    const auto names = headset_state_names();
    faults_.attempt([&] {
      for (std::size_t i = 0; i < names.size(); ++i)
        if (found->is(LocatedJson::Kind::text) && names[i] == found->text) return add(HeadsetState(i));
      throw unknown("state", *found, {names.begin(), names.end()});
    });
  }

  Error unknown(std::string_view key, const LocatedJson& found, const std::vector<std::string_view>& names) const {
    return {reader_.place(found),
            reader_.key_name(key) + ": " + described(found) + " is not known" + did_you_mean(found.text, names),
            "take " + listed(names)};
  }

  InputScript& script_;
  const LocatedJson& json_;
  const std::string& name_;
  const std::string& where_;
  Faults& faults_;
  ObjectReader reader_;
  double time_s_ = 0.0;
};

void read_events(InputScript& script, const LocatedJson& events, const std::string& name, const std::string& where,
                 Faults& faults, Use use) {
  const auto at = [&](const LocatedJson& json) { return where + ":" + std::to_string(json.line); };
  if (!events.is(LocatedJson::Kind::array) || events.items.size() > most_input_events)
    throw Error(at(events), name + ": " + described(events), "give a list of at most 1000000 events");
  std::optional<double> last_s;  // that was read well: a faulty time is one fault, and not of the next event too
  for (std::size_t i = 0; i < events.items.size(); ++i) {
    const LocatedJson& entry = events.items[i];
    const std::string event_name = name + "[" + std::to_string(i) + "]";
    const std::optional<double> time_s = EventReader(script, entry, event_name, where, faults).read(use);
    if (!time_s) continue;
    faults.attempt([&] {
      if (last_s && *time_s < *last_s)
        throw Error(at(entry),
                    event_name + ".time_s: " + text_from(*time_s) + " comes before " + text_from(*last_s) +
                        " of the event before",
                    "order the events by time_s");
    });
    last_s = time_s;
  }
}

InputScript read_script(const LocatedJson& json, const std::string& name, const std::string& where, Faults& faults,
                        Use use) {
  InputScript script;
  ObjectReader reader(json, name, where, faults);
  reader.version();
  if (const LocatedJson* size = reader.optional("size"))
    faults.attempt([&] {
      std::string fault = "is not text";
      const auto pixels = size->is(LocatedJson::Kind::text) ? picture_size_from(size->text, fault) : std::nullopt;
      if (!pixels)
        throw Error(reader.place(*size), reader.key_name("size") + ": " + described(*size) + " " + fault,
                    "give two whole numbers from 1 to 16384, as \"1440x1584\"");
      script.width = (*pixels)[0];
      script.height = (*pixels)[1];
    });
  script.rate_hz = reader.number("rate_hz", 1.0, 1000.0, script.rate_hz, "Hz");
  script.eye_distance_m = reader.number("eye_distance_m", 0.0, 1.0, script.eye_distance_m, "m");
  if (const LocatedJson* fov = reader.optional("fov_deg")) {
    ObjectReader both(*fov, reader.key_name("fov_deg"), where, faults);
    for (std::size_t eye = 0; eye < 2; ++eye)
      if (const LocatedJson* found = both.optional(tracker_names[1 + eye]))
        faults.attempt([&] { script.eyes[eye] = read_eye(*found, both.key_name(tracker_names[1 + eye]), where); });
    both.finish();
  }
  const LocatedJson* events =
      reader.required("events", "\"events\": [{\"time_s\": 0, \"" + std::string(use == Use::path ? "left" : "head") +
                                    "\": {\"position_m\": [0, 1.7, 0]}}, ...]");
  reader.finish();
  if (events != nullptr)
    faults.attempt([&] { read_events(script, *events, reader.key_name("events"), where, faults, use); });
  return script;
}

std::string eye_text(const FovAngles& eye) {
  return "[" + text_from(eye.left_deg) + ", " + text_from(eye.right_deg) + ", " + text_from(eye.up_deg) + ", " +
         text_from(eye.down_deg) + "]";
}

// Where a thing stands in its event.
std::size_t place_in_event(const InputEvent& event) {
  if (const auto* tracker = std::get_if<TrackerEvent>(&event.what)) return std::size_t(tracker->tracker);
  return tracker_names.size() + (std::holds_alternative<ActionEvent>(event.what) ? 0 : 1);
}

}  // namespace

InputScript parse_input_script(std::string_view text, const std::string& where, Faults& faults) {
  InputScript script;
  faults.attempt([&] { script = read_script(parse_located_json(text, where), "", where, faults, Use::headset); });
  return script;
}

InputScript parse_input_script(std::string_view text, const std::string& where) {
  Faults thrown;
  return parse_input_script(text, where, thrown);
}

InputScript load_input_script(const std::string& name_or_file) {
  const std::filesystem::path file = content_file(name_or_file, "inputs");
  return parse_input_script(read_text(file, largest_json_bytes), file.string());
}

InputScript read_path_actions(const LocatedJson& json, const std::string& name, const std::string& where,
                              Faults& faults) {
  return read_script(json, name, where, faults, Use::path);
}

std::string input_event_text(const InputEvent& event) {
  if (const auto* tracker = std::get_if<TrackerEvent>(&event.what))
    return "\"" + std::string(tracker_names[std::size_t(tracker->tracker)]) +
           "\": " + (tracker->pose ? "{" + pose_text(*tracker->pose) + "}" : "null");
  if (const auto* action = std::get_if<ActionEvent>(&event.what))
    return "\"action\": \"" + std::string(row_of(action->action).name) + "\", \"value\": " + text_from(action->value);
  return "\"state\": \"" + std::string(headset_state_names()[std::size_t(std::get<HeadsetState>(event.what))]) + "\"";
}

bool share_an_event(const InputEvent& last, const InputEvent& next) {
  return last.time_s == next.time_s && place_in_event(last) < place_in_event(next);
}

std::string input_script_object(const InputScript& script, const std::string& indent) {
  const std::string line = "\n" + indent + "  ";
  std::string text = "{" + line + "\"version\": 1," + line + "\"size\": \"" + std::to_string(script.width) + "x" +
                     std::to_string(script.height) + "\"," + line + "\"rate_hz\": " + text_from(script.rate_hz) + "," +
                     line + "\"eye_distance_m\": " + text_from(script.eye_distance_m) + "," + line +
                     "\"fov_deg\": {\"left\": " + eye_text(script.eyes[0]) +
                     ", \"right\": " + eye_text(script.eyes[1]) + "}," + line + "\"events\": [";
  const InputEvent* last = nullptr;
  for (const InputEvent& event : script.events) {
    if (last == nullptr || !share_an_event(*last, event))
      text += (last == nullptr ? "" : "},") + line + "  {\"time_s\": " + text_from(event.time_s);
    text += ", " + input_event_text(event);
    last = &event;
  }
  return text + (last == nullptr ? "]" : "}" + line + "]") + "\n" + indent + "}";
}

std::string input_script_text(const InputScript& script) { return input_script_object(script, "") + "\n"; }

}  // namespace seascape
