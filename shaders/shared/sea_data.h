// The sea as shaders sample it: where each cascade's tile lies and what its waves come to on average.
#ifndef SEASCAPE_SEA_DATA_H
#define SEASCAPE_SEA_DATA_H
#include "gpu_types.h"
#include "lod_windows.h"
#include "pattern_warp.h"
#include "wake_windows.h"
#include "wave_bin.h"
#include "wave_particles.h"
SEASCAPE_SHARED_BEGIN

// A cascade's tile, or another source's as one of its layings has it.
struct CascadeData {
  vec4 tile_from_rest;  // xy, zw: rows of the matrix from rest position (metres from the grid origin) to tile
                        // coordinates
  vec4 origin;   // xy: tile coordinates of the grid origin, half a texel added; z: metres a texel; w: its shortest wave
                 // in metres
  vec4 moments;  // E[hx^2], E[hz^2], E[hx hz] over the whole tile; w: its longest wave in metres
  vec4 decay;    // xyz: how fast it ceases to be like itself with distance, 1/m^2 (PatternMoments::decay_per_m2)
};

SEASCAPE_CONST int max_dynamic_levels = 8;

// Dynamic waves: level i in layer i of its textures.
struct DynamicData {
  LodWindows windows;
  vec4 level[max_dynamic_levels];  // xyz: means of (dh/dx)^2, (dh/dz)^2, product over the window; w: how much it counts
                                   // for, 0 where it rests
  vec4 share;                      // x: of the sideways displacement that the textures hold
};

// Of the sea over a bed.
SEASCAPE_CONST int bent_cascades = 3;            // the longest ones, whose patterns are shifted
SEASCAPE_CONST int swash_cascades = 2;           // the longest ones, whose heights run up a shore
SEASCAPE_CONST float dry_depth_m = -0.1f;        // of still water, from which on land does not move with the waves,
SEASCAPE_CONST float wet_depth_m = 0.2f;         // and from which on water does as in the open
SEASCAPE_CONST float ground_pattern_m = 512.0f;  // after which the pattern of sand and growth comes again

// What lies on the water is asked for where the water stands, if it stays in its place, and at the water's rest
// position if it goes with the waves: which of both there is. Of both: two layers a slice, in this order.
SEASCAPE_CONST int laid_stays = 1, laid_follows = 2;

// What belongs to places: windows that all of its textures share, and what there is beyond them.
struct PlaceData {
  LodWindows windows;
  vec4 outside;  // x: the still water's height, m; y: 1 where there is no water; z, w: its velocity along x and z, m/s
  vec4 outside_bed;  // x: the bed's height in the open, m; y, z: where the grid origin lies in the ground's pattern, m
  vec4 shift_along[bent_cascades];  // x, y: along which their patterns are shifted over a bed; z of the first: how high
                                    // run-up wets a beach, m; of the second: from which height above the water land is
                                    // green, m, 0 never; of the third: how bright sand is
  ivec4 clip_origin;                // x, y: the grid origin's x and z, whole metres
  vec4 clip_from;                   // x, y: what the grid origin has beyond whole metres
  vec4 flow;  // two phases of water that is carried along: x, y: how long each has been, s; z: the first one's share;
              // w: half of a phase's time, s
};

struct SeaData {
  CascadeData cascade[max_cascades];
  CascadeData baked;                            // of a recorded loop,
  CascadeData gerstner;                         // of Gerstner waves,
  CascadeData shore;                            // of those that run along curves, and
  CascadeData particles[max_particle_layings];  // of wave particles; nothing is there without the effect
  DynamicData dynamic;                          // of dynamic waves
  WakeData wakes;                               // of windows that belong to bodies
  PlaceData place;                              // of what belongs to places
  WarpData warp;   // of the first cascade's pattern; nothing is there where it lies straight
  vec4 tail;       // slope moments xx, zz, xz of waves shorter than the last cascade's; w: chop
  vec4 footprint;  // x: no water is further from its rest position than this, metres; y: one over the distance at which
                   // a recorded loop has faded, 1/m, 0 for none; z: highest crest in metres, w: significant height of
                   // the drawn waves, metres
};

SEASCAPE_SHARED_END
#endif
