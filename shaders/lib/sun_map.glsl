// What solid things leave of the sun's light: read from the map of how near the sun they are. Included after the
// uniform block `frame` has been declared.
#ifndef SEASCAPE_SUN_MAP_GLSL
#define SEASCAPE_SUN_MAP_GLSL

layout(constant_id = value_sun_map) const bool sun_map_there = false;
layout(binding = slot_sun_map) uniform sampler2DArrayShadow sun_map;

// The share of the sun's light that comes to `at` (FrameData::sun_map_column). `n`: the normal of what is itself in the
// map, so that it does not hide itself from the sun; 0 of water and land, which are not.
float sun_reaches(vec3 at, vec3 n) {
  if (frame.sun_map.w == 0.0) return 1.0;
  // Asked a little off a surface, the more the steeper the light: a filtered texel's own plane then lies behind
  // everywhere (Holbert 2011, "Saying goodbye to shadow acne").
  const vec4 from = vec4(at + n * (1.5 * frame.sun_map.x * length(cross(n, frame.sun.xyz))), 1.0);
  const vec3 in_map =
      vec3(dot(frame.sun_map_column, from), dot(frame.sun_map_row, from), dot(frame.sun_map_near, from));
  const vec2 out_of_middle = abs(2.0 * in_map.xy - 1.0);
  const float shown =
      1.0 - smoothstep(0.85, 1.0, max(max(out_of_middle.x, out_of_middle.y), length(at.xz) / frame.sun_map.y));
  if (shown <= 0.0) return 1.0;
  // How much nearer the surface is a texel further on.
  const vec2 texel = vec2(0.5 * frame.sun_map.x / frame.sun_map.y);
  vec2 nearer = vec2(0.0);
  const float facing = dot(n, frame.sun.xyz);
  if (facing > 0.0)
    nearer = -vec2(dot(n, frame.sun_map_column.xyz), dot(n, frame.sun_map_row.xyz)) * 2.0 * frame.sun_map.y /
             max(facing, 0.1) * frame.sun_map.x / frame.sun_map.z;
  const float ahead = 0.05 * frame.sun_map.x / frame.sun_map.z;  // of how depths are rounded
  float lit = 0.0;
  for (int i = 0; i < 4; ++i) {
    const vec2 tap = vec2((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5);
    lit += 0.25 * texture(sun_map,
                          vec4(frame.sun_map.w * (in_map.xy + tap * texel), 0.0, in_map.z + dot(nearer, tap) + ahead));
  }
  return mix(1.0, lit, shown);
}
#endif
