// What the shader of comfort is told of a frame, for all eyes alike.
#ifndef SEASCAPE_COMFORT_DATA_H
#define SEASCAPE_COMFORT_DATA_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

struct ComfortData {
  vec4 ahead;  // xyz: where the head looks, world axes, of unit length; w: how much of the horizon's line shows, 0 to 1
  vec4 edge;   // x: radians from there that stay clear; y: radians outside them until it is dark; z, w: unused
};

SEASCAPE_SHARED_END
#endif
