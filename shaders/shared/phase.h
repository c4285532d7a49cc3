// Exact phases of waves: the fraction of a turn after whole ticks, and its cosine and sine, the same in C++ and GLSL.
#ifndef SEASCAPE_PHASE_H
#define SEASCAPE_PHASE_H
#include "gpu_types.h"
#ifdef __cplusplus
#define SEASCAPE_FUNCTION inline
#else
#define SEASCAPE_FUNCTION
#endif
SEASCAPE_SHARED_BEGIN

// The upper 32 bits of (turns * ticks) modulo 2^64: the phase as a fraction of a turn, times 2^32. Negative ticks are
// given as two's complement.
SEASCAPE_FUNCTION uint phase_turns(uint turns_high, uint turns_low, uint ticks_high, uint ticks_low) {
#ifdef __cplusplus
  const std::uint64_t turns = (std::uint64_t(turns_high) << 32) | turns_low;
  const std::uint64_t ticks = (std::uint64_t(ticks_high) << 32) | ticks_low;
  return uint((turns * ticks) >> 32);
#else
  uint high, low;
  umulExtended(turns_low, ticks_low, high, low);
  return high + turns_high * ticks_low + turns_low * ticks_high;
#endif
}

// Cosine and sine of turns / 2^32 of a full turn, within 1e-7. The nearest quarter turn is taken off in integers, so
// that the polynomials (Chebyshev interpolation on an eighth of a turn either side, within 3e-9 before rounding) see
// an exact argument whatever the phase.
SEASCAPE_FUNCTION vec2 cos_sin_turns(uint turns) {
  uint quarter = (turns + 0x20000000u) >> 30u;
  float f = float(int(turns - (quarter << 30u))) * 2.3283064365386963e-10f;  // 2^-32
  float f2 = f * f;
  float s =
      f * (6.2831852878129455f + f2 * (-41.341662570547270f + f2 * (81.592542871205710f + f2 * -75.401612699015970f)));
  float c = 1.0f + f2 * (-19.739208789987394f +
                         f2 * (64.939369051373060f + f2 * (-85.448820084313820f + f2 * 59.424105800289940f)));
  bool swap = (quarter & 1u) != 0u;
  float x = swap ? s : c;
  float y = swap ? c : s;
  if (quarter == 1u || quarter == 2u) x = -x;
  if ((quarter & 2u) != 0u) y = -y;
  return vec2(x, y);
}

SEASCAPE_SHARED_END
#endif
