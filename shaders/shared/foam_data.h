// Foam as shaders read it: windows around the viewer of how much of the water it covers, and the pattern that it breaks
// up into.
#ifndef SEASCAPE_FOAM_DATA_H
#define SEASCAPE_FOAM_DATA_H
#include "gpu_types.h"
#include "lod_windows.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::max;
using glm::min;
using glm::sqrt;
#endif

// Three layings of one tile, of sides that share no multiple; the second is turned one way and the third the other.
SEASCAPE_CONST float foam_side_m = 9.3f, foam_fine_side_m = 2.07f, foam_wide_side_m = 36.7f;
SEASCAPE_CONST float foam_lace_texels =
    256.0f;  // a side; asked of the image it would leave a capability in shaders without foam
SEASCAPE_CONST float foam_turn_cos = 0.7986f, foam_turn_sin = 0.6018f;

// Foam lies where the lace's even number is below foam_reach(): foam_thin opaque at its edge, and wholly from
// foam_depth below that on.
SEASCAPE_CONST float foam_thin = 0.5f, foam_depth = 0.4f;
// How thick foam is, 0 to 1, so far below its reach.
SEASCAPE_FUNCTION float foam_thickness(float below) { return min(max(below / foam_depth, 0.0f), 1.0f); }
// The reach whose mean opacity is this share (0 to 1) of the water.
SEASCAPE_FUNCTION float foam_reach(float share) {
  const float slope = 0.5f * (1.0f - foam_thin) / foam_depth,
              lacking = slope * foam_depth * foam_depth;  // the integral of what thin foam lacks
  if (share > 1.0f - lacking) return 1.0f + foam_depth - sqrt(max(1.0f - share, 0.0f) / slope);
  if (share > foam_depth - lacking) return share + lacking;
  return (sqrt(foam_thin * foam_thin + 4.0f * slope * share) - foam_thin) / (2.0f * slope);
}

struct FoamData {
  LodWindows windows;
  vec4 origin;  // of the grid in tile coordinates: xy of the first laying, zw of the second
  vec4 look;    // xy: of the third; z: what covers the water beyond the windows
  vec4 wind;    // xy: where it blows to, x and z; what it takes from a length along it, as it draws foam out: z in the
                // first two layings, w in the third
};

SEASCAPE_SHARED_END
#endif
