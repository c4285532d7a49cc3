// Solid things above the water as eyes in it see them through its surface. Part of lib/sea_from_below.glsl.
#include "shared/solids_above.h"

layout(constant_id = value_solids_above) const bool solids_above = false;
// Around frame.solids.above: radiance of what is there times the exposure; one over how far off it is, 1/m, 0: nothing.
layout(binding = slot_solids_above) uniform texture2DArray solids_above_pictures;

struct SolidAbove {
  vec3 lit;
  float cover;     // of a texel's square around a direction
  float nearness;  // of the thing that covers most of it, 1/m
};

const SolidAbove no_solid_above = SolidAbove(vec3(0.0), 0.0, 0.0);

vec2 solids_above_size() { return vec2(textureSize(sampler2DArray(solids_above_pictures, smooth_sampler), 0).xy); }

float solids_above_texels() { return solids_above_size().y; }  // of a side

// Where a direction is in the pictures, in texels.
vec2 place_above(vec3 d) {
  const int side = side_above(d);
  const vec4 clip = clip_above(d, side);
  const float texels = solids_above_texels();
  return clamp((0.5 + 0.5 * clip.xy / max(clip.w, 1e-6)) * texels, 1.0, texels - 1.0) + vec2(float(side) * texels, 0.0);
}

SolidAbove solid_above(vec3 d) {
  const vec2 place = place_above(d), corner = floor(place + 0.5), between = place + 0.5 - corner,
             size = solids_above_size();
  const vec4 four = textureGather(sampler2DArray(solids_above_pictures, smooth_sampler), vec3(corner / size, 0.0), 3),
             share = gathered_shares(between);
  const float most = max(max(four.x, four.y), max(four.z, four.w));
  if (most <= 0.0) return no_solid_above;
  const vec4 own = share * step(0.8 * most, four);  // a quarter farther away it is another thing
  const float near = own.x + own.y + own.z + own.w, filled = dot(share, step(1e-9, four)), behind = filled - near;
  const vec3 lit = textureLod(sampler2DArray(solids_above_pictures, smooth_sampler), vec3(place / size, 0.0), 0.0).rgb;
  const float nearness = near >= behind ? dot(own, four) / near : dot(share - own, four) / behind;
  return SolidAbove(lit / max(filled, 1e-3), filled, filled > 1e-4 ? nearness : most);
}

// Whether a place, in a direction from the pictures' middle, is behind what they have there, where that is not as near
// as `nearer`. As a share of the ray (see below) it is length(to) / (1 - share) away.
bool is_behind_above(SolidAbove thing, vec3 to, float share, float nearer) {
  return thing.cover > 0.5 && thing.nearness < nearer && length(to) * thing.nearness > 1.0 - share;
}

// The nearer of two, and what it leaves of the other.
SolidAbove before_solid_above(SolidAbove near, SolidAbove far) {
  const float cover = near.cover + (1.0 - near.cover) * far.cover;
  return SolidAbove(mix(far.lit, near.lit, near.cover / max(cover, 1e-4)), cover, near.nearness);
}

// Where, between two shares of the ray from start to end, it first is.
float first_behind_above(vec3 start, vec3 end, float outside, float within, float nearer) {
  for (int k = 0; k < 7; ++k) {
    const float half_way = 0.5 * (outside + within);
    const vec3 there = mix(start, end, half_way);
    if (is_behind_above(solid_above(there), there, half_way, nearer))
      within = half_way;
    else
      outside = half_way;
  }
  return within;
}

// What is met on the way from `from` (from the viewer, world axes) along `leaves`, where light goes that comes out of
// the water. From the pictures' middle its places are start + off share / (1 - share) leaves: from share 0 to 1 the
// direction to them turns from where it leaves the water to its own. Where it first comes behind what the pictures
// have there, it meets it.
SolidAbove solid_met_above(vec3 from, vec3 leaves) {
  const vec4 middle = frame.solids.above;
  if (middle.w <= 0.0) return no_solid_above;
  const vec3 start = from - middle.xyz;
  const float off = max(length(start), 1e-4), clear = max(middle.w - off, 0.0), first = clear / (clear + off);
  const vec3 end = off * leaves, begin = mix(start, end, first);
  const float turn = acos(clamp(dot(begin, leaves) / max(length(begin), 1e-6), -1.0, 1.0));
  const int steps = int(clamp(turn / 0.015, 1.0, 32.0));  // of a degree, or longer
  const float texel = (1.0 - first) / max(turn, 1e-3) * 1.5708 / solids_above_texels();
  const float anything = 1e9;
  float outside = first;
  SolidAbove edge = no_solid_above;  // of what it has passed
  bool was_behind = is_behind_above(solid_above(begin), begin, first, anything);
  float hidden_from = off;  // m from the middle: where it came behind something
  for (int i = 1; i <= steps; ++i) {
    const float share = mix(first, 1.0, float(i) / float(steps));
    const vec3 to = mix(start, end, share);
    const SolidAbove thing = solid_above(to);
    bool far = false;
    for (int k = 0; k < 2; ++k) {
      // Hidden by one thing it may have met another, which is farther away than where it was hidden.
      const float nearer = was_behind ? 1.0 / hidden_from : anything;
      if (!is_behind_above(thing, to, share, nearer)) break;
      const float within = first_behind_above(start, end, outside, share, nearer);
      far = within == 1.0 && !was_behind;
      if (far) break;
      const vec3 there = mix(start, end, within);
      SolidAbove met = solid_above(there);
      // A texel farther on: before an edge a sliver of what recedes behind it comes and goes from texel to texel.
      const SolidAbove next = solid_above(mix(start, end, min(within + texel, 1.0)));
      const float away = length(there) / max(1.0 - within, 1e-4),
                  beyond = away * (next.cover > 0.5 ? max(met.nearness, next.nearness) : met.nearness);
      // It meets it there, or has met it just before, while it was hidden; else it has passed its edge.
      met.cover = 1.0 - (was_behind ? smoothstep(1.3, 1.6, beyond) : smoothstep(1.1, 1.25, beyond));
      if (met.cover >= 1.0) return before_solid_above(edge, met);
      edge = before_solid_above(edge, met);
      if (!was_behind) hidden_from = 0.98 * away;
      was_behind = true;
      outside = within;
    }
    was_behind = !far && is_behind_above(thing, to, share, anything);
    outside = share;
  }
  // Of what is so far away that the direction alone counts a pixel takes as much as is covered there.
  SolidAbove met = solid_above(leaves);
  met.cover = was_behind ? 0.0 : min(2.0 * met.cover, 1.0) * (1.0 - smoothstep(0.01, 0.03, off * met.nearness));
  return before_solid_above(edge, met);
}
