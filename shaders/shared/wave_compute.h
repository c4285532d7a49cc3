// What the compute passes of the waves are told each frame.
#ifndef SEASCAPE_WAVE_COMPUTE_H
#define SEASCAPE_WAVE_COMPUTE_H
#include "gpu_types.h"
#include "wave_bin.h"
SEASCAPE_SHARED_BEGIN

// Push constants of wave_rows.comp and wave_columns.comp.
struct WavePush {
  uint ticks_high, ticks_low;  // the time
  int samples;                 // a side of the tiles
  float chop;
  vec4 wave_vector[max_cascades];  // xy: world wave vector of bin (1, 0) in rad/m; bin (0, 1) is that turned by 90
                                   // degrees; z: a length, a power of two, that brings dDx/dz to the size of Dz; w:
                                   // what sampling leaves of the texels' second moments (moment_share)
  float depth_m;                   // of the still water, 0 for deep
};

// Push constants of wave_mips.comp.
struct MipPush {
  int source_size;  // samples a side of the level read
  int levels;       // how many levels are written, 1 to 3
};

// The rows pass leaves (rows of the band) x columns complex values a field, 4 fields a cascade: field (cascade * 4 +
// f).
SEASCAPE_CONST int wave_fields = 4;

SEASCAPE_SHARED_END
#endif
