// Volumes that hold no water: how far within one a place lies, and the tree by which those about a place are found.
#ifndef SEASCAPE_CLIP_VOLUME_H
#define SEASCAPE_CLIP_VOLUME_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::length;
using glm::max;
using glm::min;
using glm::vec3;
#endif

// A box covers spheres (nothing but its edge) and capsules (a line and its edge).
SEASCAPE_CONST int clip_box = 0;
SEASCAPE_CONST int clip_cylinder = 1;
SEASCAPE_CONST int clip_hull = 2;

// Whole metres stand apart, so that floats are as good 10,000 km off.
struct ClipVolume {
  ivec4 middle;  // x, y: whole metres of its middle's x and z; z: its form; w: of a hull the layer of its map
  vec4 offset;  // xyz: from there, at height 0, to its middle, m; w: 1 where it takes the water away, 0 where it leaves
                // it
  vec4 axis[3];  // xyz: its own axes in the world; w: of a box half a side less its edge; of a cylinder radius and half
                 // the length; of a hull a texel of its map and half its height, m
  vec4 edge;     // x: a box's radius of its edges, m; y: 1 of a body's hull, which has a floor of its own
};

// A node holds all that lies beneath it; the nodes of its first half follow it, and then those of the second.
struct ClipNode {
  ivec4 box;   // the least and the most x and z, in whole metres that a place is rounded down to
  ivec4 more;  // x: the node after all that lie beneath; y: a leaf's volume, or -1; z: of the first, how many there are
};

SEASCAPE_CONST int clip_hull_texels = 256;     // a side of a hull's map
SEASCAPE_CONST float clip_hull_margin = 4.0f;  // texels around the hull

// Signed distances (m, below 0 within) in a volume's own axes (Quilez 2008). Of a box with rounded edges;
SEASCAPE_FUNCTION float clip_box_distance(vec3 p, vec3 core, float edge) {
  vec3 q = abs(p) - core;
  return length(max(q, vec3(0.0f))) + min(max(q.x, max(q.y, q.z)), 0.0f) - edge;
}
// of an upright cylinder;
SEASCAPE_FUNCTION float clip_cylinder_distance(vec3 p, float radius, float half_length) {
  vec2 q = vec2(length(vec2(p.x, p.z)) - radius, abs(p.y) - half_length);
  return min(max(q.x, q.y), 0.0f) + length(max(q, vec2(0.0f)));
}
// of a hull, from what its map has there: its lowest and highest place (of half its height), and how far its outline is
// (texels, below 0 within). Of the right sign everywhere; no further than the nearest place along one axis.
SEASCAPE_FUNCTION float clip_hull_distance(float y, vec3 map, float texel_m, float half_height) {
  return max(texel_m * map.z, max(half_height * map.x - y, y - half_height * map.y));
}

SEASCAPE_SHARED_END
#endif
