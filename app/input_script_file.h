// Input scripts as files (content/inputs/*.json) and as the "actions" of a camera path.
#pragma once
#include <string>
#include <string_view>

#include "app/faults.h"
#include "app/located_json.h"
#include "platform/input_script.h"

namespace seascape {

inline constexpr std::size_t most_input_events = 1'000'000;

// `name_or_file` is a path, or the name of one in content/inputs. Throws Error with file and line.
InputScript load_input_script(const std::string& name_or_file);
InputScript parse_input_script(std::string_view text, const std::string& where);
InputScript parse_input_script(std::string_view text, const std::string& where, Faults& faults);  // may collect

// The text of a file: every number reads back as the same double.
std::string input_script_text(const InputScript& script);

// A path's "actions" are the same object, but that its keys are the head and hands are in the world.
InputScript read_path_actions(const LocatedJson& json, const std::string& name, const std::string& where,
                              Faults& faults);
// The object alone, each line but its first behind `indent`.
std::string input_script_object(const InputScript& script, const std::string& indent);
// `"left": null`, `"action": "helm", "value": 1` or `"state": "off"`: a part of an event without its time.
std::string input_event_text(const InputEvent& event);
// Whether `next` is written into the event of `last`: at one time, where it reads back in this order.
bool share_an_event(const InputEvent& last, const InputEvent& next);

}  // namespace seascape
