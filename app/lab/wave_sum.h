// The sum of a tile's waves in double precision: what the lab holds tiles against.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "ocean/waves/wave_field.h"

namespace seascape {

// Height in metres of a cascade's waves of fewer than `half_band` waves a side each way (bins_of(cascade) / 2: of all),
// at tile coordinates (x, z), from 0 to 1 over its side, at a time in ticks.
double wave_sum(const WaveBins& bins, int cascade, int half_band, std::int64_t ticks, glm::dvec2 at);

}  // namespace seascape
