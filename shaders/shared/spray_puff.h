// A puff of spray as it is drawn: one instance of a quad.
#ifndef SEASCAPE_SPRAY_PUFF_H
#define SEASCAPE_SPRAY_PUFF_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

struct SprayPuff {
  vec4 place;   // x, z: from the viewer along the sea, m; y: above the still sea, m; w: radius, m
  vec4 streak;  // xyz: half of the way that it is drawn out along, m; w: how much it hides, 0 to 1
  vec2 look;    // x: of which shape it is, 0 to 1; y: 0 mist to 1 drops that are told apart
};

SEASCAPE_SHARED_END
#endif
