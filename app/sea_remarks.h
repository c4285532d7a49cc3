// What of a scene's sea is not as its settings ask: a line each, for warnings and for plan.
#pragma once
#include <string>
#include <vector>

#include "app/scene.h"
#include "ocean/waves/sea_limits.h"

namespace seascape {

// The scene's waves and particles within what steepness and depth let stand; as they are where it calls for no waves.
LimitedSea limited_sea(const Scene& scene);

// Beside what was found when the scene was read: what is drawn lower than asked, what does not repeat with
// waves.loop_s, land that nothing draws, and things that float and whose insides cannot keep water out. Overrides
// count.
std::vector<std::string> remarks_of(const Scene& scene);

}  // namespace seascape
