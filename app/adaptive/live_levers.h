// The levers that move between frames: their steps, what each saves, and what it costs the eye.
#pragma once
#include <span>
#include <vector>

#include "app/adaptive/lever.h"
#include "app/drawn_quality.h"

namespace seascape {

// What a scene has that a lever can lower.
struct Lowered {
  bool models = false, spray = false, shadows = false, foam = false;
  bool anisotropic = false;  // water.anisotropy is above 1
};

// The levers of a scene. Errors are mean FLIP (app/lab/flip.h) against the finest step, as `seascape lab --curve
// levers` measures them.
std::vector<Lever> live_levers(const Lowered& scene);

// What a frame is drawn with at these levels.
DrawnQuality drawn_quality(std::span<const Lever> levers, const LeverLevels& levels);
// The levels whose steps are nearest to it.
LeverLevels nearest_levels(std::span<const Lever> levers, const DrawnQuality& quality);

}  // namespace seascape
