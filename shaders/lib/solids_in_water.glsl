// Solid things as they are seen through the water's surface. Part of lib/sea_light.glsl.

layout(constant_id = value_solids_in_water) const bool solids_in_water = false;
// As the eye would see them without water: radiance of a thing just under the water (solid_in_water()), and how near
// it is: its depth, 0 where there is none.
layout(binding = slot_solids_in_water) uniform texture2DArray solids_below;

// What the four texels of textureGather() have of a place `between` their middles.
vec4 gathered_shares(vec2 between) {
  return vec4(1.0 - between.x, between.x, between.x, 1.0 - between.x) *
         vec4(between.y, between.y, 1.0 - between.y, 1.0 - between.y);
}

// The depths of the four texels about a corner of texels.
vec4 depths_about(vec2 corner, vec2 texel) {
  const vec2 inside = clamp(corner, vec2(1.0), 1.0 / texel - 1.0);
  return textureGather(sampler2DArray(solids_below, smooth_sampler), vec3(inside * texel, eye_index()), 3);
}

// What of the picture's nearest thing is around a place: how much of a texel it covers there, and how near it is, as
// its own texels have it in between. Both change evenly along a line, or its edge would come and go from frame to
// frame.
struct SolidThere {
  float cover, depth;
  float filled;  // how much anything covers there
};
SolidThere solid_there(vec2 pixel, vec2 texel) {
  const vec2 corner = floor(pixel + 0.5), between = pixel + 0.5 - corner;
  const vec4 four = depths_about(corner, texel), share = gathered_shares(between);
  const float most = max(max(four.x, four.y), max(four.z, four.w));
  if (most <= 0.0) return SolidThere(0.0, 0.0, 0.0);
  const vec4 own = share * step(0.8 * most, four);  // a quarter farther away it is another thing
  const float cover = own.x + own.y + own.z + own.w;
  return SolidThere(cover, cover > 1e-4 ? dot(own, four) / cover : most, dot(share, step(1e-9, four)));
}

// Towards more of it, of a pixel's length.
vec2 solid_inwards(vec2 pixel, vec2 texel) {
  const vec4 four = depths_about(floor(pixel + 0.5), texel);
  const vec4 own = step(0.8 * max(max(four.x, four.y), max(four.z, four.w)), four);
  const vec2 more = vec2(own.y + own.z - own.x - own.w, own.x + own.y - own.z - own.w);
  return more / max(length(more), 1e-3);
}

struct SolidSeen {
  vec3 lit;     // of solid_in_water()
  float way;    // how deep it lies below where the line of sight enters, m
  float cover;  // 0: none is met
};

// A line of sight under water as it is in the picture, where it is straight and depths along it change evenly.
struct SolidLine {
  vec3 at, to;  // in pixels, and its depth
  vec2 texel;   // one over the picture's sides
};

bool is_behind(SolidThere thing, float depth) { return thing.cover > 0.0 && thing.depth > depth; }

// Where, between two shares of the line, it first is behind a thing; or behind `last`, which it was before, where that
// has ended.
float first_behind(SolidLine line, float outside, float within, float last) {
  for (int k = 0; k < 9; ++k) {
    const float middle = 0.5 * (outside + within);
    const vec3 on = mix(line.at, line.to, middle);
    const SolidThere thing = solid_there(on.xy, line.texel);
    if (is_behind(thing, on.z) || (thing.depth < 0.8 * last && last > on.z))
      within = middle;
    else
      outside = middle;
  }
  return within;
}

// How much of a pixel's lines have met a thing where the line in its middle comes behind it, at `there` of the picture,
// and where they meet it. Farther inside its edge, all: beside it, as much as is covered there. Around a round thing's
// edge, or along one, the line may come farther inside before the thing's front is a pixel away from it: the most of it
// counts, as that changes evenly when waves move the line. What stands before the line, as a hull's topside does, is
// not met by it.
float met_at(SolidLine line, inout vec3 there) {
  SolidThere thing = solid_there(there.xy, line.texel);
  if (!is_behind(thing, there.z)) return 0.0;
  // By how much the way through the water and the front change over a pixel.
  const vec3 a_pixel = (line.to - line.at) / max(length(line.to.xy - line.at.xy), 1e-3);
  const vec2 inwards = solid_inwards(there.xy, line.texel);
  const float range = frame.air.z / thing.depth, passes = frame.air.z / there.z;
  float front = 0.0;
  if (thing.cover < 0.99) {
    const SolidThere inside = solid_there(there.xy + inwards, line.texel);
    if (inside.cover > thing.cover) front = abs(frame.air.z / inside.depth - range);
  }
  const float near = max(abs(a_pixel.z) * passes / there.z + front, 1e-3);
  float best = thing.cover * (1.0 - smoothstep(0.0, near, passes - range));
  vec3 on = there;
  for (int i = 0; i < 3 && thing.cover < 0.99; ++i) {
    on += a_pixel;
    thing = solid_there(on.xy, line.texel);
    if (!is_behind(thing, on.z)) break;
    const float met = thing.cover * (1.0 - smoothstep(0.0, near, frame.air.z / on.z - frame.air.z / thing.depth));
    if (met > best) {
      best = met;
      there = on;
    }
  }
  return best;
}

// The thing that the line of sight meets that enters the water at `from` and goes on as `inside` (from the viewer,
// world axes).
SolidSeen solid_seen_in_water(vec3 from, vec3 inside, float ground, ViewData view) {
  const SolidSeen none = SolidSeen(vec3(0.0), 0.0, 0.0);
  const vec4 seen = frame.solids.seen[eye_index()];
  // A little beyond the lowest thing, or to the bed, or to where the clearest colour has lost 99.7 % of its light.
  const vec3 dims = frame.water_absorption.rgb + frame.water_backscatter.rgb;
  const float deepest = 0.05 + min(1.02 * (from.y + frame.viewer.z - frame.solids.reach.x),
                                   min(ground, 3.0 / min(dims.r, min(dims.g, dims.b))));
  if (deepest <= 0.05 || seen.x > seen.z) return none;
  const vec4 first = view.clip_from_relative * vec4(from, 1.0);
  vec4 last = view.clip_from_relative * vec4(from + (deepest / -inside.y) * inside, 1.0);
  if (last.w < 0.5 * first.w) last = mix(first, last, 0.5 * first.w / (first.w - last.w));  // it comes towards the eye
  const vec2 size = frame.solids.reach.zw;
  vec3 begin = first.xyz / first.w, end = last.xyz / last.w;
  // With several samples a pixel `from` is the middle of those that a triangle covers, and leaps about as its edges
  // cross them.
  const vec2 leapt = 2.0 * gl_FragCoord.xy / size - 1.0 - begin.xy;
  begin.xy += leapt;
  end.xy += leapt;
  if (any(lessThan(max(begin.xy, end.xy), seen.xy)) || any(greaterThan(min(begin.xy, end.xy), seen.zw))) return none;
  const SolidLine line = SolidLine(vec3((0.5 + 0.5 / solid_margin * begin.xy) * size, begin.z),
                                   vec3((0.5 + 0.5 / solid_margin * end.xy) * size, end.z),
                                   1.0 / vec2(textureSize(sampler2DArray(solids_below, smooth_sampler), 0).xy));
  const int steps = int(clamp(length(line.to.xy - line.at.xy) / 4.0, 2.0, 16.0));  // of four pixels, or longer
  float best = 0.0;
  vec3 best_at = vec3(0.0);
  bool behind = false;     // some thing, a step ago
  float last_depth = 0.0;  // of the thing that it was before then
  for (int i = 0; i <= steps && best < 0.99; ++i) {
    const float share = float(i) / float(steps);
    const vec3 on = mix(line.at, line.to, share);
    if (any(lessThan(on.xy, vec2(0.0))) || any(greaterThanEqual(on.xy, size))) break;
    const SolidThere thing = solid_there(on.xy, line.texel);
    const bool now_behind = is_behind(thing, on.z);
    // It is behind a thing now, or it would be had the one of the step before not ended: then it may have met that.
    if (!behind && (now_behind || last_depth > on.z)) {
      vec3 there =
          mix(line.at, line.to, i == 0 ? 0.0 : first_behind(line, share - 1.0 / float(steps), share, last_depth));
      const float met = met_at(line, there);
      if (met > best) {
        best = met;
        best_at = there;
      }
    }
    behind = now_behind;
    last_depth = now_behind ? 0.0 : thing.depth;
  }
  if (best <= 0.0) return none;
  const vec2 clip = (2.0 * best_at.xy / size - 1.0) * solid_margin;
  const vec3 ray = clip.x * view.ray_x.xyz + clip.y * view.ray_y.xyz + view.ray_z.xyz;
  const SolidThere thing = solid_there(best_at.xy, line.texel);
  const float way = from.y - view.eye.y - frame.air.z / thing.depth * ray.y;
  const vec3 lit =
      textureLod(sampler2DArray(solids_below, smooth_sampler), vec3(best_at.xy * line.texel, eye_index()), 0.0).rgb;
  return SolidSeen(lit / max(thing.filled, 1e-3), max(way, 0.0), best);
}

// Lays it over what is seen of water and bed; `ground`: how deep the bed is met, m.
void lay_solids_in_water(inout vec3 below, float ground, vec3 from, vec3 inside, vec3 deep, vec3 down, ViewData view) {
  const SolidSeen seen = solid_seen_in_water(from, inside, ground, view);
  if (seen.cover <= 0.0 || seen.way > ground + 0.05) return;
  const vec3 sent = seen.lit / light.exposure.x;
  below = mix(below, light_out_of_water(water_column(seen.way, max(-inside.y, 0.3)), deep, sent, down), seen.cover);
}
