// Rain: drops that fall on the water, the same ones for every viewer and every start.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ocean/places/rain_settings.h"
#include "ocean/places/wave_level.h"

namespace seascape {

// Appends the drops of ticks `first` to first + count - 1, `rate_hz` ticks a second, that fall within `reach_m` of a
// place along either axis. Each adds its hump over the time of all these ticks. In each cell of the world there falls a
// drop in a tick or none (Bernoulli's trials, which tend to a Poisson process: a cell and a tick expect 0.05 drops at
// most), by a hash of cell and tick: which drops fall does not depend on the viewer. The plane is one of 2^31 cells a
// side that repeats.
void add_rain(const RainSettings& settings, std::int64_t first, std::int64_t count, double rate_hz, glm::dvec2 place_m,
              double reach_m, std::vector<WaveSource>& sources);

}  // namespace seascape
