// What waves in the windows of bodies add to sea_slopes(). Part of lib/sea.glsl; the C++ twin is
// ocean/places/wake_surface.cpp.

// What a pixel's footprint takes of a level is roughness, as much as its window has on average.
void add_wake_slope(inout SeaSlopes s, int window, int level, float weight, vec2 rest, float blur) {
  const vec4 slice = frame.sea.wakes.window[window].slice[level], known = frame.sea.wakes.window[window].level[level];
  const float there = weight * known.w, present = there * window_kept(slice.w, 2.0 * blur);
  s.variance += (there - present) * known.xyz;
  if (present <= 0.0) return;
  const vec4 d =
      present * window_texel(wake_windows, slice, (max_wake_windows + window) * max_wake_levels + level, rest);
  s.gradient += d.xy;
  s.shift.xy += frame.sea.wakes.half_m.w * d.zw;  // its shear the vertices carry
}

void add_wake_level_slopes(inout SeaSlopes s, int level, vec2 rest, float blur) {
  const vec4 weights = wake_weights(level, rest);
  add_wake_slope(s, 0, level, weights.x, rest, blur);
  add_wake_slope(s, 1, level, weights.y, rest, blur);
  add_wake_slope(s, 2, level, weights.z, rest, blur);
  add_wake_slope(s, 3, level, weights.w, rest, blur);
}

void add_wake_slopes(inout SeaSlopes s, vec2 rest, float blur) {
  if (frame.sea.wakes.count.x <= 0) return;
  add_wake_level_slopes(s, 0, rest, blur);
  if (wake_levels > 1) add_wake_level_slopes(s, 1, rest, blur);
  if (wake_levels > 2) add_wake_level_slopes(s, 2, rest, blur);
}
