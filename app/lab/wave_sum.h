// The sum of a tile's waves in double precision: what the lab holds tiles against.
#pragma once
#include <cstdint>

#include "ocean/waves/wave_field.h"

namespace seascape {

// Height in metres at texel (x, z) of a cascade's tile of `samples` texels a side, its waves raised as tiles carry them (drawn_amplitude), at a time in ticks.
double wave_sum(const WaveBins& bins, int cascade, int samples, std::int64_t ticks, int x, int z);

}  // namespace seascape
