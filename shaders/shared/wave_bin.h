// One wave of a cascade's tile, and the numbers that both implementations of the sea share.
#ifndef SEASCAPE_WAVE_BIN_H
#define SEASCAPE_WAVE_BIN_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

// A cascade keeps the waves of its tile with whole wave numbers |m| < bins / 2. Its table is bins x bins, bin (mx, mz)
// at (mz + bins / 2) * bins + mx + bins / 2; row and column -bins / 2 are zero. The first cascade's tile is so long
// that nothing on the sea repeats within sight, and carries the highest waves all the same: it has long_tile_bins a
// side, the others wave_bins.
SEASCAPE_CONST int wave_bins = 64;
SEASCAPE_CONST int long_tile_bins = 256;
SEASCAPE_CONST int max_cascades = 5;

// Time is counted in whole ticks and frequency in turns a tick as a 64-bit fraction, so that the phase of a wave, their
// product modulo 2^64, is exact for centuries: h(k, t) = amplitude exp(-2 pi i phase) travels along +k.
SEASCAPE_CONST uint ticks_per_second = 1048576u;

struct WaveBin {
  vec2 amplitude;   // complex, metres; height = sum over bins of Re(amplitude exp(i(k.x - w t)))
  uint turns_high;  // turns a tick, times 2^64: upper and lower half
  uint turns_low;
};

SEASCAPE_SHARED_END
#endif
