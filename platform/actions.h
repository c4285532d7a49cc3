// What a person can ask for, whatever he asks with: keys, a mouse, a gamepad, a headset's controllers or a file. Pure.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace seascape {

enum class Action : std::uint8_t {
  move_x,
  move_z,
  move_y,
  turn,
  snap_turn,
  teleport,
  swim,
  grab_left,
  grab_right,
  throttle,
  helm,
  sheet,
  oar_left,
  oar_right,
  board,
  menu,
  recentre,
  light,
  mirror,
  screenshot,
  record,
  select_left,
  select_right,
  fast,
  look,
  pitch,
  fly,
  walk,
  ride,
  pause,
  time_scale,
  scrub,
  debug_view,
  comfort,
  leave,
  moor,
  anchor,
  respawn,
};
inline constexpr std::size_t action_count = std::size_t(Action::respawn) + 1;

// press: 0 or 1, and what counts is that it comes; amount: 0 to 1; axis: -1 to 1.
enum class ActionKind { press, amount, axis };

struct ActionRow {
  Action action;
  std::string_view name;  // in files and docs
  ActionKind kind;
  std::string_view sentence;
  double least() const { return kind == ActionKind::axis ? -1.0 : 0.0; }
};

std::span<const ActionRow, action_count> action_rows();  // in the order of Action
inline const ActionRow& row_of(Action action) { return action_rows()[std::size_t(action)]; }
std::optional<Action> action_named(std::string_view name);

}  // namespace seascape
