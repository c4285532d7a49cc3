// What is known of a place of the sea: read once, and handed to all that is asked of it there. Part of lib/sea.glsl.

// Of the bed: where there is land, and how much each cascade's waves come to and from where their patterns are taken.
struct SeaBed {
  vec4 here;   // BedTexel (ocean/places/bed_field.h): the bed's height, the shifts of the longest three cascades
  vec4 share;  // of cascades 0 to 3
  vec4 more;   // of the fifth; of other sources; of the run-up; of all shorter waves
  vec4 slope;  // along x and z, a metre: of the bed's height (x, y) and of the first cascade's shift (z, w),
  vec4 bend;   // of the second's and of the third's shift
};

// Of curves along which waves run.
struct SeaShore {
  float share;    // of the waves; 0: nothing else is known
  float stretch;  // what the pattern's x grows by in a metre along the curve
  vec2 forward;   // along the curve
  vec2 bent;      // the place in the pattern, m
};

// The warp of the first cascade's pattern: how far it is shifted, m, and what that grows by in a metre: (x by x, x by
// z, z by x, z by z).
struct SeaWarp {
  vec2 shift;
  vec4 growth;
};

struct SeaPlace {
  vec2 rest;     // rest position, metres from the grid origin
  LodRead read;  // where the windows of places are read
  vec3 level;    // the still water's height, m, and its slope along x and z
  vec2 flow;     // the water's velocity, m/s
  SeaBed bed;
  SeaShore shore;
  SeaWarp warp;
};

// The open sea, which keeps what a scene has no data for.
SeaPlace plain_place(vec2 rest, LodRead read) {
  const SeaBed bed = SeaBed(vec4(0.0), vec4(1.0), vec4(1.0, 1.0, 0.0, 1.0), vec4(0.0), vec4(0.0));
  return SeaPlace(rest, read, vec3(0.0), vec2(0.0), bed, SeaShore(0.0, 0.0, vec2(0.0), vec2(0.0)),
                  SeaWarp(vec2(0.0), vec4(0.0)));
}
