// What dynamic waves add to sea_slopes(). Part of lib/sea.glsl; the C++ twin is ocean/places/dynamic_surface.cpp.

// What a pixel's footprint takes of a level is roughness, as much as its window has on average.
void add_dynamic_slope(inout SeaSlopes s, int i, vec2 rest, float distance, float blur) {
  const float there = dynamic_present(i, distance, 0.0), present = dynamic_present(i, distance, 2.0 * blur);
  s.variance += (there - present) * frame.sea.dynamic.level[i].xyz;
  if (present <= 0.0) return;
  const vec4 d = present * window_texel(dynamic_slope, frame.sea.dynamic.windows.slice[i], i, rest);
  s.gradient += d.xy;
  s.shift.xy += frame.sea.dynamic.share.x * d.zw;  // its shear the vertices carry
}

void add_dynamic_slopes(inout SeaSlopes s, vec2 rest, float blur) {
  const float distance = lod_distance(rest - frame.sea.dynamic.windows.viewer);
  add_dynamic_slope(s, 0, rest, distance, blur);
  if (dynamic_levels > 1) add_dynamic_slope(s, 1, rest, distance, blur);
  if (dynamic_levels > 2) add_dynamic_slope(s, 2, rest, distance, blur);
  if (dynamic_levels > 3) add_dynamic_slope(s, 3, rest, distance, blur);
  if (dynamic_levels > 4) add_dynamic_slope(s, 4, rest, distance, blur);
  if (dynamic_levels > 5) add_dynamic_slope(s, 5, rest, distance, blur);
  if (dynamic_levels > 6) add_dynamic_slope(s, 6, rest, distance, blur);
  if (dynamic_levels > 7) add_dynamic_slope(s, 7, rest, distance, blur);
}
