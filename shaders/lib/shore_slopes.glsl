// The derivatives of lib/shore.glsl. Part of lib/sea.glsl.

// What the share changes by, over a texel to either side.
vec2 shore_share_gradient(LodRead read, vec2 place) {
  const float texel = frame.sea.place.windows.slice[read.fine].w;
  const vec2 x = vec2(texel, 0.0), z = vec2(0.0, texel);
  return vec2(place_value(shore_line_windows, read, place + x, vec4(0.0)).w -
                  place_value(shore_line_windows, read, place - x, vec4(0.0)).w,
              place_value(shore_line_windows, read, place + z, vec4(0.0)).w -
                  place_value(shore_line_windows, read, place - z, vec4(0.0)).w) /
         (2.0 * texel);
}

// Left out of what light takes: by how much bends turn the shift from place to place, a hundredth or two of slope.
void add_shore_slopes(inout SeaSlopes s, SeaPlace place, SeaFootprint over) {
  const SeaShore shore = place.shore;
  if (shore.share <= 0.0) return;
  SeaSlopes part = no_slopes();
  const SeaFootprint bent = SeaFootprint(shore_vector(shore, over.along), shore_vector(shore, over.across), over.blur);
  add_slopes(part, shore_derivatives, shore_moments, frame.sea.shore, 6, 0.0, shore_place(place), bent, 1.0);
  const vec4 d = shore_pattern(place, over.blur);
  const vec2 more = shore.share != 1.0 ? shore_share_gradient(place.read, place.rest) : vec2(0.0);
  const vec2 forward = shore.forward, right = shore_right(shore), x = shore.stretch * forward,
             level = d.x * forward + d.z * right;
  s.gradient += shore.share * (part.gradient.x * x + part.gradient.y * right) + d.y * more;
  const vec2 of_forward = part.shift.x * x + d.w * right, of_right = d.w * x + part.shift.y * right;
  s.shift.xy += shore.share * (forward * of_forward + right * of_right) + level * more;
  s.shift.z += 0.5 * (shore.share * (dot(forward, of_forward.yx) + dot(right, of_right.yx)) + dot(level, more.yx));
  const vec3 v = part.variance;
  s.variance += shore.share * shore.share *
                (v.x * vec3(x * x, x.x * x.y) + v.y * vec3(right * right, right.x * right.y) +
                 v.z * vec3(2.0 * x * right, x.x * right.y + x.y * right.x));
}
