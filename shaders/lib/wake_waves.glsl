// What waves in the windows of bodies add to sea_displacement(), and how windows are weighed. Part of lib/sea.glsl; the
// C++ twin is ocean/places/wake_surface.cpp.

// How much of a level of a window there is at a rest position.
float wake_presence(int window, int level, float half_m, vec2 rest) {
  const vec4 middle = frame.sea.wakes.window[window].middle[level];
  return middle.z * wake_present(rest - middle.xy, half_m);
}

// The same of each window.
vec4 wake_presences(int level, vec2 rest) {
  const float half_m = frame.sea.wakes.half_m[level];
  vec4 present = vec4(0.0);
  present.x = wake_presence(0, level, half_m, rest);
  if (frame.sea.wakes.count.x > 1) present.y = wake_presence(1, level, half_m, rest);
  if (frame.sea.wakes.count.x > 2) present.z = wake_presence(2, level, half_m, rest);
  if (frame.sea.wakes.count.x > 3) present.w = wake_presence(3, level, half_m, rest);
  return present;
}

// What each of them counts.
vec4 wake_weights(int level, vec2 rest) {
  const vec4 present = wake_presences(level, rest);
  float all = present.x;
  all = wake_joined(all, present.y);
  all = wake_joined(all, present.z);
  all = wake_joined(all, present.w);
  return present * wake_share(dot(present, vec4(1.0)), all);
}

void add_wake_level(inout vec4 sum, int window, int level, float weight, vec2 rest, float footprint) {
  const vec4 slice = frame.sea.wakes.window[window].slice[level];
  const float present = weight * frame.sea.wakes.window[window].level[level].w * window_kept(slice.w, footprint);
  if (present <= 0.0) return;
  const float share = frame.sea.wakes.half_m.w;
  sum += present * vec4(share, 1.0, share, share) *
         window_texel(wake_windows, slice, window * max_wake_levels + level, rest);
}

void add_wake_levels(inout vec4 sum, int level, vec2 rest, float footprint) {
  const vec4 weights = wake_weights(level, rest);
  add_wake_level(sum, 0, level, weights.x, rest, footprint);  // written out, as the cascades are
  add_wake_level(sum, 1, level, weights.y, rest, footprint);
  add_wake_level(sum, 2, level, weights.z, rest, footprint);
  add_wake_level(sum, 3, level, weights.w, rest, footprint);
}

void add_wake_displacement(inout vec4 sum, vec2 rest, float footprint) {
  if (frame.sea.wakes.count.x <= 0) return;
  add_wake_levels(sum, 0, rest, footprint);
  if (wake_levels > 1) add_wake_levels(sum, 1, rest, footprint);
  if (wake_levels > 2) add_wake_levels(sum, 2, rest, footprint);
}
