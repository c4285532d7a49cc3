// Water that is carried along takes its waves with it. A pattern that went on for ever would be drawn out to nothing:
// there are two, each carried for the time of a phase about the place where it belongs, and the one fades in as the
// other goes (Max and Becker 1996). Part of lib/sea.glsl; the C++ twin is ocean/sea/place_sea.cpp.

vec2 flow_velocity;  // of the water here, m/s

// What the two patterns' weighted sum has to be multiplied by to stand as high as either, whatever the shares: they are
// alike as far as the way between them is short against their waves, by a Gaussian of the way (of the band's middle
// wave number).
float flow_height(CascadeData c) {
  const float k = 6.2831853 * inversesqrt(c.origin.w * c.moments.w),
              way = k * length(flow_velocity) * frame.sea.place.flow.w;
  const float first = frame.sea.place.flow.z, second = 1.0 - first;
  return inversesqrt(first * first + second * second + 2.0 * first * second * exp(-0.5 * way * way));
}

// The sum of the two patterns' texels at tile coordinates `at`.
vec4 flow_texel(texture2DArray tiles, CascadeData c, vec3 at, float level) {
  const vec2 way = tile_vector(c, flow_velocity);
  const vec4 first =
      textureLod(sampler2DArray(tiles, smooth_sampler), vec3(at.xy - way * frame.sea.place.flow.x, at.z), level);
  const vec4 second =
      textureLod(sampler2DArray(tiles, smooth_sampler), vec3(at.xy - way * frame.sea.place.flow.y, at.z), level);
  return flow_height(c) * mix(second, first, frame.sea.place.flow.z);
}
