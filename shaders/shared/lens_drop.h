// A drop of water on an eye's lens, as it is drawn.
#ifndef SEASCAPE_LENS_DROP_H
#define SEASCAPE_LENS_DROP_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

// Lengths are on the plane at distance 1 before the eye, so that they are tangents of angles.
struct LensDrop {
  vec4 place;  // x: to the right, y: up; z: its radius; w: the number of its eye
  vec4 shape;  // xy: how far it is drawn out behind, and where to; z: how much of it is there, 0 to 1; w: unused
};

SEASCAPE_SHARED_END
#endif
