// How vertices slide to their coarser neighbours with distance, so that levels of patches join without a step or a pop.
#ifndef SEASCAPE_VERTEX_MORPH_H
#define SEASCAPE_VERTEX_MORPH_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::clamp;
using glm::findMSB;
using glm::length;
using glm::max;
using glm::min;
using glm::vec3;
using glm::vec4;
#endif

// All in units of the patches' coordinates. The tree splits every node whose quarters have vertices 2^n units apart
// that begins nearer than reach(n): so wherever a patch is drawn with twice that spacing, the distance is at least
// that.
struct VertexMorph {
  vec2 viewer;      // the viewer relative to the grid origin, x and z, at most half a unit off the grid point
  float height;     // from the viewer to the water's bounds
  int last_stride;  // vertices of a greater stride keep their place; 0: none slides
  vec4 reach[5];    // of n = 0, 1, 2, ...: rises with n
  vec4 spacing;  // between vertices where levels change, over the distance: x: the least of all levels; y, z: nowhere
                 // more than y + z * distance; w: unused
};

SEASCAPE_FUNCTION float morph_reach(VertexMorph m, int n) {
  vec4 four = n < 8 ? (n < 4 ? m.reach[0] : m.reach[1]) : (n < 12 ? m.reach[2] : (n < 16 ? m.reach[3] : m.reach[4]));
  float even = (n & 2) == 0 ? four.x : four.z;
  float odd = (n & 2) == 0 ? four.y : four.w;
  return (n & 1) == 0 ? even : odd;
}

// Where a vertex of a patch with this stride stands: odd ones (by their place in the tree) slide to the even one below
// them in the second half of the way from one level's reach to the next, and have arrived before the tree may draw
// twice the stride there (continuous levels of detail: Strugar 2010, section 4). One that has arrived is a vertex of
// the coarser patch, and goes on as one. So patches of any two levels put a vertex that they share in the same place,
// to the bit: where they meet, all vertices of the finer one have arrived at the coarser one's, or at what those have
// become. The distance is that of the vertex it slides to, so that the four of a quad arrive together and no triangle
// turns over on the way.
SEASCAPE_FUNCTION vec2 morphed(VertexMorph m, ivec2 coordinate, ivec2 tree_centre, int stride) {
  ivec2 place = coordinate;
  int n = findMSB(stride);
  float before = n > 0 ? morph_reach(m, n - 1) : 0.5f * morph_reach(m, 0);
  for (int s = stride; s <= m.last_stride; s *= 2) {
    ivec2 odd = (place - tree_centre) & ivec2(s);
    ivec2 even = place - odd;
    float reach = morph_reach(m, n);
    float end = 0.999f * reach - 0.75f;  // the tree measures from the viewer's grid point, and floats round
    float start = min(0.5f * (reach + before), end - 0.5f);
    float share =
        end > 0.0f ? clamp((length(vec3(vec2(even) - m.viewer, m.height)) - start) / (end - start), 0.0f, 1.0f) : 1.0f;
    if (share < 1.0f) return vec2(place) - share * vec2(odd);
    place = even;
    before = reach;
    n += 1;
  }
  return vec2(place);
}

// How far a place is from the viewer, as the tree's levels have it. From that alone, never from the patch, follows what
// is smoothed there, so that shared vertices agree to the bit.
SEASCAPE_FUNCTION float morph_distance(VertexMorph m, vec2 place) { return length(vec3(place - m.viewer, m.height)); }

// What a vertex's displacement is averaged over, in units: half of the spacing. More would blur the waves that the mesh
// draws, less would draw some that it cannot (measured: docs/accuracy.md).
SEASCAPE_FUNCTION float displacement_footprint(VertexMorph m, vec2 place) {
  return 0.5f * max(1.0f, m.spacing.x * morph_distance(m, place));
}

// The spacing of vertices, at most: they carry the slopes of waves that many of them share.
SEASCAPE_FUNCTION float vertex_spacing(VertexMorph m, vec2 place) {
  float distance = morph_distance(m, place);
  return max(1.0f, distance * (m.spacing.y + m.spacing.z * distance));
}

SEASCAPE_SHARED_END
#endif
