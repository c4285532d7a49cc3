#include "platform/actions.h"

namespace seascape {

namespace {

using enum Action;
using enum ActionKind;

constexpr std::array<ActionRow, action_count> rows{{
    {move_x, "move_x", axis, "Move to the right, or with a negative value to the left"},
    {move_z, "move_z", axis, "Move back, or with a negative value forward: -z is forward"},
    {move_y, "move_y", axis, "Move up or down, where one flies"},
    {turn, "turn", axis, "Turn to the right or left, for as long as it is held"},
    {snap_turn, "snap_turn", axis, "Turn to the right or left at once, by comfort.snap_turn_deg"},
    {teleport, "teleport", press, "Aim at the water while it is held; letting go moves there"},
    {swim, "swim", amount, "Swim: hands pull through the water while it is held; without hands one swims ahead"},
    {grab_left, "grab_left", amount, "Close the left hand"},
    {grab_right, "grab_right", amount, "Close the right hand"},
    {throttle, "throttle", axis, "A boat's throttle: ahead, or astern with a negative value"},
    {helm, "helm", axis, "A boat's helm: to starboard, or with a negative value to port"},
    {sheet, "sheet", amount, "A sail's sheet: hauled in, 0 eased out"},
    {oar_left, "oar_left", axis, "Pull the left oar, or push it with a negative value"},
    {oar_right, "oar_right", axis, "Pull the right oar, or push it with a negative value"},
    {board, "board", press, "Board a boat, or step off"},
    {menu, "menu", press, "Show or hide the panel"},
    {recentre, "recentre", press, "What lies ahead becomes forward, and the head's place the middle"},
    {light, "light", press, "A light on and off"},
    {mirror, "mirror", press, "The desktop's next view: left, right, both, from outside"},
    {screenshot, "screenshot", press, "Keep a picture"},
    {record, "record", press, "Begin and end recording a camera path"},
    {select_left, "select_left", amount, "Press what the left hand points at"},
    {select_right, "select_right", amount, "Press what the right hand points at"},
    {fast, "fast", amount, "Move five times as fast while it is held"},
    {look, "look", press, "Look around with the mouse, on and off"},
    {pitch, "pitch", axis, "Look up, or with a negative value down; a headset's own tracking does that"},
    {fly, "fly", press, "Travel by flying"},
    {walk, "walk", press, "Travel at deck height"},
    {ride, "ride", press, "Travel on the waves"},
    {pause, "pause", press, "Stop and start the sea's time"},
    {time_scale, "time_scale", axis, "Faster time, or with a negative value slower"},
    {scrub, "scrub", axis, "A second on in the sea's time, or with a negative value back; ten with fast"},
    {debug_view, "debug_view", press, "The next debug view"},
    {comfort, "comfort", press, "All that makes moving gentler off and on"},
    {leave, "leave", press, "Free the mouse, then close"},
    {moor, "moor", press, "Aboard: make fast to what is near, or cast off"},
    {anchor, "anchor", press, "Aboard: let go the anchor, or weigh it"},
    {respawn, "respawn", press, "Put the boat back where the scene has it"},
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::size_t(rows[i].action) != i) return false;
  return true;
}
static_assert(in_order());

}  // namespace

std::span<const ActionRow, action_count> action_rows() { return rows; }

std::optional<Action> action_named(std::string_view name) {
  for (const ActionRow& row : rows)
    if (row.name == name) return row.action;
  return std::nullopt;
}

}  // namespace seascape
