// Water that is carried along takes its waves with it. A pattern that went on for ever would be drawn out to nothing:
// there are two, each carried for the time of a phase about the place where it belongs, and the one fades in as the
// other goes (Max and Becker 1996). Part of lib/sea.glsl; the C++ twin is ocean/sea/place_sea.cpp.

// What the two patterns' weighted sum has to be multiplied by. `flow`: the water's velocity, m/s.
float flow_height(CascadeData c, vec2 flow) {
  const vec2 way = flow * frame.sea.place.flow.w;
  return flow_height(c.decay.x, c.decay.y, c.decay.z, way.x, way.y, frame.sea.place.flow.z);
}

// The sum of the two patterns' texels at tile coordinates `at`.
vec4 flow_texel(texture2DArray tiles, CascadeData c, vec2 flow, vec3 at, float level) {
  const vec2 way = tile_vector(c, flow);
  const vec4 first =
      textureLod(sampler2DArray(tiles, smooth_sampler), vec3(at.xy - way * frame.sea.place.flow.x, at.z), level);
  const vec4 second =
      textureLod(sampler2DArray(tiles, smooth_sampler), vec3(at.xy - way * frame.sea.place.flow.y, at.z), level);
  return flow_height(c, flow) * mix(second, first, frame.sea.place.flow.z);
}
