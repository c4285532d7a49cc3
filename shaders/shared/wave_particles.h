// The sizes in which the tile of wave particles is laid over the sea, for C++ and GLSL alike.
#ifndef SEASCAPE_WAVE_PARTICLES_H
#define SEASCAPE_WAVE_PARTICLES_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN

// The golden number's inverse and the plastic number's fourth power's: no small multiple of a laying's side is near one
// of another's, as it would be at 2/3 and 1/3, where all three repeat together every two sides.
SEASCAPE_CONST int max_particle_layings = 3;
SEASCAPE_CONST float particle_size_1 = 0.6180339887f;
SEASCAPE_CONST float particle_size_2 = 0.3247179572f;

SEASCAPE_SHARED_END
#endif
