#include "app/actions_doc.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <map>
#include <string_view>
#include <vector>

#include "engine/text.h"
#include "platform/bindings.h"

namespace seascape {

namespace {

// Keys whose code is not what is printed on them.
const std::map<int, std::string_view> key_names{
    {GLFW_KEY_RIGHT, "right arrow"},
    {GLFW_KEY_LEFT, "left arrow"},
    {GLFW_KEY_UP, "up arrow"},
    {GLFW_KEY_DOWN, "down arrow"},
    {GLFW_KEY_LEFT_SHIFT, "left Shift"},
    {GLFW_KEY_RIGHT_SHIFT, "right Shift"},
    {GLFW_KEY_TAB, "Tab"},
    {GLFW_KEY_SPACE, "Space"},
    {GLFW_KEY_ESCAPE, "Esc"},
    {GLFW_KEY_ENTER, "Enter"},
    {GLFW_KEY_LEFT_CONTROL, "left Ctrl"},
    {GLFW_KEY_RIGHT_CONTROL, "right Ctrl"},
    {GLFW_KEY_BACKSPACE, "Backspace"},
    {GLFW_KEY_DELETE, "Del"},
    {GLFW_KEY_HOME, "Home"},
    {GLFW_KEY_END, "End"},
    {GLFW_KEY_PAGE_UP, "Page Up"},
    {GLFW_KEY_PAGE_DOWN, "Page Down"},
};

std::string key_name(int key) {
  if (const auto found = key_names.find(key); found != key_names.end()) return std::string(found->second);
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return "F" + std::to_string(1 + key - GLFW_KEY_F1);
  if (key > GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT) return {char(key)};  // as in ASCII
  return "key " + std::to_string(key);
}

constexpr std::string_view button_names[] = {"A",
                                             "B",
                                             "X",
                                             "Y",
                                             "left bumper",
                                             "right bumper",
                                             "back",
                                             "start",
                                             "guide",
                                             "left stick pressed",
                                             "right stick pressed",
                                             "pad up",
                                             "pad right",
                                             "pad down",
                                             "pad left"};
static_assert(std::size(button_names) == GLFW_GAMEPAD_BUTTON_LAST + 1);
constexpr std::string_view axis_names[] = {"left stick x",  "left stick y", "right stick x",
                                           "right stick y", "left trigger", "right trigger"};
static_assert(std::size(axis_names) == GLFW_GAMEPAD_AXIS_LAST + 1);

std::string part_name(const GamepadBinding& binding) {
  const auto which = std::size_t(binding.which);
  return std::string(binding.part == GamepadBinding::Part::button ? button_names[which] : axis_names[which]);
}

// "left/input/thumbstick/x" as "left thumbstick x".
std::string part_name(const ControllerBinding& binding) {
  std::string name(binding.path);
  if (const auto at = name.find("/input/"); at != std::string::npos) name.replace(at, 7, " ");
  if (name.ends_with("/value")) name.erase(name.size() - 6);
  for (char& letter : name)
    if (letter == '/') letter = ' ';
  return name;
}

// An entry of a cell: "A (-1, aboard)".
template <class Binding>
void add_to(std::string& cell, const std::string& name, const Binding& binding) {
  std::string remark = binding.value < 0.0 ? text_from(binding.value) : "";
  if (binding.post != Post::anywhere)
    remark += (remark.empty() ? "" : ", ") + std::string(binding.post == Post::afoot ? "afoot" : "aboard");
  cell += (cell.empty() ? "" : "; ") + name + (remark.empty() ? "" : " (" + remark + ")");
}

std::string keys_of(Action action) {
  std::string cell;
  for (const KeyBinding& binding : key_bindings())
    if (binding.action == action) add_to(cell, key_name(binding.key), binding);
  return cell;
}

template <class Bindings>
std::string parts_of(const Bindings& bindings, Action action) {
  std::string cell;
  for (const auto& binding : bindings)
    if (binding.action == action) add_to(cell, part_name(binding), binding);
  return cell;
}

// Profiles that bind alike share a column: "oculus touch, meta touch plus".
struct Column {
  std::string name;
  std::span<const ControllerBinding> bindings;
};

std::vector<Column> columns() {
  std::vector<Column> all;
  for (const ControllerProfile& profile : controller_profiles()) {
    std::string name(profile.path.substr(profile.path.find('/', 1) + 1));  // "oculus/touch_controller"
    for (char& letter : name)
      if (letter == '/' || letter == '_') letter = ' ';
    if (const auto at = name.find(" controller"); at != std::string::npos) name.erase(at, 11);
    if (!all.empty() && all.back().bindings.data() == profile.bindings.data())
      all.back().name += ", " + name;
    else
      all.push_back({name, profile.bindings});
  }
  return all;
}

}  // namespace

std::string actions_document() {
  std::string text =
      "# Actions\n\n"
      "What a person can ask for, whatever he asks with. Written from the tables in `platform/actions.cpp` and "
      "`platform/bindings.cpp` by\n"
      "`SEASCAPE_WRITE_DOCS=1 ctest --preset release -R ActionsDoc`; a test compares them. Files name actions as the "
      "first column does\n"
      "([paths.md](paths.md)). A `press` is 0 or 1 and counts as it comes, an `amount` goes from 0 to 1, an `axis` "
      "from "
      "-1 to 1.\n\n"
      "Behind what asks for an action stands in brackets the value that it gives, unless 1 at its positive end, and "
      "where it holds:\n"
      "aboard a boat, or afoot. Keys are named as the US layout has them.\n\n"
      "| Action | Kind | What it does | Keys | Gamepad |\n|---|---|---|---|---|\n";
  constexpr std::string_view kinds[] = {"press", "amount", "axis"};
  for (const ActionRow& row : action_rows())
    text += "| `" + std::string(row.name) + "` | " + std::string(kinds[std::size_t(row.kind)]) + " | " +
            std::string(row.sentence) + " | " + keys_of(row.action) + " | " + parts_of(gamepad_bindings(), row.action) +
            " |\n";

  text += "\n## Controllers of a headset\n\nActions that no controller asks for are in the panel.\n\n| Action |";
  const std::vector<Column> profiles = columns();
  for (const Column& column : profiles) text += " " + column.name + " |";
  text += "\n|---|";
  for (std::size_t i = 0; i < profiles.size(); ++i) text += "---|";
  text += "\n";
  for (const ActionRow& row : action_rows()) {
    std::string cells;
    bool asked = false;
    for (const Column& column : profiles) {
      const std::string cell = parts_of(column.bindings, row.action);
      asked = asked || !cell.empty();
      cells += " " + cell + " |";
    }
    if (asked) text += "| `" + std::string(row.name) + "` |" + cells + "\n";
  }
  return text;
}

}  // namespace seascape
