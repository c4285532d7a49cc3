// What lib/flow.glsl does for tile_mean(). Part of lib/sea.glsl.

// The sum of the two patterns' means.
vec4 flow_mean(texture2DArray tiles, CascadeData c, vec2 flow, vec3 at, vec2 du, vec2 dv, float level) {
  const vec3 way = vec3(tile_vector(c, flow), 0.0);
  const vec4 first = tile_mean(tiles, at - way * frame.sea.place.flow.x, du, dv, level),
             second = tile_mean(tiles, at - way * frame.sea.place.flow.y, du, dv, level);
  return flow_height(c, flow) * mix(second, first, frame.sea.place.flow.z);
}
