// A colour that lies on the water. Part of lib/sea_light.glsl.

// `white`: the light that a white cloth there would send to the eye. What goes with the waves lies over what stays in
// its place.
void lay_albedo(inout vec3 lit, vec2 place, vec2 rest, vec3 white) {
  const Laid laid = place_laid(water_albedo_windows, water_albedo, place, rest);
  lit = lit * (1.0 - laid.stays.a) + laid.stays.rgb * white;
  lit = lit * (1.0 - laid.follows.a) + laid.follows.rgb * white;
}
