// Data that belong to places, as lod_read() has them; each field a texture array of windows. Part of lib/sea.glsl; the C++ twin is
// ocean/local/lod_field.h.

LodRead place_read(vec2 place, float footprint) {
  return lod_read(frame.sea.place.windows.reach, frame.sea.place.windows.slices, lod_distance(place - frame.sea.place.windows.viewer), footprint);
}

vec4 place_texel(sampler2DArray field, int slice, vec2 place) {
  const int layer = lod_layer(frame.sea.place.windows.first_layer, slice, frame.sea.place.windows.slices);
  return textureLod(field, vec3(lod_coordinates(frame.sea.place.windows.slice[slice], place), float(layer)), 0.0);
}

vec4 place_value(sampler2DArray field, LodRead read, vec2 place, vec4 outside) {
  if (read.present <= 0.0) return outside;
  vec4 value = place_texel(field, read.fine, place);
  if (read.coarser > 0.0) value = mix(value, place_texel(field, read.fine + 1, place), read.coarser);
  return mix(outside, value, read.present);
}

// Of the first channel, over a texel to either side.
vec2 place_gradient(sampler2DArray field, vec2 place, float footprint, vec4 outside) {
  const LodRead read = place_read(place, footprint);
  if (read.present <= 0.0) return vec2(0.0);
  const float texel = frame.sea.place.windows.slice[read.fine].w;
  const vec2 x = vec2(texel, 0.0), z = vec2(0.0, texel);
  return vec2(place_value(field, read, place + x, outside).x - place_value(field, read, place - x, outside).x,
              place_value(field, read, place + z, outside).x - place_value(field, read, place - z, outside).x) / (2.0 * texel);
}
