// Windows of waves that belong to bodies: where they lie, and how those that overlap are weighed.
#ifndef SEASCAPE_WAKE_WINDOWS_H
#define SEASCAPE_WAKE_WINDOWS_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::clamp;
#endif

SEASCAPE_CONST int max_wake_windows = 4, max_wake_levels = 3;
// Of half a window's side: within the first all of it is read, and beyond the second nothing. Its border absorbs waves
// from three quarters on (DynamicWaves), of which little is read.
SEASCAPE_CONST float wake_whole = 0.6f, wake_end = 0.85f;

struct WakeWindow {
  vec4 middle[max_wake_levels];  // x, y: x and z of the level's middle from the grid origin, m; z: how much of the
                                 // window there is, 0 to 1
  vec4 slice[max_wake_levels];   // x, y: the grid origin's coordinates in the texture; z: 1 / the side; w: a texel, m
  vec4 level[max_wake_levels];   // xyz: means of (dh/dx)^2, (dh/dz)^2, product over the window; w: 1, or 0 where it
                                 // rests
};

// Level l of window i in layer i max_wake_levels + l of its textures.
struct WakeData {
  WakeWindow window[max_wake_windows];
  vec4 half_m;  // x, y, z: half of each level's side, m; w: how much of the sideways displacement in the textures there
                // is
  ivec4 count;  // x: how many windows there are waves in; 0: none, and nothing is read
};

// How much of a window is read at a place, by its way from the middle: 1 in it, 0 outside, and smooth, so that its
// slope makes no waves.
SEASCAPE_FUNCTION float wake_present(vec2 from_middle, float half_m) {
  float x = clamp((wake_end - abs(from_middle.x) / half_m) / (wake_end - wake_whole), 0.0f, 1.0f);
  float z = clamp((wake_end - abs(from_middle.y) / half_m) / (wake_end - wake_whole), 0.0f, 1.0f);
  return x * x * (3.0f - 2.0f * x) * (z * z * (3.0f - 2.0f * z));
}

// Windows of presences p count p share, share = (1 - prod(1 - p)) / sum(p): together 1 where any is whole, and what a
// window by itself has of its presence is all of it. `all`: 1 - prod(1 - p), summed up by wake_joined().
SEASCAPE_FUNCTION float wake_joined(float all, float present) { return all + present * (1.0f - all); }
SEASCAPE_FUNCTION float wake_share(float sum, float all) { return sum > 0.0f ? all / sum : 0.0f; }

SEASCAPE_SHARED_END
#endif
