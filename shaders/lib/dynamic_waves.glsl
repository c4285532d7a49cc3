// What dynamic waves add to sea_displacement(). Part of lib/sea.glsl; the C++ twin is ocean/places/dynamic_surface.cpp.

// How much of a level there is at a distance from the viewer for a footprint in metres.
float dynamic_present(int i, float distance, float footprint) {
  return frame.sea.dynamic.level[i].w * lod_present(frame.sea.dynamic.windows.reach, i, distance) *
         window_kept(frame.sea.dynamic.windows.slice[i].w, footprint);
}

void add_dynamic_level(inout vec4 sum, int i, vec2 rest, float distance, float footprint) {
  const float present = dynamic_present(i, distance, footprint);
  if (present <= 0.0) return;
  const vec4 share = vec4(frame.sea.dynamic.share.x, 1.0, frame.sea.dynamic.share.xx);
  sum += present * share * window_texel(dynamic_shift, frame.sea.dynamic.windows.slice[i], i, rest);
}

void add_dynamic_displacement(inout vec4 sum, vec2 rest, float footprint) {
  const float distance = lod_distance(rest - frame.sea.dynamic.windows.viewer);
  add_dynamic_level(sum, 0, rest, distance, footprint);  // written out, as the cascades are
  if (dynamic_levels > 1) add_dynamic_level(sum, 1, rest, distance, footprint);
  if (dynamic_levels > 2) add_dynamic_level(sum, 2, rest, distance, footprint);
  if (dynamic_levels > 3) add_dynamic_level(sum, 3, rest, distance, footprint);
  if (dynamic_levels > 4) add_dynamic_level(sum, 4, rest, distance, footprint);
  if (dynamic_levels > 5) add_dynamic_level(sum, 5, rest, distance, footprint);
  if (dynamic_levels > 6) add_dynamic_level(sum, 6, rest, distance, footprint);
  if (dynamic_levels > 7) add_dynamic_level(sum, 7, rest, distance, footprint);
}
