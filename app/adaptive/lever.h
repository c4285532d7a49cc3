// What adaptive quality may lower to save frame time, and in which order it does so.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seascape {

// Whose time a frame takes.
enum class CostOf : std::uint8_t { gpu, cpu };

// When a lever may move: at any frame boundary, or only while a scene loads because it rebuilds pipelines or images.
enum class LeverMoves : std::uint8_t { between_frames, at_loading };

struct LeverStep {
  double value = 0.0;  // of the setting
  double work = 1.0;   // cost of the lever's variable part: 1 at the first step, falling
  double error = 0.0;  // what the eye loses: 0 at the first step, rising; the same unit for all levers
};

struct Lever {
  std::string_view name;         // the setting's key, or "picture scale"
  std::vector<LeverStep> steps;  // the finest first, at least one
  // The parts of a frame's GPU and CPU time that `work` scales, at the finest step. First guesses: the controller
  // corrects them as it runs. 0: the lever does not change that time, and is never moved for it.
  double gpu_share = 0.0, cpu_share = 0.0;
  LeverMoves moves = LeverMoves::between_frames;

  double share(CostOf of) const { return of == CostOf::gpu ? gpu_share : cpu_share; }
};

inline constexpr std::size_t most_levers = 16;
// The step of each lever; 0 is the finest.
using LeverLevels = std::array<std::uint8_t, most_levers>;

// One step of one lever. `error` is the sum over all levers up to this rung.
struct Rung {
  std::size_t lever = 0;
  std::uint8_t level = 0;
  double error = 0.0;
};

// The order in which levers are lowered for one kind of time, and given back in reverse: at each rung the step that
// costs the eye least for the time it saves (a greedy merge: optimal if each lever's error grows faster the further it
// is lowered). `levels` gives where levers that do not move stand.
std::vector<Rung> make_ladder(std::span<const Lever> levers, CostOf of);

// The error of levels, summed over the levers.
double error_of(std::span<const Lever> levers, const LeverLevels& levels);

// The natural logarithm of a lever's factor on the frame's time: its fixed part stays, its variable part is scaled.
// Filament and Unreal take the share as 1 (cost ~ area); with a fixed part they need several rounds to arrive.
double log_factor(double share, double work);

// "picture scale 1.4 to 1.22, spray.most 8000 to 4000"; empty if nothing differs.
std::string moves_text(std::span<const Lever> levers, const LeverLevels& from, const LeverLevels& to);

}  // namespace seascape
