// Solid things as they are seen through the water's surface. Part of lib/sea_light.glsl.

layout(constant_id = value_solids_in_water) const bool solids_in_water = false;
// As the eye would see them without water: radiance of a thing just under the water (solid_in_water()) and cover; how
// near.
layout(binding = slot_solids_in_water) uniform texture2DArray solids_below;
layout(binding = slot_depths_in_water) uniform sampler2DArray solids_below_depths;  // of whole texels

// Between texels of one thing it lies on their plane, as depths change evenly in the picture. Around its edge it is as
// near as the nearest, and the cover says how much of it is there. `texel`: one over the picture's sides.
float solid_depth(vec2 pixel, vec2 texel) {
  // Lines begin in middles of texels, where rounding would choose its neighbours anew in each frame.
  const vec2 corner = floor(pixel + 0.49), between = clamp(pixel + 0.5 - corner, 0.0, 1.0);
  const vec4 four = textureGather(solids_below_depths, vec3(corner * texel, eye_index()));
  const float least = min(min(four.x, four.y), min(four.z, four.w)),
              most = max(max(four.x, four.y), max(four.z, four.w));
  if (least < 0.8 * most) return most;
  const vec2 pair = mix(four.wx, four.zy, between.x);
  return mix(pair.x, pair.y, between.y);
}

struct SolidSeen {
  vec3 lit;     // of solid_in_water()
  float way;    // how deep it lies below where the line of sight enters, m
  float cover;  // 0: none is met
};

// The thing that the line of sight meets that enters the water at `from` and goes on as `inside` (from the viewer,
// world axes). The line is straight in the picture, and depths along it change evenly there.
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
  const vec3 begin = first.xyz / first.w, end = last.xyz / last.w;
  if (any(lessThan(max(begin.xy, end.xy), seen.xy)) || any(greaterThan(min(begin.xy, end.xy), seen.zw))) return none;
  const vec2 size = frame.solids.reach.zw, texel = 1.0 / vec2(textureSize(solids_below_depths, 0).xy);
  const vec3 at = vec3((0.5 + 0.5 / solid_margin * begin.xy) * size, begin.z),
             to = vec3((0.5 + 0.5 / solid_margin * end.xy) * size, end.z);
  const int steps = int(clamp(length(to.xy - at.xy) / 4.0, 2.0, 16.0));  // of four pixels, or longer
  bool before = true;                                                    // the line is not behind anything
  float last_depth = solid_depth(at.xy, texel);                          // of the step before
  for (int i = 1; i <= steps; ++i) {
    const float share = float(i) / float(steps);
    vec3 on = mix(at, to, share);
    if (any(lessThan(on.xy, vec2(0.0))) || any(greaterThanEqual(on.xy, size))) return none;
    const float depth = solid_depth(on.xy, texel);
    const bool behind = depth > on.z;
    // It is behind a thing now, or it would be had the one of the step before not ended: then it may have met that.
    if (before && max(depth, last_depth) > on.z) {
      float outside = share - 1.0 / float(steps), within = share, there = depth;
      for (int k = 0; k < 9; ++k) {
        const float middle = 0.5 * (outside + within);
        on = mix(at, to, middle);
        const float found = solid_depth(on.xy, texel);
        if (found > on.z || (found < 0.8 * last_depth && last_depth > on.z)) {
          within = middle;
          there = found;
        } else {
          outside = middle;
        }
      }
      on = mix(at, to, within);
      // What stands before the line, as a hull's topside does, is not met by it.
      const float range = frame.air.z / max(there, 1e-9), passes = frame.air.z / on.z;
      if (abs(passes - range) < 0.05 + 0.01 * passes) {
        const vec2 clip = (2.0 * on.xy / size - 1.0) * solid_margin;
        const float met = view.eye.y + range * (clip.x * view.ray_x.y + clip.y * view.ray_y.y + view.ray_z.y);
        const vec4 lit =
            textureLod(sampler2DArray(solids_below, smooth_sampler), vec3(on.xy * texel, eye_index()), 0.0);
        return SolidSeen(lit.rgb / max(lit.a, 1e-3), max(from.y - met, 0.0), lit.a);
      }
    }
    before = !behind;
    last_depth = depth;
  }
  return none;
}

// Lays it over what is seen of water and bed; `ground`: how deep the bed is met, m.
void lay_solids_in_water(inout vec3 below, float ground, vec3 from, vec3 inside, vec3 deep, vec3 down, ViewData view) {
  const SolidSeen seen = solid_seen_in_water(from, inside, ground, view);
  if (seen.cover <= 0.0 || seen.way > ground + 0.05) return;
  const vec3 sent = seen.lit / light.exposure.x;
  below = mix(below, light_out_of_water(water_column(seen.way, max(-inside.y, 0.3)), deep, sent, down), seen.cover);
}
