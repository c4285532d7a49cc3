// Foam as shaders read it: windows around the viewer of how much of the water it covers, and the pattern that it breaks up into.
#ifndef SEASCAPE_FOAM_DATA_H
#define SEASCAPE_FOAM_DATA_H
#include "gpu_types.h"
#include "lod_windows.h"
SEASCAPE_SHARED_BEGIN

// Three layings of one tile, of sides that share no multiple; the second is turned one way and the third the other.
SEASCAPE_CONST float foam_side_m = 9.3f, foam_fine_side_m = 2.07f, foam_wide_side_m = 36.7f;
SEASCAPE_CONST float foam_lace_texels = 256.0f;  // a side; asked of the image it would leave a capability in shaders without foam
SEASCAPE_CONST float foam_turn_cos = 0.7986f, foam_turn_sin = 0.6018f;

struct FoamData {
  LodWindows windows;
  vec4 origin;  // of the grid in tile coordinates: xy of the first laying, zw of the second
  vec4 look;    // xy: of the third; z: what covers the water beyond the windows
};

SEASCAPE_SHARED_END
#endif
