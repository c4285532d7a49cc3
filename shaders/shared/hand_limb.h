// A rounded limb of a drawn hand, or of the mark where it aims.
#ifndef SEASCAPE_HAND_LIMB_H
#define SEASCAPE_HAND_LIMB_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

struct HandLimb {
  vec4 from, to;  // xyz: its ends relative to the viewer, m; w: its radius there, m
  vec4 colour;    // rgb: reflectance; w: 1 glows, and is seen so whatever the light
};

// A limb is a grid of quads: rings from one end's pole to the other's, and sides about its axis.
SEASCAPE_CONST int limb_rings = 7, limb_sides = 10;
SEASCAPE_CONST int limb_vertices = 6 * 7 * 10;

SEASCAPE_SHARED_END
#endif
