// A bubble of air in the water as it is drawn: one instance of a quad.
#ifndef SEASCAPE_BUBBLE_H
#define SEASCAPE_BUBBLE_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

struct BubbleInstance {
  vec4 place;  // x, z: from the viewer along the sea, m; y: above the still sea, m; w: half of its width, m
  vec4 shape;  // x: its height over its width; y: turn of its wobble, rad; z: how much it wobbles; w: unused
};

SEASCAPE_SHARED_END
#endif
