// How far the waves of a detail lie off the whole sea: the waves that it lacks, and what sampling does to those it has.
#pragma once
#include "ocean/waves/wave_field.h"

namespace seascape {

// Variance of the height, m^2, by which tiles of this quality, read between their texels, miss the waves of `bins`: of
// the cascades that they lack all of it; of a wave with m of its lengths on a side of N texels, raised as tiles carry
// it (sampled_share), (raise^2 L(mx) L(mz) - 2 raise s + 1) of it, L(m) = (2 + cos(2 pi m / N)) / 3 being the mean
// square of a wave's linear interpolation and s what it keeps of the wave.
double left_out_variance(const WaveBins& bins, const WaveQuality& quality);

}  // namespace seascape
