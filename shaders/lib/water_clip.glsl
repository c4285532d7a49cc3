// Where water is taken away: flat inputs from windows, and volumes exactly, whatever there are of them. Part of
// lib/sea.glsl; the C++ twins are ocean/sea/place_sea.cpp and ocean/inputs/clip_volumes.cpp.
#include "shared/clip_volume.h"

// What there is of both: 1 flat inputs, 2 volumes, 4 hulls among them, 8 hulls of bodies among them.
layout(constant_id = value_clip_kinds) const int water_clip_kinds = 0;
layout(binding = slot_clip) uniform texture2DArray water_clip_windows;  // 1 where there is no water
layout(std430, binding = slot_clip_nodes) readonly buffer ClipNodes { ClipNode clip_nodes[]; };
layout(std430, binding = slot_clip_volumes) readonly buffer ClipVolumes { ClipVolume clip_volumes[]; };
layout(binding = slot_clip_hulls) uniform texture2DArray clip_hulls;  // lowest, highest, beyond (clip_hull_distance)

bool clip_within(ClipVolume v, vec3 from_middle) {
  const vec3 p =
      vec3(dot(v.axis[0].xyz, from_middle), dot(v.axis[1].xyz, from_middle), dot(v.axis[2].xyz, from_middle));
  if ((water_clip_kinds & 4) != 0 && v.middle.z == clip_hull) {
    const vec2 at = p.xz / (v.axis[0].w * float(clip_hull_texels));
    if (max(abs(at.x), abs(at.y)) > 0.5 - 0.5 / float(clip_hull_texels)) return false;
    return clip_hull_distance(
               p.y, textureLod(sampler2DArray(clip_hulls, smooth_sampler), vec3(at + 0.5, float(v.middle.w)), 0.0).xyz,
               v.axis[0].w, v.axis[1].w) < 0.0;
  }
  if (v.middle.z == clip_cylinder) return clip_cylinder_distance(p, v.axis[0].w, v.axis[1].w) < 0.0;
  return clip_box_distance(p, vec3(v.axis[0].w, v.axis[1].w, v.axis[2].w), v.edge.x) < 0.0;
}

const int clip_to_bed = 1, clip_by_hull = 2;

// What takes the water away. Of the volumes that hold the place (y: above the curved still sea) the last one decides,
// or where none does what flat inputs say. Hulls of bodies do so beside them.
int clip_by_volumes(vec3 place, bool flat_says) {
  const vec2 at = place.xz + frame.sea.place.clip_from.xy;
  const ivec2 cell = ivec2(floor(at)) + frame.sea.place.clip_origin.xy;
  // From the buffer: with a count that is uniform, Mesa 22.3's software driver loops on in samples that are not
  // covered.
  const int count = clip_nodes[0].more.z;
  int node = 0, last = -1;
  bool clipped = flat_says, in_hull = false;
  while (node < count) {
    const ClipNode n = clip_nodes[node];
    const bool here = cell.x >= n.box.x && cell.y >= n.box.y && cell.x <= n.box.z && cell.y <= n.box.w;
    if (here && n.more.y > last) {
      const ClipVolume v = clip_volumes[n.more.y];
      const vec2 off = at - vec2(v.middle.xy - frame.sea.place.clip_origin.xy) - v.offset.xz;
      if (clip_within(v, vec3(off.x, place.y - v.offset.y, off.y))) {
        const bool hull = (water_clip_kinds & 8) != 0 && v.edge.y > 0.5;
        in_hull = in_hull || hull;
        if (!hull) {
          last = n.more.y;
          clipped = v.offset.w > 0.5;
        }
      }
    }
    node = here ? node + 1 : n.more.x;
  }
  return (clipped ? clip_to_bed : 0) | (in_hull ? clip_by_hull : 0);
}

// What takes the water away, 0 where there is some: flat inputs at `flat_place`, volumes at `place` (x, z
// metres from the grid origin, y above the curved still sea).
int water_clips(vec2 flat_place, vec3 place) {
  bool clipped = frame.sea.place.outside.y > 0.5;
  if ((water_clip_kinds & 1) != 0)
    clipped =
        place_value(water_clip_windows, place_read(flat_place, 0.0), flat_place, frame.sea.place.outside.yyyy).x > 0.5;
  if ((water_clip_kinds & 6) != 0) return clip_by_volumes(place, clipped);
  return clipped ? clip_to_bed : 0;
}
bool water_clipped(vec2 flat_place, vec3 place) { return water_clips(flat_place, place) != 0; }
// Over a bed, which lies dry where water is taken away; but a body's hull has a floor of its own, and is cut out of the
// surface.
bool water_clip_dries(vec2 flat_place, vec3 place) { return (water_clips(flat_place, place) & clip_to_bed) != 0; }
bool water_clip_cuts(vec2 flat_place, vec3 place) {
  return (water_clip_kinds & 8) != 0 && (water_clips(flat_place, place) & clip_by_hull) != 0;
}
