// Where data of a place lie: windows around the viewer, each twice as wide as the one before, and which of them a place
// reads.
#ifndef SEASCAPE_LOD_WINDOWS_H
#define SEASCAPE_LOD_WINDOWS_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::ceil;
using glm::clamp;
using glm::floor;
using glm::log2;
using glm::max;
using glm::min;
#endif

SEASCAPE_CONST int max_lod_slices = 16;
// The outer part of a window's reach over which it gives way to the next. With less than a half, a place reads two
// windows at most.
SEASCAPE_CONST float lod_border = 0.25f;

// Places are metres from an origin near the viewer, x and z. Textures repeat: a place keeps its texel for as long as a
// window covers it, whichever way the window has moved.
struct LodWindows {
  vec4 slice[max_lod_slices];  // x, y: the origin's coordinates in the texture; z: 1 / the window's side; w: its texel,
                               // m
  vec4 reach;  // x: how far from the viewer slice 0 is read, m; of each slice after it twice as far; y: how far any is;
               // z: how far slice 0 has given way to slice 1 for height, 0 to 1; w: the finest texel, m
  vec2 viewer;  // not snapped: what is read changes smoothly with it
  int slices;
  int first_layer;  // the texture's layer of slice 0; that of slice i: (first_layer + i) modulo slices
};

// Slice `fine` and, where it is above 0, for a share `coarser` the one after it; what is not `present` is the field's
// value outside of all windows. The result is mix(outside, mix(slice fine, slice fine + 1, coarser), present), so that
// a constant comes back to the bit: the weights' sum is 1.
struct LodRead {
  int fine;
  float coarser;
  float present;
};

// The functions take what they need of LodWindows and not the whole, which a compiler might copy.
SEASCAPE_FUNCTION float lod_distance(vec2 from_viewer) { return max(abs(from_viewer.x), abs(from_viewer.y)); }

SEASCAPE_FUNCTION int lod_layer(int first_layer, int slice, int slices) { return (first_layer + slice) % slices; }

// Of a texture that repeats; `slice`: LodWindows::slice.
SEASCAPE_FUNCTION vec2 lod_coordinates(vec4 slice, vec2 place) { return place * slice.z + vec2(slice.x, slice.y); }

// How much of slice i there is at a distance from the viewer: 1, and 0 from its reach on. For data of which each slice
// has a part of its own. `reach`: LodWindows::reach.
SEASCAPE_FUNCTION float lod_present(vec4 reach, int slice, float distance) {
  float end = min(reach.x * float(1 << slice), reach.y);
  return clamp((end - distance) / (lod_border * end), 0.0f, 1.0f);
}

// A level that is whole over three quarters of the way from one to the next, so that mostly one level is read instead
// of two; continuous.
SEASCAPE_FUNCTION float mostly_whole(float level) {
  float whole = floor(level);
  return whole + clamp(4.0f * (level - whole) - 1.5f, 0.0f, 1.0f);
}

// What a place is read from, for a footprint in metres. The level is the greatest of three, each continuous: by
// distance, by footprint (no texel finer than it) and by the viewer's height. A slice's number at which the binary
// logarithm rounds to either side gives the same level.
SEASCAPE_FUNCTION LodRead lod_read(vec4 reach, int slices, float distance, float footprint) {
  int number = distance > reach.x ? int(min(ceil(log2(distance / reach.x)), float(slices - 1))) : 0;
  float end = reach.x * float(1 << number);
  // The last slice comes in with height: at a blend of 0 it is not yet read.
  float border = number == slices - 2 ? lod_border * max(reach.z, 1e-6f) : lod_border;
  float by_place = float(number) + clamp(1.0f - (end - distance) / (border * end), 0.0f, 1.0f);
  float by_footprint = min(mostly_whole(log2(max(footprint / reach.w, 1.0f))), float(slices - 2) + reach.z);
  float level = clamp(max(max(by_place, by_footprint), reach.z), 0.0f, float(slices - 1));
  LodRead result;
  result.fine = int(level);
  result.coarser = level - float(result.fine);
  result.present = clamp((reach.y - distance) / (lod_border * reach.y), 0.0f, 1.0f);
  return result;
}

SEASCAPE_SHARED_END
#endif
