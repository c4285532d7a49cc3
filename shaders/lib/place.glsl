// Data that belong to places, as lod_read() has them; each field a texture array of windows. Part of lib/sea.glsl; the
// C++ twin is ocean/places/lod_field.h.

LodRead place_read(vec2 place, float footprint) {
  return lod_read(frame.sea.place.windows.reach, frame.sea.place.windows.slices,
                  lod_distance(place - frame.sea.place.windows.viewer), footprint);
}

// Layer `number` of `layers` a slice.
vec4 place_texel(texture2DArray field, int layers, int number, int slice, vec2 place) {
  const int layer =
      layers * lod_layer(frame.sea.place.windows.first_layer, slice, frame.sea.place.windows.slices) + number;
  return textureLod(sampler2DArray(field, smooth_sampler),
                    vec3(lod_coordinates(frame.sea.place.windows.slice[slice], place), float(layer)), 0.0);
}

vec4 place_value(texture2DArray field, int layers, int number, LodRead read, vec2 place, vec4 outside) {
  if (read.present <= 0.0) return outside;
  vec4 value = place_texel(field, layers, number, read.fine, place);
  if (read.coarser > 0.0) value = mix(value, place_texel(field, layers, number, read.fine + 1, place), read.coarser);
  return mix(outside, value, read.present);
}

vec4 place_value(texture2DArray field, LodRead read, vec2 place, vec4 outside) {
  return place_value(field, 1, 0, read, place, outside);
}

// What lies on the water, 0 where nothing does; `which`: laid_stays and laid_follows.
struct Laid {
  vec4 stays, follows;
};

Laid place_laid(texture2DArray field, int which, vec2 place, vec2 rest) {
  Laid laid = Laid(vec4(0.0), vec4(0.0));
  const int layers = which == (laid_stays | laid_follows) ? 2 : 1;
  if ((which & laid_stays) != 0) laid.stays = place_value(field, layers, 0, place_read(place, 0.0), place, vec4(0.0));
  if ((which & laid_follows) != 0)
    laid.follows = place_value(field, layers, layers - 1, place_read(rest, 0.0), rest, vec4(0.0));
  return laid;
}

vec4 laid_sum(Laid laid) { return laid.stays + laid.follows; }
