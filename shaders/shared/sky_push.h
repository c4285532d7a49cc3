// Push constants of the passes that make the sky map.
#ifndef SEASCAPE_SKY_PUSH_H
#define SEASCAPE_SKY_PUSH_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

SEASCAPE_CONST int sky_map_width = 256;
SEASCAPE_CONST int sky_map_height = 128;
SEASCAPE_CONST int sky_multiple_size = 32;  // the table of multiple scattering, sun height by height

struct SkyPush {
  vec4 sun;  // xyz: towards the sun; w: haze, 1 a clear day
};

SEASCAPE_SHARED_END
#endif
