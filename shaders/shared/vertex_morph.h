// How vertices slide to their coarser neighbours with distance, so that levels of patches join without a step or a pop.
#ifndef SEASCAPE_VERTEX_MORPH_H
#define SEASCAPE_VERTEX_MORPH_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::clamp; using glm::length; using glm::min; using glm::vec3;
#endif

// All in units of the patches' coordinates. The tree splits every node of 16 strides that begins nearer than reach(stride) =
// min(per_stride * stride, visible + step * stride): so wherever a patch is drawn with twice the stride, the distance is at
// least that.
struct VertexMorph {
  vec2 viewer;      // the viewer relative to the grid origin, x and z, at most half a unit off the grid point
  float height;     // from the viewer to the water's bounds
  float per_stride; // see above; 0: nothing splits by distance
  float visible;
  float step;
  int last_stride;  // vertices of a greater stride keep their place; 0: none slides
  float unused;
};

SEASCAPE_FUNCTION float morph_reach(VertexMorph m, float stride) {
  return min(m.per_stride * stride, m.visible + m.step * stride);
}

// Where a vertex of a patch with this stride stands: odd ones (by their place in the tree) slide to the even one below them in
// the second half of the way from one level's reach to the next, and have arrived before the tree may draw twice the stride
// there (continuous levels of detail: Strugar 2010, section 4). One that has arrived is a vertex of the coarser patch, and goes
// on as one. So patches of any two levels put a vertex that they share in the same place, to the bit: where they meet, all
// vertices of the finer one have arrived at the coarser one's, or at what those have become. The distance is that of the
// vertex it slides to, so that the four of a quad arrive together and no triangle turns over on the way.
SEASCAPE_FUNCTION vec2 morphed(VertexMorph m, ivec2 coordinate, ivec2 tree_centre, int stride) {
  ivec2 place = coordinate;
  for (int s = stride; s <= m.last_stride; s *= 2) {
    ivec2 odd = (place - tree_centre) & ivec2(s);
    ivec2 even = place - odd;
    float reach = morph_reach(m, float(s));
    float end = 0.999f * reach - 0.75f;  // the tree measures from the viewer's grid point, and floats round
    float start = min(0.5f * (reach + morph_reach(m, 0.5f * float(s))), 0.9f * end);
    float share = end > 0.0f ? clamp((length(vec3(vec2(even) - m.viewer, m.height)) - start) / (end - start), 0.0f, 1.0f) : 1.0f;
    if (share < 1.0f) return vec2(place) - share * vec2(odd);
    place = even;
  }
  return vec2(place);
}

SEASCAPE_SHARED_END
#endif
